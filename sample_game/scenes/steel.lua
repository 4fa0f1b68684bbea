-- A steel plate held along its border is struck by a ball, and stays dented: by the springs of the thick shell. The
-- scene panel has the same by its sub-shells, which is what steel is by itself.
game.scene{
    shows = "a ball dents a framed steel plate, which stays dented",
    seconds = 4,
    sheet = {0, 6, 8, 9, 10, 11, 12, 14, 17, 22, 60, 239},
}
local shell = game.shell_keys{material = "steel", thickness = 0.0015, edge = 0.04}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 8, least = 0, most = 100, text = "of the ball"}
local mass = game.key{name = "scene.mass_kg", unit = "kg", default = 4, least = 0.01, most = 1000, text = "of the ball"}

local side, foot = 0.8, 0.3 -- m; the plate's lower border stands at foot

local plate = game.cook{
    mesh = game.mesh.pane{side = side, edge = shell.edge},
    model = "thick_shell",
    material = shell.material,
    fracture = shell.cracks,
    thickness = shell.thickness,
}
game.camera{eye = {1.5, 1.25, 1.85}, target = {0.08, 0.54, 0.3}, field_of_view = 0.8}
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
    radius = 0.09,
    rolling_friction = 0.135,
    mass = mass,
    at = {0.05, foot + 0.55 * side, 0.9},
    velocity = {0, 0.5, -speed},
}
local border, rim, out = 0.5 * side, 0.25 * shell.edge, 0.02
game.spawn{
    cooked = plate,
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
wait(3.5)
game.expect(game.fragments() == 0, "nothing came off")
game.expect(ball:position().z > 0, "the ball did not go through")
