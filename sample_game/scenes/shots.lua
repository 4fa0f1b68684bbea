-- Sheet steel is shot and tears: holes with petals, and a small one; a drum is shot through its side.
game.scene{
    shows = "sheet steel is shot and tears, as the side of a drum does",
    seconds = 4,
    sheet = {0, 4, 6, 8, 20, 28, 32, 44, 54, 58, 70, 239},
}
local shell = game.shell_keys{material = "steel", thickness = 0.001, edge = 0.02}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 19, least = 0, most = 100, text = "of the slowest ball at the sheet"}

local side, foot = 1.0, 0.3 -- m; the sheet's lower border stands at foot
local sheet = game.cook{
    mesh = game.mesh.wall{width = side, height = side, edge = shell.edge},
    material = shell.material,
    thickness = shell.thickness,
}
local drum = game.cook{mesh = game.mesh.drum{}, material = shell.material, thickness = shell.thickness}
game.camera{eye = {1.5, 1.25, -2.1}, target = {0.5, 0.62, 0}, field_of_view = 0.85}
game.sun{towards = {0.5, 0.6, -0.6}, strength = 2.2}
game.floor()
local dark = {0.16, 0.17, 0.18}
local function beam(low, high)
    game.box{low = low, high = high, colour = dark}
end
local half, thick, depth, low = 0.5 * side + 0.002, 0.03, 0.02, foot - 0.002
local high = low + 2 * half
beam({-half - thick, low - thick, -depth}, {half + thick, low, depth})
beam({-half - thick, high, -depth}, {half + thick, high + thick, depth})
beam({-half - thick, low, -depth}, {-half, high, depth})
beam({half, low, -depth}, {half + thick, high, depth})
beam({-half - thick, 0, -depth}, {-half, low - thick, depth})
beam({half, 0, -depth}, {half + thick, low - thick, depth})
local border, rim, out = 0.5 * side, 0.25 * shell.edge, 0.02
game.spawn{
    cooked = sheet,
    at = {0, foot, 0},
    friction = 0.4,
    strength_scale = shell.strength_scale,
    pins = {
        {low = {-border - out, -out, -out}, high = {border + out, rim, out}},
        {low = {-border - out, side - rim, -out}, high = {border + out, side + out, out}},
        {low = {-border - out, -out, -out}, high = {-border + rim, side + out, out}},
        {low = {border - rim, -out, -out}, high = {border + out, side + out, out}},
    },
}
game.spawn{cooked = drum, at = {1.35, 0.445, -0.2}, strength_scale = shell.strength_scale}
game.box{low = {-3, 0, -4.9}, high = {4, 2.2, -4.6}, colour = {0.38, 0.40, 0.42}, finish = "concrete"}
-- Each comes a little after the one before.
local function shoot(x, y, from_z, radius, mass, fast)
    return game.throw{radius = radius, mass = mass, at = {x, y, from_z}, velocity = {0, 0, -fast}}
end
local through = shoot(-0.22, foot + 0.68, 1.2, 0.1, 50, speed)
wait(0.4)
shoot(0.24, foot + 0.66, 1.2, 0.07, 12, 2.2 * speed)
wait(0.4)
shoot(-0.05, foot + 0.26, 1.2, 0.03, 2, 4 * speed)
shoot(1.35, 0.5, 1.9, 0.025, 0.4, 6 * speed)
wait(2.5)
game.expect(through:position().z < -0.3, "the ball went through the sheet")
