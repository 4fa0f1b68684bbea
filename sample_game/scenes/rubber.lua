-- A rubber sheet held along its border catches a ball, and throws it back.
game.scene{
    shows = "a framed rubber sheet catches a ball and throws it back",
    seconds = 4,
    sheet = {0, 8, 10, 12, 14, 16, 18, 20, 24, 30, 60, 239},
}
local shell = game.shell_keys{material = "rubber", thickness = 0.004, edge = 0.03}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 6, least = 0, most = 50, text = "of the ball"}
local mass = game.key{name = "scene.mass_kg", unit = "kg", default = 0.6, least = 0.01, most = 100, text = "of the ball"}

local side, foot = 0.8, 0.3 -- m; the sheet's lower border stands at foot

local sheet = game.cook{
    mesh = game.mesh.pane{side = side, edge = shell.edge},
    material = shell.material,
    fracture = shell.cracks,
    thickness = shell.thickness,
}
game.camera{eye = {2.2, 1.45, 2.8}, target = {0, 0.48, 0.75}, field_of_view = 0.8}
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
    radius = 0.07,
    rolling_friction = 0.135,
    mass = mass,
    at = {0.04, foot + 0.55 * side, 0.9},
    velocity = {0, 0.6, -speed},
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
local deepest, fastest_back = 0, 0
every({frames = 1}, function()
    deepest = math.min(deepest, ball:position().z)
    fastest_back = math.max(fastest_back, ball:velocity().z)
    return game.frame() < 200
end)
wait(3.5)
game.note(string.format("the ball came %.3f m deep and flew back at %.2f m/s", -deepest, fastest_back))
game.expect(deepest < 0 and deepest > -0.5, "the ball pressed the sheet in")
game.expect(fastest_back > 0.3 * speed and fastest_back < speed, "it was thrown back slower than it came")
