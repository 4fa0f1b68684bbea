-- 2.4 x 1.8 m of brick whose lowest row is held by the ground; the ball comes from the front, at least 0.4 m from the
-- edges.
game.scene{
    shows = "a ball of 30 kg goes through a brick wall whose foot is held",
    seconds = 10,
    sheet = {0, 8, 10, 12, 15, 18, 24, 32, 45, 70, 140, 599},
}
local shell = game.shell_keys{material = "brick", thickness = 0.1, edge = 0.078}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 10, least = 0, most = 100, text = "of the ball"}
local mass = game.key{name = "scene.mass_kg", unit = "kg", default = 30, least = 0.01, most = 1e5, text = "of the ball"}

local wall = game.cook{
    mesh = game.mesh.wall{width = 2.4, height = 1.8, edge = shell.edge},
    material = shell.material,
    fracture = shell.cracks,
    thickness = shell.thickness,
}
game.camera{eye = {1.9, 1.5, 3.0}, target = {-0.05, 0.75, -0.1}, field_of_view = 0.72}
game.floor()
game.throw{
    radius = 0.14,
    rolling_friction = 0.135,
    mass = mass,
    at = {0.5 * game.seeded(1), 0.95 + 0.3 * game.seeded(2), 1.5},
    velocity = {0, 1.2, -speed}, -- at 10 m/s it flies level when it arrives
}
game.spawn{
    cooked = wall,
    at = {0, 0.002, 0},
    strength_scale = shell.strength_scale,
    fracture = shell.fracture,
    quick = shell.quick,
    springs = shell.springs,
    pins = {{low = {-2, -0.01, -2 * shell.thickness}, high = {2, 0.25 * shell.edge, 2 * shell.thickness}}},
}
