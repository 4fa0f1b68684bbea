// What is squeezed between a press and a floor breaks, dents, bends, or is held between them, whatever it is of. Random
// sizes, walls, speeds and rates; brittle shells stand in crushing_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "systems/world_contents.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/play_script.hpp"

namespace cullet {
namespace {

using test::Draw;
using test::format;

constexpr double kRates[] = {30, 60, 120};
const uint32_t kCases = test::few_or_all(4u, 8u);  // of each test
constexpr double kHalf = 0.5;                      // of the thing's size: of the press
uint32_t cases() {
    return test::cases_of(std::getenv("CULLET_SQUEEZED_CASES"), kCases);
}

/// On the floor, its lowest point just above it.
struct Thing {
    std::string mesh, told;
    double size = 0, height = 0, wall = 0, at = 0;  // m
};
/// `kinds`: the first two are coarse, and soon cooked.
Thing random_thing(Draw& draw, double thinnest, double thickest, uint32_t kinds = 4) {
    Thing t;
    t.size = draw.evenly_in_scale(0.05, 1);
    t.wall = draw.evenly_in_scale(thinnest, thickest) * t.size;
    t.height = t.size;
    const auto kind = static_cast<uint32_t>(draw.engine() % kinds);
    if (kind == 2) {
        t.mesh = format("game.mesh.vase{height = %g, edge = %g}", t.size, 0.07 * t.size);
    } else if (kind == 0) {
        t.mesh = format("game.mesh.ball{radius = %g, subdivisions = %d}", t.size / 2, kinds == 2 ? 2 : 3);
        t.at = t.size / 2;
    } else if (kind == 1) {
        const double wide = draw.within(0.4, 1);
        t.height = draw.within(0.5, 1) * t.size;
        t.mesh = format("game.mesh.box{half_extents = {%g, %g, %g}}", wide * t.size / 2, t.height / 2, t.size / 2);
        t.at = t.height / 2;
    } else {
        t.mesh = format("game.mesh.drum{height = %g}", t.size);
        t.at = t.size / 2;
    }
    constexpr const char* kNames[] = {"ball", "box", "vase", "drum"};
    t.told = format("%s of %.3f m, wall %.2f mm", kNames[kind], t.size, 1000 * t.wall);
    return t;
}

/// A press, thicker than what it comes in a step, that comes down on the thing until a share of its height is left,
/// stands for a second, and leaves if asked.
struct Pressing {
    const char *material, *more = "";
    double speed = 0, left = 0.3;  // m/s; of the height
    bool leaves = false;
};
std::string script_of(const Thing& thing, const Pressing& press) {
    return format(
               "game.scene{shows = 'a press', seconds = 600} game.floor() "
               "local thing = game.spawn{mesh = %s, material = '%s', thickness = %.9g, edge = %g, at = {0, %.9g, "
               "0}%s} ",
               thing.mesh.c_str(), press.material, thing.wall, 0.15 * thing.size, thing.at + 0.0005 * thing.size,
               press.more) +
           format(
               "local press = game.kinematic{half_extents = {%g, %g, %g}, at = {0, %.9g, 0}, velocity = {0, %.9g, 0}} "
               "every({frames = 1}, function() if press:position().y <= %.9g then press:set_velocity{0, 0, 0} return "
               "false end end) ",
               2 * thing.size, kHalf * thing.size, 2 * thing.size, 1.12 * thing.height + kHalf * thing.size,
               -press.speed, press.left * thing.height + kHalf * thing.size) +
           (press.leaves ? format("wait(%g) press:set_velocity{0, %g, 0} ",
                                  (1.12 - press.left) * thing.height / press.speed + 1, press.speed)
                         : std::string());
}

/// Where the press's lower side, and the drawn triangles of all bodies but it, are now, m.
struct Seen {
    double press = 0, low = 1e30, high = -1e30, fastest = 0, mass = 0;
    uint32_t bodies = 0;
};
Seen look(const GameWorld& game, const Thing& thing) {
    Seen seen;
    const World& world = game.world();
    const Bodies& bodies = world.contents().data.state.bodies;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const auto kind = static_cast<BodyKind>(bodies.kind[b]);
        if (kind == BodyKind::Kinematic) seen.press = double{bodies.position[b].y} - kHalf * thing.size;
        if (kind != BodyKind::Dynamic) continue;
        ++seen.bodies;
        seen.mass += bodies.mass[b];
        seen.fastest = std::max(seen.fastest, double{length(bodies.velocity[b])});
        const Result<BodyView> view = world.view({b, bodies.generation[b]});
        if (!view.ok()) continue;
        const Pose pose{bodies.position[b], bodies.orientation[b]};
        for (uint32_t v = 0; v < view->vertex_count; ++v) {
            const double y = double{to_world(pose, view->vertices[v].position).y};
            seen.low = std::min(seen.low, y), seen.high = std::max(seen.high, y);
        }
    }
    return seen;
}

struct Squeezed {
    double deepest = 0;  // m, that press and floor lie in it together, at any time
    double fastest = 0;  // m/s
    uint64_t told = 0;   // squeezed events
    uint32_t pieces = 0;
    Seen end;
    std::string failure;
};
Squeezed play(const Thing& thing, const Pressing& press, double rate, double seconds) {
    RunOptions options;
    options.threads = 2;
    options.dt_ms = 1000 / rate;
    Squeezed out;
    Result<GameWorld> game = GameWorld::create(plan_scene({"press", "press.lua", script_of(thing, press)}, options));
    if (!game.ok()) return out.failure = game.error(), out;
    for (uint32_t frame = 0; frame < rate * seconds && out.failure.empty(); ++frame) {
        game->before_step(), game->step(), game->after_step();
        out.failure = game->failure();
        out.told += game->world().events().squeezed.count;
        out.pieces = game->world().fragments(nullptr, 0);
        out.end = look(*game, thing);
        out.fastest = std::max(out.fastest, out.end.fastest);
        if (out.pieces > 0) break;
        const double deep = std::max(0.0, -out.end.low) + std::max(0.0, out.end.high - out.end.press);
        out.deepest = std::max(out.deepest, deep);
    }
    return out;
}
double seconds_of(const Thing& thing, const Pressing& press) {
    return (1.12 - press.left) * thing.height / press.speed + 0.5;
}
void tell(uint32_t seed, const Thing& thing, const Pressing& press, double rate, const Squeezed& was) {
    std::printf(
        "seed %u: %s %s, %.3f m/s to %.2f, %g steps a second: %.1f mm deep, %.2f m/s, %llu told, from %.1f to "
        "%.1f of %.1f mm, %s\n%s\n",
        seed, press.material, thing.told.c_str(), press.speed, press.left, rate, 1000 * was.deepest, was.fastest,
        static_cast<unsigned long long>(was.told), 1000 * was.end.low, 1000 * was.end.high, 1000 * was.end.press,
        was.failure.c_str(), script_of(thing, press).c_str());
}

void expect_measured(const std::string& mesh, const char* material, double wall) {
    const std::string script = format(
        "game.scene{shows = 'none', seconds = 1} game.spawn{mesh = %s, material = '%s', thickness = %g, at = {0, 1, "
        "0}}",
        mesh.c_str(), material, wall);
    Result<GameWorld> game = GameWorld::create(plan_scene({"one", "one.lua", script}, {}));
    ASSERT_TRUE(game.ok()) << game.error() << script;
    const Structures& structures = game->world().contents().data.state.structures;
    for (uint32_t s = 0; s < structures.size(); ++s) {
        if (structures.users[s] == 0) continue;
        EXPECT_GT(structures.first_crack_speed[s], 0) << script;
        EXPECT_GT(structures.first_crack_force[s], 0) << script;
    }
}

// Wood has a grain, and four times as many links: on a vase no room was left to measure, and any touch was a hit.
TEST(Squeezed, WhateverIsBrittleHasAMeasureOfWhatItBears) {
    expect_measured("game.mesh.vase{height = 0.3}", "wood", 0.005);
    Draw draw{std::mt19937(1)};
    for (const char* material : {"glass", "porcelain", "brick", "concrete", "wood"}) {
        const Thing thing = random_thing(draw, 0.01, 0.05, 2);
        expect_measured(thing.mesh, material, thing.wall);
    }
}

/// Of random things, each pressed as `pressing_of(draw)` says.
template <class PressingOf>
void expect_broken_early(uint32_t first_seed, PressingOf pressing_of) {
    uint32_t wrong = 0;
    for (uint32_t seed = 1; seed <= cases(); ++seed) {
        Draw draw{std::mt19937(first_seed + seed)};
        const Thing thing = random_thing(draw, 0.015, 0.06, 2);
        const Pressing press = pressing_of(draw);
        const double rate = kRates[draw.engine() % 3];
        const Squeezed was = play(thing, press, rate, seconds_of(thing, press));
        // What the press comes while the break is worked off is seen at its end.
        const double most = std::max(0.01, thing.size / 10) + 2 * press.speed / rate;
        if (was.failure.empty() && was.pieces > 0 && was.deepest < most) continue;
        ++wrong;
        tell(seed, thing, press, rate, was);
    }
    EXPECT_EQ(wrong, 0u);
}

TEST(Squeezed, WoodBreaksBeforeAPressIsDeepInIt) {
    expect_broken_early(100, [](Draw& draw) { return Pressing{"wood", "", draw.evenly_in_scale(0.01, 1), 0.3}; });
}

TEST(Squeezed, ASolidBreaksBeforeAPressIsDeepInIt) {
    constexpr const char* kStones[] = {"brick", "concrete", "glass", "porcelain"};
    expect_broken_early(500, [&](Draw& draw) {
        return Pressing{kStones[draw.engine() % 4], ", model = 'lattice', lattice = {wanted_cells = 300}",
                        draw.evenly_in_scale(0.01, 1), 0.3};
    });
}

TEST(Squeezed, SheetMetalIsCrushedAndStaysBetweenPressAndFloor) {
    constexpr const char* kMetals[] = {"steel", "aluminium", "copper"};
    uint32_t wrong = 0;
    for (uint32_t seed = 1; seed <= cases(); ++seed) {
        Draw draw{std::mt19937(200 + seed)};
        const Thing thing = random_thing(draw, 0.002, 0.01);
        const Pressing press{kMetals[draw.engine() % 3], "", draw.evenly_in_scale(0.01, 1), draw.within(0.25, 0.7)};
        const double rate = kRates[draw.engine() % 3];
        const Squeezed was = play(thing, press, rate, seconds_of(thing, press));
        const double most = 0.05 * thing.size + 3 * press.speed / rate;  // it is dented a step later, and falls on
        const double high = was.end.high - was.end.press;
        if (was.failure.empty() && was.deepest < most && high < 0.03 * thing.size && was.fastest < 2 + 3 * press.speed)
            continue;
        ++wrong;
        tell(seed, thing, press, rate, was);
    }
    EXPECT_EQ(wrong, 0u);
}

TEST(Squeezed, RubberIsFlattenedAndStaysBetweenPressAndFloor) {
    uint32_t wrong = 0;
    for (uint32_t seed = 1; seed <= cases(); ++seed) {
        Draw draw{std::mt19937(300 + seed)};
        const Thing thing = random_thing(draw, 0.02, 0.06);
        const Pressing press{"rubber", "", draw.evenly_in_scale(0.02, 1), draw.within(0.4, 0.8)};
        const double rate = kRates[draw.engine() % 3];
        const Squeezed was = play(thing, press, rate, seconds_of(thing, press));
        const double high = was.end.high - was.end.press;
        const double most = 0.1 * thing.size + 2 * press.speed / rate;  // on the way, of both sides together
        if (was.failure.empty() && high < 0.05 * thing.size && was.end.low > -0.05 * thing.size && was.deepest < most)
            continue;
        ++wrong;
        tell(seed, thing, press, rate, was);
    }
    EXPECT_EQ(wrong, 0u);
}

// No game of forces has an answer. It is in both alike, is told of, and lies on the floor when the press has gone.
TEST(Squeezed, WhatCannotGiveWayStaysBetweenThemAndIsToldOf) {
    uint32_t wrong = 0;
    for (uint32_t seed = 1; seed <= cases(); ++seed) {
        Draw draw{std::mt19937(400 + seed)};
        const Thing thing = random_thing(draw, 0.005, 0.05);
        const Pressing press{draw.engine() % 2 ? "steel" : "porcelain", ", breakable = false",
                             draw.evenly_in_scale(0.01, 1), draw.within(0.2, 0.7), true};
        const double rate = kRates[draw.engine() % 3];
        const Squeezed was = play(thing, press, rate, 2 * seconds_of(thing, press) + 2);
        // It is free where it has room to fall by a hundredth of its size, or lies askew.
        const bool is_still = was.fastest < 0.1 + std::sqrt(2 * 9.81 * 0.02 * thing.size) + 1.1 * press.speed;
        const bool is_back = was.end.low > -0.01 * thing.size && was.end.high < 1.05 * thing.size;
        if (was.failure.empty() && was.told == 1 && is_still && is_back) continue;
        ++wrong;
        tell(seed, thing, press, rate, was);
    }
    EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace cullet
