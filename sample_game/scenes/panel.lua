-- A clamped steel panel lies on a frame; heavy balls fall on it, and the last one comes to rest in its dent.
game.scene{
    shows = "balls of 100 kg dent a clamped steel panel",
    seconds = 6,
    sheet = {0, 8, 12, 20, 40, 62, 70, 90, 122, 130, 180, 359},
}
local shell = game.shell_keys{material = "steel", thickness = 0.001, edge = 0.0108}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 5, least = 0, most = 30, text = "of the balls, downward"}
local mass = game.key{name = "scene.mass_kg", unit = "kg", default = 100, least = 0.1, most = 1000, text = "of a ball"}
local count = game.key{name = "scene.count", default = 3, least = 0, most = 50, text = "of balls, one a second"}

local wide, deep, height = 1.2, 0.8, 0.6 -- m
local panel = game.cook{
    mesh = game.mesh.wall{width = wide, height = deep, edge = shell.edge > 0 and shell.edge or 0.0108},
    material = shell.material,
    thickness = shell.thickness,
}
game.camera{eye = {0.4, 2.05, 1.0}, target = {0, 0.55, 0}, field_of_view = 0.62}
game.sun{towards = {-0.9, 0.32, 0.25}, strength = 2.3} -- low, so that a dent is seen
game.floor()
-- The frame: four beams on legs, the panel's border between them.
local x, z, beam = 0.5 * wide + 0.002, 0.5 * deep + 0.002, 0.05
local function bar(low, high)
    game.box{low = low, high = high, colour = {0.16, 0.17, 0.18}, friction = 0.4}
end
bar({-x - beam, height - beam, -z - beam}, {x + beam, height, -z})
bar({-x - beam, height - beam, z}, {x + beam, height, z + beam})
bar({-x - beam, height - beam, -z}, {-x, height, z})
bar({x, height - beam, -z}, {x + beam, height, z})
for _, side in ipairs{-1, 1} do
    for _, front in ipairs{-1, 1} do
        local at_x, at_z = side * (x + 0.5 * beam), front * (z + 0.5 * beam)
        bar({at_x - 0.5 * beam, 0, at_z - 0.5 * beam}, {at_x + 0.5 * beam, height - beam, at_z + 0.5 * beam})
    end
end
local border_x, border_z, rim, out = 0.5 * wide, deep, 0.006, 0.05
game.spawn{
    cooked = panel,
    at = {0, height, 0.5 * deep},
    turn = {axis = {1, 0, 0}, angle = -0.5 * 3.14159265},
    friction = 0.4,
    strength_scale = shell.strength_scale,
    pins = {
        {low = {-border_x - out, -out, -out}, high = {border_x + out, rim, out}},
        {low = {-border_x - out, border_z - rim, -out}, high = {border_x + out, border_z + out, out}},
        {low = {-border_x - out, -out, -out}, high = {-border_x + rim, border_z + out, out}},
        {low = {border_x - rim, -out, -out}, high = {border_x + out, border_z + out, out}},
    },
}
-- Each ball but the last goes away before the next one comes.
local places = {{-0.24, 0.12}, {0.06, 0.14}, {0.3, -0.12}}
local ball
for n = 1, count do
    if ball then ball:remove() end
    local place = places[(n - 1) % #places + 1]
    if n > #places then place = {0.4 * wide * game.random(-1, 1), 0.36 * deep * game.random(-1, 1)} end
    ball = game.throw{
        radius = 0.145,
        mass = mass,
        friction = 0.4,
        rolling_friction = 0.135,
        at = {place[1], height + 0.145 + 0.12 * speed, place[2]},
        velocity = {0, -speed, 0},
    }
    if n < count then wait(1) end
end
wait(2.5)
game.expect(game.fragments() == 0, "nothing came off")
if ball then game.expect(ball:position().y > height - 0.2, "the ball lies in its dent") end
