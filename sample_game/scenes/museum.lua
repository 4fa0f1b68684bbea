-- Solids, shells and metal in one room: a stone statue on a plinth, vases, a steel drum, a brick wall; a ball, an
-- explosion and a cut.
game.scene{
    shows = "a stone statue, vases, a steel drum and a brick wall are met by a ball, an explosion and a cut",
    seconds = 10,
    sheet = {0, 24, 30, 36, 44, 66, 72, 80, 96, 130, 170, 599},
}
local cells = game.key{name = "scene.cells", default = 800, least = 200, most = 20000, text = "that the statue may come apart into"}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 11, least = 0, most = 100, text = "of the ball"}
local impulse = game.key{name = "scene.impulse_nspm2", unit = "N s/m2", default = 500, least = 1, most = 1e6, text = "of the explosion at its centre"}

local size, top = 0.8, 0.55
local statue = game.cook{
    mesh = game.mesh.given{size = size, stands = true} or game.mesh.cow{length = size, vertices = 3000},
    material = "concrete", model = "lattice", thickness = 0.1 * size, lattice = {wanted_cells = cells},
}
local vase = game.cook{mesh = game.mesh.vase{height = 0.34, edge = 0.011}, material = "porcelain", thickness = 0.006, edge = 0.011}
local drum = game.cook{mesh = game.mesh.drum{height = 0.88, vertices = 3000}, material = "steel", thickness = 0.001}
local wall = game.cook{mesh = game.mesh.wall{width = 1.6, height = 1.3, edge = 0.1}, material = "brick", thickness = 0.1}
game.fit_budget(wall)

game.camera{eye = {2.3, 1.75, 3.3}, target = {0.1, 0.5, -0.3}, field_of_view = 0.78}
game.sun{towards = {-0.5, 0.75, 0.6}, strength = 2.3}
game.floor()
local function plinth(x, z, half_x, half_z, height)
    game.box{low = {x - half_x, 0, z - half_z}, high = {x + half_x, height, z + half_z}, colour = {0.42, 0.41, 0.39}, finish = "concrete"}
end
plinth(0, 0, 0.6 * size, 0.3 * size, top)
game.spawn{cooked = statue, at = {0, top, 0}, pivot = {0, 0, 0}}
plinth(1.05, 0.1, 0.16, 0.16, 0.7)
plinth(-1.05, 0.1, 0.16, 0.16, 0.7)
game.spawn{cooked = vase, at = {1.05, 0.7, 0.1}}
local cut = game.spawn{cooked = vase, at = {-1.05, 0.7, 0.1}}
game.spawn{cooked = drum, at = {1.3, 0.44, -0.9}}
game.spawn{cooked = wall, at = {-0.5, 0.002, -1.5}, pins = {{low = {-2, -0.01, -0.2}, high = {2, 0.03, 0.2}}}}
-- It meets the statue's shoulder, and what it throws off goes on to the wall.
local way = 2.2
local seconds = way / math.max(speed, 0.1)
game.throw{
    radius = 0.075, mass = 14,
    at = {0.1 * size, top + 0.62 * size, way + 0.2 * size},
    velocity = {0, 0.5 * 9.81 * seconds, -speed},
}
wait{frames = 40}
game.explode{at = {1.2, 0.75, -0.35}, radius = 0.9, impulse = impulse}
wait{frames = 20}
cut:cut{at = {-1.05, 0.89, 0.1}, normal = {-0.66, 0.75, 0.1}}
wait{frames = 30}
game.expect(game.fragments() > 6, "statue and vases broke")
