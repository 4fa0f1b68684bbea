// What a press, or a door, comes down on to a narrow gap: what does not fit there comes apart, and is ground in the
// end.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

#include "components/body_id.hpp"
#include "sample_game/rest.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/play_script.hpp"

namespace cullet {
namespace {

using test::Draw;
using test::format;

const uint32_t kCases = test::few_or_all(4u, 16u);
uint32_t cases() {
    return test::cases_of(std::getenv("CULLET_CRUSHING_CASES"), kCases);
}

/// Between press and thing, or not there. Nothing breaks it, and it weighs little.
struct Block {
    Vec3 half;
    const char* material = "";
    bool exists() const { return half.y > 0; }
};
/// A press that comes down to a gap above the floor, on a vase, a ball or a box; a solid one is no vase.
struct Press {
    std::string script, told;
    double seconds = 0, rate = 60;
    Block block;
};
Block random_block(Draw& draw, double size) {
    constexpr const char* kMaterials[] = {"wood", "steel", "concrete", "aluminium"};
    const auto wide = static_cast<float>(draw.within(0.4, 1.5) * size),
               high = static_cast<float>(std::max(0.02, draw.within(0.04, 0.2) * size));
    return {{wide, high, wide}, kMaterials[draw.engine() % 4]};
}
std::string spawn(const Block& block, double low) {
    const double wide = double{block.half.x}, high = double{block.half.y};
    return format(
        "game.spawn{mesh = game.mesh.box{half_extents = {%g, %g, %g}}, material = '%s', thickness = %g, edge = 1, "
        "breakable = false, at = {0, %g, 0}} ",
        wide, high, wide, block.material, 0.1 * high, low + high);
}
Press random_press(Draw& draw, bool is_solid = false, bool has_block = false) {
    constexpr double kRates[] = {20, 30, 60, 120};
    constexpr const char* kNames[] = {"vase", "ball", "box"};
    constexpr const char* kStones[] = {"brick", "concrete", "glass", "porcelain"};
    const auto kind = static_cast<uint32_t>(is_solid ? 1 + draw.engine() % 2 : draw.engine() % 3);
    const double size = draw.within(0.1, 0.4), wall = draw.within(0.003, 0.008), edge = draw.within(0.06, 0.1) * size;
    const double speed = draw.evenly_in_scale(0.02, 0.5), gap = draw.within(0.05, 0.15) * size;
    const char* material = is_solid ? kStones[draw.engine() % 4] : draw.engine() % 2 ? "glass" : "porcelain";
    std::string mesh = format("game.mesh.vase{height = %g, edge = %g}", size, edge);
    if (kind == 1) mesh = format("game.mesh.ball{radius = %g, subdivisions = 3}", size / 2);
    if (kind == 2)
        mesh = format("game.mesh.slab{width = %g, height = %g, thickness = %g, vertices = 500}", size, size, size / 2);
    Press p;
    p.rate = kRates[draw.engine() % 4];
    if (has_block) p.block = random_block(draw, size);
    if (has_block && speed > 0.004 * p.rate) p.rate = kRates[3];  // it is pushed on a step after it is met
    p.seconds = (size - gap) / speed + 1;
    const double between = 2 * double{p.block.half.y};
    p.script = format(
        "game.scene{shows = 'a press', seconds = 90} game.floor() "
        "game.spawn{mesh = %s, material = '%s', thickness = %g, edge = %g, at = {0, %g, 0}%s} "
        "local press = game.kinematic{half_extents = {%g, 0.1, %g}, at = {0, %.9g, 0}, velocity = {0, %.9g, 0}} "
        "every({frames = 1}, function() if press:position().y <= %.9g then press:set_velocity{0, 0, 0} return false "
        "end end)",
        mesh.c_str(), material, wall, edge, kind == 1 ? size / 2 + 0.001 : 0.001,
        is_solid ? ", model = 'lattice', lattice = {wanted_cells = 500}" : "", 2 * size, 2 * size,
        size + between + 0.102, -speed, gap + between + 0.1 + 0.5 * speed / p.rate);
    if (p.block.exists()) p.script += " " + spawn(p.block, size + 0.0015);
    p.told = format("%s%s %s of %.3f m, wall %.1f mm, %.3f m/s, %g steps a second, gap %.1f mm",
                    is_solid ? "solid " : "", material, kNames[kind], size, 1000 * wall, speed, p.rate, 1000 * gap);
    if (p.block.exists())
        p.told += format(", block of %s %.0f x %.0f mm", p.block.material, 2000 * double{p.block.half.x},
                         2000 * double{p.block.half.y});
    return p;
}

/// Of the point, in a box about the body's frame, m.
double depth_in(Vec3 half, const Pose& pose, Vec3 point) {
    const Vec3 at = to_body(pose, point);
    return double{std::min({half.x - std::fabs(at.x), half.y - std::fabs(at.y), half.z - std::fabs(at.z)})};
}

bool is_block(const Bodies& bodies, uint32_t body) {
    return static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Dynamic && !bodies.is_breakable[body];
}

/// m: of the drawn points of a piece, in a box that the game moves, in the block or below the floor.
struct Depth {
    double deepest = 0;  // less what is allowed: a centimetre, or half of the piece where that is less
    double of = 0, size = 0;
};
/// In the block only what it is pressed on: by its weight alone it breaks no small shards.
Depth deepest_piece(const GameWorld& game, const Block& block, bool is_pressed) {
    const World& world = game.world();
    const WorldData& data = world.contents().data;
    const Bodies& bodies = data.state.bodies;
    Depth worst{-1e30, 0, 0};
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (!bodies.is_breakable[b] || static_cast<BodyKind>(bodies.kind[b]) != BodyKind::Dynamic) continue;
        const Result<BodyView> view = world.view({b, bodies.generation[b]});
        if (!view.ok()) continue;
        double deep = 0;
        for (uint32_t i = 0; i < view->index_count; ++i) {
            const Vec3 point = to_world(pose_of(bodies, b), view->vertices[view->indices[i]].position);
            deep = std::max(deep, -double{point.y});
            for (uint32_t k = 0; k < bodies.size(); ++k) {
                if (static_cast<BodyKind>(bodies.kind[k]) == BodyKind::Kinematic)
                    deep = std::max(deep, depth_in(data.query_index->half_extents(k), pose_of(bodies, k), point));
                if (is_pressed && is_block(bodies, k))
                    deep = std::max(deep, depth_in(block.half, pose_of(bodies, k), point));
            }
        }
        const double size = 2 * double{bodies.radius[b]}, over = deep - std::min(0.01, size / 2);
        if (over > worst.deepest) worst = {over, deep, size};
    }
    return worst;
}

void play_frame(GameWorld& game) {
    game.before_step(), game.step(), game.after_step();
}

/// m, that the block and the press lie in each other.
double press_in_block(const GameWorld& game, const Block& block) {
    const Bodies& bodies = game.world().contents().data.state.bodies;
    double low = 1e30, high = -1e30;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const Pose pose = pose_of(bodies, b);
        if (static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Kinematic) low = double{pose.position.y} - 0.1;
        if (!is_block(bodies, b)) continue;
        for (int k = 0; k < 8; ++k) {
            const Vec3 corner{k & 1 ? block.half.x : -block.half.x, k & 2 ? block.half.y : -block.half.y,
                              k & 4 ? block.half.z : -block.half.z};
            high = std::max(high, double{to_world(pose, corner).y});
        }
    }
    return std::max(0.0, high - low);
}

void expect_nothing_deep(bool is_solid, bool has_block = false) {
    uint32_t wrong = 0;
    for (uint32_t seed = 1; seed <= cases(); ++seed) {
        Draw draw{std::mt19937(seed)};
        const Press press = random_press(draw, is_solid, has_block);
        RunOptions options;
        options.threads = 2;
        options.dt_ms = 1000 / press.rate;
        Result<GameWorld> game = GameWorld::create(plan_scene({"press", "press.lua", press.script}, options));
        ASSERT_TRUE(game.ok()) << game.error();
        for (double t = 0; t < press.seconds; t += 1 / press.rate) play_frame(*game);
        EXPECT_EQ(game->failure(), "");
        const double in_block = press.block.exists() ? press_in_block(*game, press.block) : 0;
        const Depth depth = deepest_piece(*game, press.block, in_block > 0);
        const uint32_t through = static_cast<uint32_t>(measure_rest(*game, 0).through);
        const Matter matter = measure_matter(game->world());
        // Skins of a solid leave a little out each time that it is cut.
        EXPECT_NEAR(matter.mass, game->mass_put_in(), (is_solid ? 1e-3 : 1e-9) * matter.mass);
        std::printf("seed %u: %s: %u pieces, %llu debris, worst %.1f mm of %.1f, %u through, %.1f mm in the block\n",
                    seed, press.told.c_str(), game->world().fragments(nullptr, 0),
                    static_cast<unsigned long long>(game->sums().events["debris"]), 1000 * depth.of, 1000 * depth.size,
                    through, 1000 * in_block);
        if (depth.deepest <= 0 && through == 0) continue;
        ++wrong;
        std::printf("%s\n", press.script.c_str());
    }
    EXPECT_EQ(wrong, 0u);
}

TEST(Grinding, NothingThatAPressComesDownOnStandsDeepInItOrInTheFloor) {
    expect_nothing_deep(false);
}
TEST(Grinding, NorDoesAnythingOfASolid) {
    expect_nothing_deep(true);
}
// What squeezes them is as a part of the press.
TEST(Grinding, NorInABlockThatLiesBetweenPressAndThing) {
    expect_nothing_deep(false, true);
}
TEST(Grinding, NorDoesAnythingOfASolidBelowABlock) {
    expect_nothing_deep(true, true);
}

// A box of 12 cm, pressed to 1 cm in a third of a second.
std::string pressed_box(const char* settings = "") {
    return std::string("game.scene{shows = 'a press', seconds = 60} ") + settings +
           "game.floor()"
           " game.spawn{mesh = game.mesh.slab{width = 0.12, height = 0.12, thickness = 0.06, vertices = 500}, material "
           "= 'porcelain', thickness = 0.007, edge = 0.009, at = {0, 0.001, 0}} "
           "local press = game.kinematic{half_extents = {0.3, 0.1, 0.3}, at = {0, 0.222, 0}, velocity = {0, -0.3, 0}} "
           "every({frames = 1}, function() if press:position().y <= 0.112 then press:set_velocity{0, 0, 0} return "
           "false end end)";
}

Result<GameWorld> world_of(const std::string& script, uint32_t threads = 2) {
    RunOptions options;
    options.threads = threads;
    return GameWorld::create(plan_scene({"press", "press.lua", script}, options));
}

TEST(Grinding, WhatIsGroundIsToldWithItsMassAndIsGone) {
    Result<GameWorld> game = world_of(pressed_box());
    ASSERT_TRUE(game.ok()) << game.error();
    World& world = game->world();
    uint32_t ground = 0;
    for (int frame = 0; frame < 60; ++frame) {
        const uint32_t before = world.bodies(nullptr, 0);
        play_frame(*game);
        const StepEvents events = world.events();
        // A piece may lose debris and be ground in one frame.
        std::set<uint32_t> gone, pressed;
        for (const DebrisEvent& e : events.debris)
            if (!world.is_alive(e.parent)) gone.insert(e.parent.index);
        for (const ImpactEvent& e : events.impacts)
            if (!world.is_alive(e.body) && e.load > 0) pressed.insert(e.body.index);
        EXPECT_EQ(world.bodies(nullptr, 0), before + events.fragments_born.count - gone.size()) << frame;
        EXPECT_EQ(pressed, gone) << frame;
        ground += static_cast<uint32_t>(gone.size());
    }
    EXPECT_GT(ground, 10u);
    EXPECT_NEAR(measure_matter(world).mass, game->mass_put_in(), 1e-9 * game->mass_put_in());
}

TEST(Grinding, IsTheSameOnAnyNumberOfThreads) {
    uint64_t hash = 0;
    for (const uint32_t threads : {1u, 2u, 3u, 8u}) {
        Result<GameWorld> game = world_of(pressed_box(), threads);
        ASSERT_TRUE(game.ok()) << game.error();
        for (int frame = 0; frame < 40; ++frame) play_frame(*game);
        EXPECT_GT(game->sums().events["debris"], 10u);
        if (threads == 1) hash = game->world().hash();
        EXPECT_EQ(game->world().hash(), hash) << threads << " threads";
    }
}

TEST(Grinding, WithoutRoomForDebrisPiecesStayAndItIsSaid) {
    Result<GameWorld> game = world_of(pressed_box("game.setting{limits = {debris = 5}} "));
    ASSERT_TRUE(game.ok()) << game.error();
    for (int frame = 0; frame < 60; ++frame) play_frame(*game);
    EXPECT_EQ(game->sums().events["debris"], 5u);
    EXPECT_GT(game->sums().refused["limits.debris"], 0u);
    EXPECT_NEAR(measure_matter(game->world()).mass, game->mass_put_in(), 1e-9 * game->mass_put_in());
}

TEST(Grinding, WhereOnlyWholeBodiesBreakNoPieceComesApartOrIsGround) {
    Result<GameWorld> game = world_of(pressed_box("game.setting{generations = 0} "));
    ASSERT_TRUE(game.ok()) << game.error();
    for (int frame = 0; frame < 60; ++frame) {
        play_frame(*game);
        for (const FragmentBornEvent& e : game->world().events().fragments_born) EXPECT_EQ(e.generation, 1u);
        for (const DebrisEvent& e : game->world().events().debris) EXPECT_TRUE(game->world().is_alive(e.parent));
    }
}

}  // namespace
}  // namespace cullet
