-- Four vases at a time are thrown into a pit of stone, turned in all ways, until enough fragments live; then they come
-- to rest. Nothing is made beforehand: every fragment was broken here.
game.scene{
    shows = "vases are thrown into a pit until 1,000 fragments live, which come to rest",
    seconds = 20,
    sheet = {4, 12, 24, 48, 96, 150, 220, 320, 450, 600, 800, 1199},
}
local shell = game.shell_keys{material = "porcelain", thickness = 0.005, edge = 0.012}
local count = game.key{name = "scene.count", default = 1000, least = 1, most = 4000, text = "live fragments after which no more vases fall"}
local speed = game.key{name = "scene.speed_mps", unit = "m/s", default = 12, least = 0, most = 50, text = "downward at the start"}
local height = game.key{name = "scene.height_m", unit = "m", default = 1.6, least = 0.1, most = 20, text = "of the fall"}
local size = game.key{name = "scene.size_m", unit = "m", default = 0.3, least = 0.05, most = 3, text = "height of a vase"}

local frames_between, most_vases = 14, 120

game.setting{limits = {open_hits = 512}} -- shards meet shards all over the pit
-- Dozens of hits a frame: at the default they would all be late, and vases would bounce whole.
game.at_least{units_a_frame = 100e6}

local vase = game.cook{
    mesh = game.mesh.given{size = size, stands = true} or game.mesh.vase{height = size, edge = shell.edge},
    material = shell.material,
    fracture = shell.cracks,
    thickness = shell.thickness,
    edge = shell.edge,
}
game.camera{eye = {1.0, 3.2, 1.45}, target = {0, 0.3, 0}, field_of_view = 0.72}
game.floor()
-- Walls go down into the ground: standing on it they would press into it what is a millimetre deep in both.
local single = game.single -- numbers as the world holds them, so that the pit stands bit for bit where it always did
local half, top, bottom = single(0.8), 0.5, -0.5
local outer = single(half + single(0.1))
local function wall(low, high)
    game.box{low = low, high = high, colour = {0.33, 0.32, 0.30}}
end
wall({-outer, bottom, -outer}, {outer, top, -half})
wall({-outer, bottom, -half}, {-half, top, half})
wall({half, bottom, -half}, {outer, top, half})
wall({-outer, bottom, half}, {outer, top, outer})

local thrown = 0
local function throw_vase()
    local number, corner = 10 * (thrown + 1), single(0.38)
    local east, north = thrown % 2 == 1, thrown % 4 >= 2
    game.spawn{
        cooked = vase,
        strength_scale = shell.strength_scale,
        fracture = shell.fracture,
        quick = shell.quick,
        springs = shell.springs,
        turn = game.any_turn(number),
        pivot = {0, 0.5 * size, 0},
        at = {
            (east and corner or -corner) + single(0.12 * game.seeded(number + 3)),
            single(height) + 0.5 * single(size),
            (north and corner or -corner) + single(0.12 * game.seeded(number + 4)),
        },
        velocity = {0, -speed, 0},
    }
    thrown = thrown + 1
end
local function throw_four()
    if thrown == most_vases or game.fragments() >= count then
        return false
    end
    for _ = 1, 4 do
        throw_vase()
    end
end
throw_four()
every({frames = frames_between}, throw_four)
