-- The middle of the vase falls a little outside of the table's front edge, so that the belly meets the edge and shards
-- go on to the floor.
game.scene{
    shows = "a porcelain vase falls on the edge of a table, and its shards on the floor",
    seconds = 10,
    sheet = {26, 32, 38, 41, 44, 48, 54, 62, 72, 90, 150, 599},
}
local shell = game.shell_keys{material = "porcelain", thickness = 0.005, edge = 0.0075, crack_length = 1} -- round the whole vase
local height = game.key{name = "scene.height_m", unit = "m", default = 1.5, least = 0.01, most = 20, text = "of the fall onto the table"}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 0, least = 0, most = 50, text = "downward at the start"}
local size = game.key{name = "scene.size_m", unit = "m", default = 0.3, least = 0.05, most = 3, text = "height of the vase"}

local table_height, table_depth = 0.75, 0.8
local seeded, single = game.seeded, game.single

-- Of the vase's middle. Each step is rounded as single precision does, so that the vase falls bit for bit as it always
-- did.
local function middle()
    local length = single(size)
    local y = single(single(table_height + 0.5 * length) + single(height))
    local beyond = single(single(single(0.05) * length) * single(1 + seeded(5)))
    return {0.2 * seeded(4), y, 0.5 * single(table_depth) + beyond}
end

local vase = game.cook{
    mesh = game.mesh.given{size = size, stands = true} or game.mesh.vase{height = size, edge = shell.edge},
    material = shell.material,
    fracture = shell.cracks,
    thickness = shell.thickness,
    edge = shell.edge,
}
game.sun{towards = {-0.35, 0.8, 0.5}, strength = 2.3}
game.floor()
game.static{mesh = game.mesh.table{width = 1.2, depth = table_depth, height = table_height}, colour = {0.28, 0.17, 0.09}, finish = "wood"}
local whole = game.spawn{
    cooked = vase,
    strength_scale = shell.strength_scale,
    fracture = shell.fracture,
    quick = shell.quick,
    springs = shell.springs,
    at = middle(),
    pivot = {0, 0.5 * size, 0},
    turn = {axis = {seeded(1), 0.2, seeded(2)}, angle = 0.35 + 0.35 * seeded(3)},
    velocity = {0, -speed, 0},
}

-- From the side. The camera is near the vase while it falls; from the first crack on it draws back until it holds the
-- shards, which come to rest up to two metres in front of the table.
local wide = {eye = {-2.47, 1.61, 2.68}, target = {-0.12, 0.43, 1.26}}
local near = math.min(1, 0.45 * size / 0.3) -- of the wide view's distance
local seconds_to_wide = 0.5
local followed, broke_at = whole:position(), nil

local function between(share, a, b)
    return a + share * (b - a)
end
local function look()
    local broken = game.count("fragment_born") + game.count("debris") > 0
    if broken and not broke_at then
        broke_at = game.time()
    elseif not broken then
        followed = whole:position()
    end
    local share = broke_at and math.min(1, (game.time() - broke_at) / seconds_to_wide) or 0
    share = share * (2 - share) -- quickly at first: shards are quicker than what stays on the table
    local distance = between(share, near, 1)
    local target = {
        between(share, followed.x, wide.target[1]),
        between(share, followed.y, wide.target[2]),
        between(share, followed.z, wide.target[3]),
    }
    local eye = {}
    for axis = 1, 3 do
        eye[axis] = target[axis] + distance * (wide.eye[axis] - wide.target[axis])
    end
    game.camera{eye = eye, target = target, field_of_view = 0.74}
    return share < 1
end
look()
every({frames = 1}, look)
