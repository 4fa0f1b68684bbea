-- Too large for the hidden run of a frame: it breaks quickly, near the hits alone (--set scene.fracture=hidden for the
-- other way, scene.cracks=fine or coarse for other kinds of cracks).
game.scene{
    shows = "three cannon balls at a castle of 11,000 vertices, which breaks quickly",
    seconds = 6,
    sheet = {0, 8, 10, 12, 15, 20, 30, 45, 70, 110, 180, 359},
}
local shell = game.shell_keys{material = "porcelain", thickness = 0.025, fracture = "quick"}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 26, least = 0, most = 200, text = "of the balls"}
local mass = game.key{name = "scene.mass_kg", unit = "kg", default = 120, least = 0.1, most = 1e5, text = "of each ball"}
local vertices = game.key{name = "scene.vertices", unit = "1", default = 11000, least = 4472, most = 60000, text = "of the castle"}

local castle = game.cook{
    mesh = game.mesh.castle{width = 3, vertices = vertices},
    material = shell.material,
    fracture = shell.cracks,
    thickness = shell.thickness,
    edge = shell.edge,
}
if shell.fracture == "hidden" then
    game.fit_budget(castle)
end
-- A hit is some 8 million units here. At the default budget it is decided within a frame, which it is seen in; at this
-- one it takes four: its neighbourhood is copied and woken, it cracks in the next two, it is handed on. Castle and ball
-- are held so long.
if shell.fracture == "quick" then
    game.setting{units_a_frame = 2.2e6}
end
game.camera{eye = {3.9, 2.9, 6.3}, target = {0, 1.08, 0.2}, field_of_view = 0.6}
game.floor()
game.spawn{
    cooked = castle,
    at = {0, 0.001, 0},
    strength_scale = shell.strength_scale,
    fracture = shell.fracture,
    quick = shell.quick,
    springs = shell.springs,
    pins = {{low = {-2, -0.01, -2}, high = {2, 0.01, 2}}},
}
game.throw{radius = 0.13, rolling_friction = 0.135, mass = mass, at = {1.15, 0.72, 3.2}, velocity = {0, 0.36, -speed}}
game.throw{radius = 0.13, rolling_friction = 0.135, mass = mass, at = {-1.15, 0.95, 5.8}, velocity = {0, 0.8, -speed}}
game.throw{radius = 0.13, rolling_friction = 0.135, mass = mass, at = {0.3, 1.5, 12}, velocity = {0, 1.6, -speed}}
