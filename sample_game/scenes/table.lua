-- A top of solid glass lies on four legs; a ball falls on it, and large pieces come down.
game.scene{shows = "a ball falls on a table top of solid glass", seconds = 6, sheet = {0, 18, 24, 26, 30, 36, 44, 54, 70, 100, 150, 359}}
local cells = game.key{name = "scene.cells", default = 1500, least = 200, most = 20000, text = "that the top may come apart into"}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 2, least = 0, most = 50, text = "of the ball, downward"}
local mass = game.key{name = "scene.mass_kg", unit = "kg", default = 10, least = 0.01, most = 1000, text = "of the ball"}
local wide, deep, thick, height = 1.2, 0.7, 0.012, 0.7 -- m
local top = game.cook{
    mesh = game.mesh.box{half_extents = {0.5 * wide, 0.5 * thick, 0.5 * deep}},
    material = "glass", model = "lattice", thickness = thick, lattice = {wanted_cells = cells},
}
game.camera{eye = {1.35, 1.45, 1.75}, target = {0, 0.4, 0}, field_of_view = 0.72}
game.sun{towards = {-0.5, 0.75, 0.6}, strength = 2.3}
game.floor()
for _, x in ipairs{-1, 1} do
    for _, z in ipairs{-1, 1} do
        local at_x, at_z = x * (0.5 * wide - 0.08), z * (0.5 * deep - 0.08)
        game.box{low = {at_x - 0.03, 0, at_z - 0.03}, high = {at_x + 0.03, height, at_z + 0.03}, colour = {0.28, 0.17, 0.09}}
    end
end
game.spawn{cooked = top, at = {0, height + 0.5 * thick, 0}}
game.throw{radius = 0.08, mass = mass, at = {0.12, height + thick + 0.9, 0.05}, velocity = {0, -speed, 0}}
