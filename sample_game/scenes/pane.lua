-- Glass held along its whole border; the ball meets it at least 0.1 m from the frame.
game.scene{
    shows = "a steel ball of 100 g goes through a framed window pane",
    seconds = 10,
    sheet = {0, 5, 7, 9, 11, 13, 16, 20, 26, 35, 60, 599},
}
local shell = game.shell_keys{material = "glass", thickness = 0.004, edge = 0.010}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 8, least = 0, most = 100, text = "of the ball"}
local mass = game.key{name = "scene.mass_kg", unit = "kg", default = 0.1, least = 0.001, most = 100, text = "of the ball"}

local side, foot = 0.5, 0.35 -- m; the pane's lower border stands at foot

local pane = game.cook{
    mesh = game.mesh.pane{side = side, edge = shell.edge},
    material = shell.material,
    fracture = shell.cracks,
    thickness = shell.thickness,
}
game.camera{eye = {0.48, 0.76, 1.08}, target = {0, 0.44, 0.03}, field_of_view = 0.72}
game.floor()

-- Four beams round the pane with 2 mm of room, the lower one on two posts.
local function beam(low, high)
    game.box{low = low, high = high, colour = {0.16, 0.17, 0.18}}
end
local half, thick, depth, low = 0.5 * side + 0.002, 0.03, 0.02, foot - 0.002
local high = low + 2 * half
beam({-half - thick, low - thick, -depth}, {half + thick, low, depth})
beam({-half - thick, high, -depth}, {half + thick, high + thick, depth})
beam({-half - thick, low, -depth}, {-half, high, depth})
beam({half, low, -depth}, {half + thick, high, depth})
beam({-half - thick, 0, -depth}, {-half, low - thick, depth})
beam({half, 0, -depth}, {half + thick, low - thick, depth})

game.throw{
    radius = 0.0145,
    rolling_friction = 0.135,
    mass = mass,
    at = {0.15 * game.seeded(1), foot + 0.5 * side + 0.15 * game.seeded(2), 0.8},
    velocity = {0, 0, -speed},
}
local border, rim, out = 0.5 * side, 0.25 * shell.edge, 0.01
game.spawn{
    cooked = pane,
    at = {0, foot, 0},
    strength_scale = shell.strength_scale,
    fracture = shell.fracture,
    quick = shell.quick,
    springs = shell.springs,
    pins = {
        {low = {-border - out, -out, -out}, high = {border + out, rim, out}},
        {low = {-border - out, side - rim, -out}, high = {border + out, side + out, out}},
        {low = {-border - out, -out, -out}, high = {-border + rim, side + out, out}},
        {low = {border - rim, -out, -out}, high = {border + out, side + out, out}},
    },
}
