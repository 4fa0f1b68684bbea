-- A cloth held along its whole border is struck by a heavy ball, and tears.
game.scene{
    shows = "a heavy ball tears through a framed sheet",
    seconds = 5,
    sheet = {0, 6, 8, 10, 12, 14, 17, 22, 30, 45, 90, 299},
}
local shell = game.shell_keys{material = "cloth", thickness = 0.0004, edge = 0.035}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 16, least = 0, most = 100, text = "of the ball"}
local mass = game.key{name = "scene.mass_kg", unit = "kg", default = 8, least = 0.01, most = 1000, text = "of the ball"}

local side, foot = 1.0, 0.3 -- m; the sheet's lower border stands at foot

local sheet = game.cook{
    mesh = game.mesh.pane{side = side, edge = shell.edge},
    material = shell.material,
    fracture = shell.cracks,
    thickness = shell.thickness,
}
game.camera{eye = {1.9, 1.4, 2.6}, target = {0, 0.64, -0.1}, field_of_view = 0.8}
game.floor()
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

local ball = game.throw{
    radius = 0.1,
    rolling_friction = 0.135,
    mass = mass,
    at = {0.03, foot + 0.5 * side, 1.4},
    velocity = {0, 0.4, -speed},
}
local border, rim, out = 0.5 * side, 0.25 * shell.edge, 0.02
game.spawn{
    cooked = sheet,
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
wait(1)
game.expect(ball:position().z < -0.3, "the ball tore through")
wait(3.5)
