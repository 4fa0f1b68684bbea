-- Car bodies of sheet steel are thrown into a wall, a pole and another car.
game.scene{
    shows = "car bodies of sheet steel are thrown into a wall, a pole and another car",
    seconds = 4,
    sheet = {0, 3, 5, 7, 9, 12, 16, 22, 32, 50, 90, 239},
}
local shell = game.shell_keys{material = "steel", thickness = 0.001, edge = 0}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 15, least = 0, most = 60, text = "of a car"}
local into = game.key{name = "scene.into", default = "all", choices = "all, wall, pole, car", text = "what they are thrown into"}
local pressure = game.key{name = "scene.crush_kpa", unit = "kPa", default = 35, least = 1, most = 1000, text = "under which a car gives way as a whole"}

local mesh = game.mesh.given{size = 4.4, stands = true} or game.mesh.car{}
local car = game.cook{
    mesh = mesh,
    material = shell.material,
    thickness = shell.thickness,
    edge = shell.edge,
    crush_pressure = 1000 * pressure,
}
game.floor{friction = 0.5}
local half = 0.5 * mesh:size().x
local grey = {0.38, 0.40, 0.42}
local function throw(at_x, at_z, way)
    return game.spawn{
        cooked = car,
        at = {at_x, 0.01, at_z},
        turn = {axis = {0, 1, 0}, angle = way > 0 and 0 or 3.14159265},
        velocity = {way * speed, 0, 0},
        friction = 0.3,
        strength_scale = shell.strength_scale,
    }
end
-- Each lane is 3 m wide; the noses come to x = 0.
local lanes = into == "all" and {"wall", "pole", "car"} or {into}
local gap = 0.04 * speed + 0.02
for n, what in ipairs(lanes) do
    local z = 3.2 * (n - 0.5 * (#lanes + 1))
    throw(-half - gap, z, 1)
    if what == "wall" then game.box{low = {0, 0, z - 1.2}, high = {0.4, 1.8, z + 1.2}, colour = grey, finish = "concrete"} end
    if what == "pole" then game.static{mesh = game.mesh.pole{radius = 0.15, height = 2.4}, at = {0.15, 0, z}} end
    if what == "car" then throw(half + gap, z + 0.25, -1) end
end
if into == "all" then
    game.camera{eye = {7.4, 5.2, 9.0}, target = {0.9, -0.3, 0.7}, field_of_view = 0.72}
else
    game.camera{eye = {2.2, 2.5, 5.2}, target = {-1.2, 0.5, 0}, field_of_view = into == "car" and 0.95 or 0.72}
end
wait(3)
game.expect(game.fragments() == 0, "nothing came off")
