-- An empty steel drum falls on its rim.
game.scene{
    shows = "an empty steel drum is dropped on its rim",
    seconds = 5,
    sheet = {0, 4, 6, 8, 10, 14, 20, 30, 45, 70, 120, 299},
}
local shell = game.shell_keys{material = "steel", thickness = 0.001, edge = 0}
local height = game.key{name = "scene.height_m", unit = "m", default = 5, least = 0, most = 50, text = "that it falls"}
local tilt = game.key{name = "scene.tilt_deg", unit = "degrees", default = 35, least = 0, most = 90, text = "off its axis; 0: on its bottom"}

local mesh = game.mesh.given{size = 0.88} or game.mesh.drum{}
local drum = game.cook{mesh = mesh, material = shell.material, thickness = shell.thickness, edge = shell.edge}
game.camera{eye = {1.7, 0.75, 2.1}, target = {0, 0.5, 0}, field_of_view = 0.62}
game.floor()
-- It starts a little above the floor, as fast as it is there.
local gap = 0.25
local lean = tilt * math.pi / 180
local low = 0.44 * math.cos(lean) + 0.31 * math.sin(lean)
local body = game.spawn{
    cooked = drum,
    at = {0, low + gap, 0},
    turn = {axis = {0, 0, 1}, angle = lean},
    velocity = {0, -math.sqrt(2 * 9.81 * height), 0},
    strength_scale = shell.strength_scale,
}
wait(4.5)
game.expect(game.fragments() == 0, "nothing came off")
game.expect(body:position().y > 0.1, "it lies on the floor")
