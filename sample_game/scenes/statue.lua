-- A solid statue stands on its plinth; a ball comes from behind, and what breaks off falls to the floor and breaks again.
game.scene{
    shows = "a solid statue (--mesh FILE, or a cow of stone) is struck on its plinth, and falls",
    seconds = 8,
    sheet = {0, 20, 26, 28, 32, 38, 46, 56, 70, 90, 140, 479},
}
local material = game.key{name = "scene.material", default = "concrete", choices = "concrete, brick, porcelain, glass", text = "of the statue"}
local cells = game.key{name = "scene.cells", default = 1000, least = 200, most = 20000, text = "that it may come apart into"}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 10, least = 0, most = 100, text = "of the ball"}
local mass = game.key{name = "scene.mass_kg", unit = "kg", default = 12, least = 0.01, most = 1000, text = "of the ball"}
local size = game.key{name = "scene.size_m", unit = "m", default = 0.9, least = 0.05, most = 10, text = "largest side of the statue"}

local statue = game.cook{
    mesh = game.mesh.given{size = size, stands = true} or game.mesh.cow{length = size, vertices = 3000},
    material = material,
    model = "lattice",
    thickness = 0.1 * size,
    lattice = {wanted_cells = cells},
}
game.camera{eye = {1.9, 1.35, 2.5}, target = {0.1, 0.5, 0}, field_of_view = 0.72}
game.sun{towards = {-0.5, 0.75, 0.6}, strength = 2.3}
game.floor()
local top = 0.6
game.box{low = {-0.6 * size, 0, -0.3 * size}, high = {0.6 * size, top, 0.3 * size}, colour = {0.42, 0.41, 0.39}, finish = "concrete"}
game.spawn{cooked = statue, at = {0, top, 0}, pivot = {0, 0, 0}}
-- It is let go so that it meets the shoulder, as high as that whatever its speed.
local way = 2.5
local seconds = way / math.max(speed, 0.1)
game.throw{
    radius = 0.07,
    mass = mass,
    at = {0.12 * size, top + 0.62 * size, -way - 0.2 * size},
    velocity = {0, 0.5 * 9.81 * seconds, speed},
}
