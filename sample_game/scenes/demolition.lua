-- A street of 20 houses, towers and garden walls of brick, each held by the ground at its foot. 100 explosions come in
-- 20 seconds, five a building: two when its turn comes, then two more and one in what stands or lies there. At most
-- 2,000 pieces live: the oldest that lie still make room for new ones.
game.scene{
    shows = "a street of 20 houses, towers and walls under 100 explosions in 20 seconds",
    seconds = 20,
    sheet = {0, 30, 60, 110, 180, 260, 360, 480, 620, 800, 1000, 1199},
}
local shell = game.shell_keys{material = "brick", thickness = 0.22, edge = 0.39}
local blasts = game.key{name = "scene.explosions", default = 100, least = 1, most = 1000, text = "in 20 seconds"}
local impulse = game.key{name = "scene.impulse_nspm2", unit = "N s/m2", default = 9000, least = 1, most = 1e6, text = "of an explosion at its centre"}
local most = game.key{name = "scene.fragments", default = 2000, least = 10, most = 100000, text = "pieces alive at once"}

game.setting{
    break_share = 0.01,
    debris_elements = 3,
    limits = {bodies = 4096, open_hits = 128, queued_hits = 2048, fragments = most, births_a_frame = 200},
}
local function cook(mesh)
    return game.cook{mesh = mesh, material = shell.material, fracture = shell.cracks, thickness = shell.thickness}
end
local edge = shell.edge
local shapes = {
    cook(game.mesh.house{width = 6, depth = 5, height = 3, roof = 2, edge = edge, seed = 1}),
    cook(game.mesh.house{width = 5, depth = 5, height = 5.6, roof = 1.6, edge = edge, seed = 2}),
    cook(game.mesh.tower{width = 3.2, depth = 3.2, height = 7, roof = 2.4, edge = edge, seed = 3}),
    cook(game.mesh.house{width = 7, depth = 4.6, height = 2.8, roof = 2.4, edge = edge, seed = 4}),
    cook(game.mesh.wall{width = 6, height = 1.8, edge = edge, seed = 5}),
}
local lots = {1, 5, 2, 3, 4, 1, 2, 5, 1, 3}

game.camera{eye = {-50, 26, 44}, target = {-10, 0.5, -1}, field_of_view = 0.62}
game.sun{towards = {0.45, 0.75, 0.6}, strength = 2.4}
game.floor{half_side = 80}
local places = {}
for side = -1, 1, 2 do
    for lot = 1, 10 do
        local shape = lots[(lot + (side > 0 and 3 or 0) - 1) % 10 + 1]
        local at = {8.2 * (lot - 5.5) + 0.4 * game.seeded(20 * lot + side), 0.001, 7.5 * side}
        if shape == 5 then
            at[3] = 6 * side
        end
        places[#places + 1] = at
        game.spawn{
            cooked = shapes[shape],
            at = at,
            -- Doors look to the street.
            turn = {axis = {0, 1, 0}, angle = side > 0 and 3.14159265 or 0},
            strength_scale = shell.strength_scale,
            fracture = shell.fracture,
            quick = shell.quick,
            springs = shell.springs,
            pins = {{low = {-10, -0.01, -10}, high = {10, 0.05, 10}}},
        }
    end
end

-- The oldest that lie still go before the limit is reached: a hundred may be born in a frame and need not wait. A house
-- that cracks all over gives 150, but that is early in the show.
every({frames = 1}, function()
    local over = game.fragments() - (most - 100)
    if over > 0 then
        game.retire{count = over, asleep = true}
    end
end)
-- One building after the other, two explosions each, in an order of chance; and round again.
for last = #places, 2, -1 do
    local other = 1 + math.floor(game.random() * last)
    places[last], places[other] = places[other], places[last]
end
for n = 1, blasts do
    at(19.5 * (n - 0.5) / blasts, function()
        local place = places[1 + (n - 1) // 2 % #places]
        game.explode{
            at = {place[1] + game.random(-2.5, 2.5), game.random(0.5, 2.5), place[3] + game.random(-2, 2)},
            radius = 5,
            impulse = impulse,
        }
    end)
end
