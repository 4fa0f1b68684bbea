-- What a game may do without a thing that strikes: an explosion beside a vase, a cut through another, and a shape that is
-- cut out of a third and then knocked out.
game.scene{
    shows = "an explosion beside a vase, a cut through another, a star-shaped hole in a third",
    seconds = 4,
    sheet = {0, 12, 14, 17, 20, 26, 34, 46, 60, 90, 140, 239},
}
local shell = game.shell_keys{material = "porcelain", thickness = 0.005, edge = 0.0075}
local impulse = game.key{name = "scene.impulse_nspm2", unit = "N s/m2", default = 350, least = 1, most = 1e5, text = "of the explosion at its centre"}

game.camera{eye = {0.1, 0.55, 1.75}, target = {0.05, 0.18, 0}, field_of_view = 0.7}
game.floor()
local vase = game.cook{
    mesh = game.mesh.vase{height = 0.3, edge = shell.edge},
    material = shell.material,
    fracture = shell.cracks,
    thickness = shell.thickness,
    edge = shell.edge,
}
local function stand(x)
    return game.spawn{cooked = vase, strength_scale = shell.strength_scale, fracture = shell.fracture, quick = shell.quick, springs = shell.springs, at = {x, 0, 0}}
end
local blown, cut, pierced = stand(-0.5), stand(0.05), stand(0.5)
-- Something that does not break is thrown, too.
local ball = game.throw{radius = 0.03, rolling_friction = 0.135, mass = 0.3, at = {-0.62, 0.03, 0.28}, velocity = {0, 0, 0}}

wait{frames = 12}
game.explode{at = {-0.5, 0.14, 0.22}, radius = 0.45, impulse = impulse}
-- Askew, so that the upper half slides off.
cut:cut{at = {0.05, 0.17, 0}, normal = {0.62, 0.78, 0}}
-- A closed line of ten points, through the front wall and the one behind.
local star = {}
for i = 0, 10 do
    local angle, radius = 0.62832 * i, i % 2 == 0 and 0.055 or 0.026
    star[i + 1] = {0.5 + radius * math.sin(angle), 0.15 + radius * math.cos(angle), 0}
end
pierced:cut{points = star, direction = {0, 0, 1}}
wait{frames = 20}
game.expect(game.fragments() > 4, "the explosion broke the vase, and the cuts made pieces")
local velocity = ball:velocity()
game.expect(velocity.x < 0, "the explosion throws the ball away from it")
