-- A cloth held at its four corners sags, and catches a ball.
game.scene{
    shows = "a cloth hung by its corners sags and catches a ball",
    seconds = 6,
    sheet = {0, 10, 25, 45, 60, 66, 72, 80, 95, 120, 200, 359},
}
local shell = game.shell_keys{material = "cloth", thickness = 0.0004, edge = 0.035}
local mass = game.key{name = "scene.mass_kg", unit = "kg", default = 0.6, least = 0.01, most = 100, text = "of the ball"}

local side, height = 1.1, 0.9 -- m

local cloth = game.cook{
    mesh = game.mesh.pane{side = side, edge = shell.edge},
    material = shell.material,
    fracture = shell.cracks,
    thickness = shell.thickness,
}
game.camera{eye = {1.5, 1.35, 1.6}, target = {0, 0.6, 0}, field_of_view = 0.8}
game.floor()
local border = 0.5 * side
for _, x in ipairs{-border, border} do
    for _, z in ipairs{-border, border} do
        game.box{low = {x - 0.02, 0, z - 0.02}, high = {x + 0.02, height - 0.05, z + 0.02}, colour = {0.3, 0.24, 0.18}, finish = "wood"}
    end
end
-- The sheet lies in x and z: its y runs towards -z.
local reach, out = 1.6 * shell.edge, 0.05
local pins = {}
for _, x in ipairs{-border, border} do
    for _, y in ipairs{0, side} do
        pins[#pins + 1] = {low = {x - reach, y - reach, -out}, high = {x + reach, y + reach, out}}
    end
end
local sheet = game.spawn{
    cooked = cloth,
    at = {0, height, border},
    turn = {axis = {1, 0, 0}, angle = -0.5 * math.pi},
    strength_scale = shell.strength_scale,
    fracture = shell.fracture,
    quick = shell.quick,
    springs = shell.springs,
    pins = pins,
}
wait(1)
local ball = game.throw{radius = 0.09, rolling_friction = 0.135, mass = mass, at = {0.04, 1.02, 0.03}, velocity = {0, 0, 0}}
wait(4)
local place = ball:position()
game.note(string.format("the ball lies at height %.3f m", place.y))
game.expect(place.y > 0.3 and place.y < height, "the ball lies in the cloth")
game.expect(math.abs(place.x) < 0.3 and math.abs(place.z) < 0.3, "near its middle")
