-- A bowl of solid porcelain, both of its walls modelled, falls on its foot and comes apart into shards.
game.scene{
    shows = "a bowl of solid porcelain (--mesh FILE for another thing) falls on the floor",
    seconds = 6,
    sheet = {0, 8, 12, 14, 16, 20, 26, 34, 46, 70, 120, 359},
}
local material = game.key{name = "scene.material", default = "porcelain", choices = "porcelain, glass, brick, concrete", text = "of the bowl"}
local cells = game.key{name = "scene.cells", default = 1000, least = 200, most = 20000, text = "that it may come apart into"}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 6, least = 0, most = 100, text = "at which it meets the floor"}
local tilt = game.key{name = "scene.tilt_deg", unit = "degrees", default = 12, least = 0, most = 180, text = "off its foot"}
local size = game.key{name = "scene.size_m", unit = "m", default = 0.24, least = 0.02, most = 5, text = "largest side"}

local bowl = game.cook{
    mesh = game.mesh.given{size = size, stands = true} or game.mesh.bowl{width = size, wall = 0.025 * size},
    material = material, model = "lattice", thickness = 0.025 * size, lattice = {wanted_cells = cells},
}
game.camera{eye = {0.45, 0.62, 1.0}, target = {0, 0.06, 0.02}, field_of_view = 0.66}
game.sun{towards = {-0.4, 0.8, 0.5}, strength = 2.3}
game.floor()
-- It is let go a little above the floor, as fast as a fall from higher up would be there.
local gap = 0.6 * size
local start = math.sqrt(math.max(0, speed * speed - 2 * 9.81 * gap))
game.spawn{
    cooked = bowl,
    at = {0, gap + 0.15 * size, 0},
    turn = {axis = {0.3, 0, 1}, angle = tilt * math.pi / 180},
    velocity = {0, -start, 0},
}
