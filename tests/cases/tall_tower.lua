-- A tower of 20 m with a wall of a third of a metre falls from 10 m: it breaks, and what is left of it lies on the
-- ground. See `rest` of the report.
game.scene{shows = "a tower of 20 m comes down", seconds = 50}
local height = game.key{name = "scene.height_m", unit = "m", default = 20, least = 1, most = 40, text = "of the tower"}
local turn = game.key{name = "scene.turn", unit = "1", default = 1, least = 1, most = 100, text = "which way it is turned, by number"}
local tower = game.cook{mesh = game.mesh.vase{height = height, edge = height / 24}, material = "porcelain", thickness = height / 60}
game.fit_budget(tower)
game.camera{eye = {2 * height, 0.8 * height, 2 * height}, target = {0, 0.3 * height, 0}, field_of_view = 0.9}
game.floor()
game.spawn{cooked = tower, pivot = {0, 0.5 * height, 0}, at = {0, 1.1 * height, 0}, turn = game.any_turn(math.floor(turn))}
wait(49)
local pieces, awake = 0, 0
for _, b in ipairs(game.bodies()) do
    if b:mass() > 0 then
        pieces = pieces + 1
        if not b:is_asleep() then awake = awake + 1 end
    end
end
print(string.format("%d pieces, %d awake", pieces, awake))
game.expect(pieces > 3, "the tower breaks")
game.expect(awake == 0, "all of it comes to rest")
