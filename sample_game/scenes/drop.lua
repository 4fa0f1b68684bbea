-- Any mesh as hollow porcelain, thrown at a wall; what is left falls to the floor.
game.scene{
    shows = "a mesh (--mesh FILE, or a piggy bank) is thrown at a wall as hollow porcelain",
    seconds = 10,
    sheet = {0, 6, 10, 13, 16, 20, 25, 32, 42, 60, 120, 599},
}
local shell = game.shell_keys{material = "porcelain", thickness = 0.006, edge = 0}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 7, least = 0, most = 100, text = "toward the wall"}
local height = game.key{name = "scene.height_m", unit = "m", default = 0.7, least = 0.05, most = 20, text = "of its middle above the floor"}
local size = game.key{name = "scene.size_m", unit = "m", default = 0.4, least = 0.01, most = 10, text = "largest side of the mesh"}
local way = game.key{name = "scene.propagation", default = "guarded_front", choices = "guarded_front, front, single_vertex, single_vertex_tets", text = "how the inner surface is pushed in; all but the first to compare"}
local walls = game.key{name = "scene.walls", default = "joined", choices = "joined, apart", text = "of a mesh that models both: one sheet as thick as measured, or two"}

local mesh = game.mesh.given{size = size}
    or game.mesh.piggy_bank{length = 0.40, edge = shell.edge > 0 and shell.edge or 0.0098}:fit(size)
local thing = game.cook{mesh = mesh, material = shell.material, fracture = shell.cracks, thickness = shell.thickness, edge = shell.edge,
                        propagation = way, join_walls = walls == "joined"}
game.fit_budget(thing)
if size == 0.4 then -- of other sizes the pictures frame what moves
    game.camera{eye = {1.35, 1.06, 1.85}, target = {0.08, 0.34, 0.35}, field_of_view = 0.72}
end
game.floor()
game.box{low = {-1.6, -0.3, -0.3}, high = {1.6, 1.6, 0}, colour = {0.38, 0.40, 0.42}, finish = "concrete"}
game.spawn{
    cooked = thing,
    strength_scale = shell.strength_scale,
    fracture = shell.fracture,
    quick = shell.quick,
    springs = shell.springs,
    at = {0, height, 0.3 + 1.8 * size},
    turn = {axis = {game.seeded(1), 1, game.seeded(2)}, angle = 3.14159265 * game.seeded(3)},
    velocity = {0, 0.1 * speed, -speed},
}
