// What is laid on a thing or closes on it, from one and a half times of what it bears up to 200 tonnes, breaks it
// before it is far inside.
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

constexpr double kGravity = 9.81, kMostMass = 200e3, kDue = 1.5;
constexpr double kRates[] = {30, 60, 120};
const uint32_t kCases = test::few_or_all(4u, 24u);  // of each test
uint32_t cases() {
    return test::cases_of(std::getenv("CULLET_CRUSHING_CASES"), kCases);
}

/// On the floor, or a pane over a gap; `bends_at`: N in its middle, where it bends.
struct Thing {
    std::string script, told;
    double size, top, half_width, bends_at = 1e30;  // m
};
/// Every third of the seeds is a solid of the model lattice, and no vase.
bool is_solid_seed(uint32_t seed) {
    return seed % 3 == 0;
}
Thing random_thing(Draw& draw, bool is_solid = false) {
    Thing t;
    const auto kind = static_cast<uint32_t>(is_solid ? 1 + draw.engine() % 3 : draw.engine() % 4);
    t.size = draw.evenly_in_scale(0.05, 1);
    const double size = t.size, wall = std::min(draw.within(0.002, 0.01), size / 12);
    const double edge = draw.within(0.05, 0.1) * size;
    const bool is_glass = draw.engine() % 2;
    std::string mesh;
    double at = 0.0005, gap = 0;
    t.half_width = 0.25 * size;
    t.top = size + at;
    if (kind == 0) {
        mesh = format("game.mesh.vase{height = %g, edge = %g}", size, edge);
    } else if (kind == 1) {
        mesh = format("game.mesh.ball{radius = %g, subdivisions = 3}", size / 2);
        at += size / 2;
    } else if (kind == 2) {
        mesh = format("game.mesh.slab{width = %g, height = %g, thickness = %g, vertices = 500}", size, size,
                      draw.within(0.4, 1) * size);
        t.half_width = 0.2 * size;
    } else {
        const double width = draw.within(0.3, 1) * size, high = 2 * wall, half = 0.4 * size;
        gap = 0.3 * size + 0.02;
        mesh = format("game.mesh.box{half_extents = {%g, %g, %g}}", size / 2, wall, width / 2);
        at += gap + wall;
        t.top = gap + 0.0005 + high;
        for (const double side : {-1.0, 1.0})
            t.script += format("game.box{low = {%g, 0, -1}, high = {%g, %g, 1}} ", side < 0 ? -size : half,
                               side < 0 ? -half : size, gap);
        t.bends_at = (is_glass ? 45e6 : 50e6) * width * high * high / 6 * 2 / half;
        t.half_width = 0.1 * size;
    }
    t.script +=
        format("local thing = game.spawn{mesh = %s, material = '%s', thickness = %g, edge = %g, at = {0, %g, 0}%s} ",
               mesh.c_str(), is_glass ? "glass" : "porcelain", wall, edge, at,
               is_solid ? ", model = 'lattice', lattice = {wanted_cells = 300}" : "");
    constexpr const char* kNames[] = {"vase", "ball", "box", "pane"};
    t.told = format("%s%s %s of %.3f m, wall %.1f mm", is_solid ? "solid " : "", is_glass ? "glass" : "porcelain",
                    kNames[kind], size, 1000 * wall);
    return t;
}

/// A ball, or a block about as wide as the thing, or as wide as it has to be high. On a pane a ball: a block would
/// stand over the edges that bear it.
std::string weight(Draw& draw, const Thing& on, double mass) {
    const double steel = 7850, low = on.top + 0.001;
    if (on.bends_at < 1e30 || draw.engine() % 2) {
        const double radius = std::max(0.3 * on.size, std::cbrt(0.75 * mass / (steel * M_PI)));
        return format(
            "game.throw{mass = %.9g, radius = %.9g, at = {0, %.9g, 0}, velocity = {0, 0, 0}} local half = %.9g ", mass,
            radius, low + radius, radius);
    }
    const double wide = std::max(1.2 * on.size, std::cbrt(mass / (0.5 * steel)));
    const double high = mass / (steel * wide * wide);
    return format(
        "game.spawn{mesh = game.mesh.box{half_extents = {%.9g, %.9g, %.9g}}, material = 'steel', thickness = %g, edge "
        "= "
        "%g, breakable = false, at = {0, %.9g, 0}} local half = %.9g ",
        wide / 2, high / 2, wide / 2, 0.45 * std::min(high, wide), wide, low + high / 2, high / 2);
}

/// Ends with a sentence once `weight` stands more than `most` in what is whole.
std::string watched(const Thing& thing, const std::string& weight, double most) {
    return "game.scene{shows = 'a load', seconds = 60} game.floor() " + thing.script + "local weight = " + weight +
           format(
               "every({frames = 1}, function() if game.fragments() > 0 or not thing:is_alive() then return false end "
               "local p = weight:position() local deep = %.9g - (p.y - half) "
               "if p.x * p.x + p.z * p.z < %.9g then game.expect(deep < %.9g, string.format('%%.4f m in', deep)) end "
               "end) ",
               thing.top, thing.half_width * thing.half_width, most);
}

double force_borne(const GameWorld& game) {
    const State& state = game.world().contents().data.state;
    for (uint32_t b = 0; b < state.bodies.size(); ++b)
        if (state.bodies.is_breakable[b] && state.bodies.structure[b].exists())
            return state.structures.first_crack_force[state.bodies.structure[b]];
    return 0;
}

double mass_of_thing(const GameWorld& game) {
    const State& state = game.world().contents().data.state;
    for (uint32_t b = 0; b < state.bodies.size(); ++b)
        if (state.bodies.is_breakable[b] && state.bodies.structure[b].exists())
            return state.structures.mass[state.bodies.structure[b]];
    return 0;
}

struct Crushed {
    bool is_due = false, is_whole = true;
    double seconds = 0;
    std::string failure;
};
/// `force`: N of the weight, or more than anything bears. What is not due is not played.
Crushed play(const std::string& script, const Thing& thing, double force, double seconds, double rate) {
    RunOptions options;
    options.threads = 2;
    options.dt_ms = 1000 / rate;
    Result<GameWorld> game = GameWorld::create(plan_scene({"crushing", "crushing.lua", script}, options));
    Crushed out;
    if (!game.ok()) return out.is_due = true, out.failure = game.error(), out;
    out.is_due = force > kDue * std::min(force_borne(*game), thing.bends_at);
    for (; out.is_due && out.is_whole && out.seconds < seconds && out.failure.empty(); out.seconds += 1 / rate) {
        game->before_step(), game->step(), game->after_step();
        out.is_whole = game->world().fragments(nullptr, 0) == 0;
        out.failure = game->failure();
    }
    return out;
}

double most_inside(const Thing& thing) {
    return std::max(0.01, thing.size / 10);
}

TEST(Crushing, AWeightOfMoreThanAThingBearsBreaksItBeforeItIsDeepInIt) {
    uint32_t due = 0, wrong = 0;
    for (uint32_t seed = 1; due < cases(); ++seed) {
        Draw draw{std::mt19937(seed)};
        const Thing thing = random_thing(draw, is_solid_seed(seed));
        const double mass = draw.evenly_in_scale(30, kMostMass), rate = kRates[draw.engine() % 3];
        const std::string script = watched(thing, weight(draw, thing, mass), most_inside(thing));
        const Crushed crushed = play(script, thing, kGravity * mass, 1.5, rate);
        due += crushed.is_due;
        if (!crushed.is_due || (!crushed.is_whole && crushed.failure.empty())) continue;
        ++wrong;
        std::printf("seed %u: %s under %.0f kg, %g steps a second, after %.2f s: %s\n%s\n", seed, thing.told.c_str(),
                    mass, rate, crushed.seconds, crushed.failure.c_str(), script.c_str());
    }
    EXPECT_EQ(wrong, 0u);
}

TEST(Crushing, APressOfAMillimetreToHalfAMetreASecondBreaksAThingBeforeItIsDeepInIt) {
    uint32_t wrong = 0;
    for (uint32_t seed = 1; seed <= cases(); ++seed) {
        Draw draw{std::mt19937(1000 + seed)};
        const Thing thing = random_thing(draw, is_solid_seed(seed));
        const double speed = draw.evenly_in_scale(0.001, 0.5), rate = kRates[draw.engine() % 3];
        const double most = most_inside(thing), half = 0.3 * thing.size;
        const std::string press = format(
            "game.kinematic{half_extents = {%g, 0.1, %g}, at = {0, %.9g, 0}, velocity = {0, %.9g, 0}} local half "
            "= 0.1 ",
            half, half, thing.top + 0.1005, -speed);
        // What it comes in the frame that breaks the thing is seen at its end.
        const std::string script = watched(thing, press, most + speed / rate);
        const Crushed crushed = play(script, thing, 1e30, (2 * most) / speed + 0.3, rate);
        if (!crushed.is_whole && crushed.failure.empty()) continue;
        ++wrong;
        std::printf("seed %u: %s, %.4f m/s, %g steps a second, after %.2f s: %s\n%s\n", seed, thing.told.c_str(), speed,
                    rate, crushed.seconds, crushed.failure.c_str(), script.c_str());
    }
    EXPECT_EQ(wrong, 0u);
}

/// A ball on a block that stands on the thing.
std::string on_a_block(Draw& draw, const Thing& thing, double mass, const char* material) {
    const double wide = draw.within(0.2, 0.5) * thing.size, high = draw.within(0.03, 0.2) * thing.size,
                 radius = std::cbrt(0.75 * mass / (7850 * M_PI));
    return format(
               "game.spawn{mesh = game.mesh.box{half_extents = {%g, %g, %g}}, material = '%s', thickness = %g, edge "
               "= 1, breakable = false, at = {0, %.9g, 0}} local half = %.9g ",
               wide, high, wide, material, 0.9 * high, thing.top + 0.001 + high, high) +
           format("game.throw{mass = %.9g, radius = %.9g, at = {0, %.9g, 0}, velocity = {0, 0, 0}} ", mass, radius,
                  thing.top + 0.0015 + 2 * high + radius);
}
constexpr double kSlowToo[] = {20, 30, 60, 120};

// An iterative solver lacks what it takes to carry tonnes through some kilograms, most of all where steps are long.
TEST(Crushing, AWeightOnALightBlockBreaksWhatBearsThemBothAtAnyRate) {
    uint32_t due = 0, wrong = 0;
    for (uint32_t seed = 1; due < cases(); ++seed) {
        Draw draw{std::mt19937(4000 + seed)};
        const Thing thing = random_thing(draw, is_solid_seed(seed));
        if (thing.bends_at < 1e30) continue;  // a block on a pane bends it otherwise than a ball in its middle
        const double mass = draw.evenly_in_scale(100, kMostMass), rate = kSlowToo[draw.engine() % 4];
        const std::string script = watched(thing, on_a_block(draw, thing, mass, "wood"), most_inside(thing));
        const Crushed crushed = play(script, thing, kGravity * mass, 1, rate);
        due += crushed.is_due;
        if (!crushed.is_due || (!crushed.is_whole && crushed.failure.empty())) continue;
        ++wrong;
        std::printf("seed %u: %s under %.0f kg on a block, %g steps a second, after %.2f s: %s\n%s\n", seed,
                    thing.told.c_str(), mass, rate, crushed.seconds, crushed.failure.c_str(), script.c_str());
    }
    EXPECT_EQ(wrong, 0u);
}

// Of what is many times as heavy as the thing nothing is told: no solver of so few iterations holds it up.
TEST(Crushing, AWeightOfHalfOfWhatAThingBearsStandsOnABlockOnItAtAnyRate) {
    constexpr double kMostRatio = 300;
    uint32_t played = 0, wrong = 0;
    for (uint32_t seed = 1; played < cases(); ++seed) {
        Draw draw{std::mt19937(5000 + seed)};
        const Thing thing = random_thing(draw, is_solid_seed(seed));
        if (thing.bends_at < 1e30) continue;
        const double share = draw.within(0.3, 0.5), rate = kSlowToo[draw.engine() % 4];
        const std::string scene = "game.scene{shows = 'a load', seconds = 60} game.floor() " + thing.script;
        Result<GameWorld> alone = GameWorld::create(plan_scene({"crushing", "crushing.lua", scene}, {}));
        ASSERT_TRUE(alone.ok()) << alone.error();
        const double mass = share * force_borne(*alone) / kGravity;
        if (mass > kMostRatio * mass_of_thing(*alone)) continue;
        ++played;
        const std::string script = scene + "local weight = " + on_a_block(draw, thing, mass, "steel");
        const Crushed crushed = play(script, thing, 1e30, 0.4, rate);
        ASSERT_EQ(crushed.failure, "") << script;
        if (crushed.is_whole) continue;
        ++wrong;
        std::printf(
            "seed %u: %s under %.0f kg on a block, %.2f of what it bears, %g steps a second, after %.2f s\n%s\n", seed,
            thing.told.c_str(), mass, share, rate, crushed.seconds, script.c_str());
    }
    EXPECT_EQ(wrong, 0u);
}

/// m, that the deepest contact of what is breakable lies in what is not; of pieces as heavy as this share of the thing.
double deepest_in(const GameWorld& game, double share) {
    const WorldData& data = game.world().contents().data;
    const Bodies& bodies = data.state.bodies;
    const auto counts = [&](uint32_t b) {
        const Row<Structures> shell = b == kNoRigid ? Row<Structures>{} : bodies.structure[b];
        return shell.exists() && bodies.is_breakable[b] &&
               data.state.structures.mass[shell] > share * data.state.structures.intact_mass[shell];
    };
    double deepest = 0;
    for (const RigidContact& c : data.rigid->contacts())
        if (counts(c.a) != counts(c.b)) deepest = std::max(deepest, -static_cast<double>(c.distance));
    return deepest;
}

// The thing bears it: what stands or weighs many times as much would be in it all the same.
TEST(Crushing, WhatAHeavyWeightSinksIntoComesApartBeforeAnythingIsDeepInIt) {
    constexpr double kMost = 0.01;  // m
    uint32_t wrong = 0, whole = 0;
    for (uint32_t seed = 1; seed <= cases(); ++seed) {
        Draw draw{std::mt19937(2000 + seed)};
        const double size = draw.within(0.06, 0.25), wall = draw.within(0.004, 0.01),
                     width = draw.within(0.3, 1) * size;
        const double side = 0.5 * size, mass = draw.within(100, 1000) * 2400 * size * width * 2 * wall;
        const double high = mass / (7850 * side * side), top = 0.3005 + 2 * wall, rate = kRates[draw.engine() % 3];
        Thing thing{"", format("pane of %.3f m, %.1f mm, under %.0f kg", size, 2000 * wall, mass), size, top, 1, 1e30};
        for (const double x : {-0.7 * size, 0.4 * size})
            thing.script += format("game.box{low = {%g, 0, -1}, high = {%g, 0.3, 1}} ", x, x + 0.3 * size);
        thing.script += format(
            "local thing = game.spawn{mesh = game.mesh.box{half_extents = {%g, %g, %g}}, material = 'porcelain', "
            "thickness = %g, edge = %g, at = {0, %.9g, 0}} ",
            size / 2, wall, width / 2, wall, 0.08 * size, 0.3005 + wall);
        const std::string slab = format(
            "game.spawn{mesh = game.mesh.box{half_extents = {%g, %g, %g}}, material = 'steel', thickness = %g, edge = "
            "%g, breakable = false, at = {0, %.9g, 0}} local half = %.9g ",
            side / 2, high / 2, side / 2, 0.45 * std::min(high, side), side, top + 0.001 + high / 2, high / 2);
        RunOptions options;
        options.threads = 2;
        options.dt_ms = 1000 / rate;
        const std::string script =
            "game.scene{shows = 'a load', seconds = 60} game.floor() " + thing.script + "local weight = " + slab;
        Result<GameWorld> game = GameWorld::create(plan_scene({"crushing", "crushing.lua", script}, options));
        ASSERT_TRUE(game.ok()) << game.error();
        double deepest = 0;
        for (double t = 0; t < 1.5 && game->world().fragments(nullptr, 0) == 0; t += 1 / rate) {
            game->before_step(), game->step(), game->after_step();
            deepest = std::max(deepest, deepest_in(*game, 0.5));
        }
        whole += game->world().fragments(nullptr, 0) == 0;
        if (deepest < kMost) continue;
        ++wrong;
        std::printf("seed %u: %s, %g steps a second: %.1f mm\n%s\n", seed, thing.told.c_str(), rate, 1000 * deepest,
                    script.c_str());
    }
    std::printf("%u of %u bear it\n", whole, cases());
    EXPECT_EQ(wrong, 0u);
    EXPECT_LT(whole, cases() / 2);
}

// Pieces that have broken as often as blows may break them stood half in the door.
TEST(Crushing, ADoorThatClosesToAGapLeavesNoLargePieceDeepInIt) {
    for (uint32_t seed = 1; seed <= 3; ++seed) {
        Draw draw{std::mt19937(3000 + seed)};
        const double height = draw.within(0.2, 0.35), speed = draw.within(0.08, 0.2), gap = draw.within(0.015, 0.03);
        const std::string script = format(
            "game.scene{shows = 'a door closes', seconds = 60} game.floor() "
            "game.box{low = {-0.6, 0, -0.5}, high = {-0.4, 1, 0.5}} "
            "game.spawn{mesh = game.mesh.vase{height = %g, edge = %g}, material = 'porcelain', thickness = 0.005, at = "
            "{-0.2, 0.001, 0}} "
            "local door = game.kinematic{half_extents = {0.03, 0.5, 0.5}, at = {0.1, 0.501, 0}, velocity = {%g, 0, 0}} "
            "every({frames = 1}, function() if door:position().x <= %g then door:set_velocity{0, 0, 0} return false "
            "end "
            "end)",
            height, height / 20, -speed, gap - 0.37);
        RunOptions options;
        options.threads = 2;
        Result<GameWorld> game = GameWorld::create(plan_scene({"door", "door.lua", script}, options));
        ASSERT_TRUE(game.ok()) << game.error();
        const double seconds = 0.5 / speed + 1;
        for (double t = 0; t < seconds; t += 1 / 60.0) game->before_step(), game->step(), game->after_step();
        const double deep = deepest_in(*game, 0.06);
        std::printf("vase of %.3f m, gap of %.1f mm: %u pieces, large ones %.1f mm deep\n", height, 1000 * gap,
                    game->world().fragments(nullptr, 0), 1000 * deep);
        EXPECT_GT(game->world().fragments(nullptr, 0), 10u);
        EXPECT_LT(deep, 0.01);
    }
}

// The first touch opens a run that takes three quarters of a second and cracks nothing.
TEST(Crushing, AFineVaseBreaksUnderAPressAsSoonAsACoarseOne) {
    for (const double edge : {0.005, 0.02}) {
        Thing thing{"", "vase", 0.3, 0.301, 0.1};
        thing.script = format(
            "local thing = game.spawn{mesh = game.mesh.vase{height = 0.3, edge = %g}, material = 'porcelain', "
            "thickness "
            "= 0.004, at = {0, 0.001, 0}} ",
            edge);
        const std::string press =
            "game.kinematic{half_extents = {0.5, 0.1, 0.5}, at = {0, 0.402, 0}, velocity = {0, -0.3, 0}} local half = "
            "0.1 ";
        const Crushed crushed = play(watched(thing, press, 0.01), thing, 1e30, 0.3, 60);
        EXPECT_EQ(crushed.failure, "");
        EXPECT_FALSE(crushed.is_whole) << edge;
    }
}

}  // namespace
}  // namespace cullet
