// What slides over a floor of many parts goes as over one of two triangles.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>

#include "tests/engine/rigid_scenes.hpp"
#include "tests/support/random_sliders.hpp"

namespace cullet {
namespace {

/// Up to one step: of the whole trip to there `top` and `struck`.
struct Trip {
    float top = 0, way = 0, aside = 0, struck = 0;
};
using Trips = std::vector<Trip>;  // of one slider, by steps, as long as there is floor before it

constexpr uint32_t kAbreast = 4;  // lanes
constexpr uint32_t kFirst = 4000, kLimit = 4100;

// `is_level`: as on flat ground, however steep the hill is.
std::unique_ptr<RigidWorld> laid_world(const Floor& floor, const std::vector<Slider>& sliders, bool is_level = false) {
    auto world = make_bullet_world(kLimit);
    world->set_gravity({0, -9.81f, 0});
    add_floor(*world, floor);
    for (uint32_t k = 0; k < sliders.size(); ++k) {
        const Slider& s = sliders[k];
        const float slope = is_level ? 0 : 100 * (floor.height(0.01f, s.side) - floor.height(0, s.side));
        const Pose pose = is_level ? laid_level(floor.height, s) : laid_on(floor.height, s);
        add_slider(*world, kFirst + k, s, pose, {s.speed, slope * s.speed, 0});
    }
    return world;
}

std::vector<Trips> slide(const Floor& floor, const std::vector<Slider>& sliders, float dt) {
    const auto world = laid_world(floor, sliders);
    std::vector<Vec3> from;
    for (uint32_t k = 0; k < sliders.size(); ++k) from.push_back(world->pose(kFirst + k).position);
    std::vector<Trips> trips(sliders.size());
    std::vector<float> struck(sliders.size());
    std::vector<bool> is_over(sliders.size());
    for (int n = 0; real(n) * dt < 1; ++n) {
        world->detect(dt);
        for (const RigidContact& c : world->contacts()) {
            const uint32_t k = std::max(c.a, c.b) - kFirst;
            if (c.distance < 0.001f) struck[k] = std::max(struck[k], c.approach_speed);
        }
        world->solve(dt);
        for (uint32_t k = 0; k < sliders.size(); ++k) {
            const Vec3 p = world->pose(kFirst + k).position;
            is_over[k] = is_over[k] || p.x > kFloorHigh - 1.2f;
            if (is_over[k]) continue;
            const float height = p.y - floor.height(p.x, p.z) - sliders[k].lift;
            const float top = std::max(trips[k].empty() ? 0.0f : trips[k].back().top, height);
            trips[k].push_back({top, p.x - from[k].x, p.z - from[k].z, struck[k]});
        }
    }
    return trips;
}

/// What any of the rulers does, most like `got`. Each of them is as good as the others. On hills the same surface, cut
/// finer once and twice, gives hops that differ by more than 3 mm in 6 of 600 cases. They differ by up to 40, as what
/// has taken off at 20 m/s comes down on another corner.
Trip nearest_of(const std::vector<std::vector<Trips>>& rulers, uint32_t k, size_t step, const Trip& got) {
    Trip nearest = rulers[0][k][step];
    for (const std::vector<Trips>& ruler : rulers) {
        const Trip& trip = ruler[k][step];
        nearest.top = std::max(nearest.top, trip.top), nearest.way = std::min(nearest.way, trip.way);
        nearest.struck = std::max(nearest.struck, trip.struck);
        if (std::fabs(got.aside - trip.aside) < std::fabs(got.aside - nearest.aside)) nearest.aside = trip.aside;
    }
    return nearest;
}

struct Figures {
    uint32_t cases = 0, hops = 0, aside = 0, held = 0, struck = 0, bad = 0;
    float highest = 0;  // m
    void print(const char* of) const {
        std::printf("%s: %u cases: %u hop, the highest %.1f mm; %u turned aside, %u held up, %u struck; %u in all\n",
                    of, cases, hops, 1000 * highest, aside, held, struck, bad);
    }
};

TEST(InnerEdges, WhatSlidesOverAFloorOfManyPartsGoesAsOverOneOfTwoTriangles) {
    const char* wanted = std::getenv("CULLET_INNER_EDGES_CASES");
    const uint32_t grounds = wanted ? static_cast<uint32_t>(std::atoi(wanted)) / kAbreast : 126;
    Figures flat, hills;
    for (uint32_t seed = 0; seed < grounds; ++seed) {
        Chance chance{std::mt19937(seed)};
        const Ground ground = random_ground(chance);
        std::vector<Slider> sliders;
        for (uint32_t k = 0; k < kAbreast; ++k) {
            sliders.push_back(random_slider(chance));
            sliders.back().side = -0.9f + 0.6f * real(k) + chance.between(-0.02f, 0.02f);
        }
        const float dt = chance.below(2) ? 1.0f / 60 : 1.0f / 120;
        const auto all_got = slide(ground.floor, sliders, dt);
        std::vector<std::vector<Trips>> rulers(1, slide(ground.plain, sliders, dt));
        if (ground.is_hill) rulers.push_back(slide(cut_in_four(ground.floor), sliders, dt));
        for (uint32_t k = 0; k < kAbreast; ++k) {
            Figures& figures = ground.is_hill ? hills : flat;
            ++figures.cases;
            size_t steps = all_got[k].size();
            for (const auto& ruler : rulers) steps = std::min(steps, ruler[k].size());
            const Trip got = all_got[k][steps - 1], plain = nearest_of(rulers, k, steps - 1, got);
            const float hop = got.top - plain.top;
            const bool hops = hop > 0.003f, is_aside = std::fabs(got.aside - plain.aside) > 0.02f * plain.way,
                       is_held = got.way<0.95f * plain.way, is_struck = got.struck> plain.struck + 0.5f;
            figures.hops += hops, figures.aside += is_aside, figures.held += is_held, figures.struck += is_struck;
            figures.highest = std::max(figures.highest, hop);
            if (!hops && !is_aside && !is_held && !is_struck) continue;
            ++figures.bad;
            std::printf(
                "seed %u lane %u: %s on %s at %.1f m/s, %.0f steps a second: hop %.1f mm, aside %.1f of %.0f mm, "
                "way %.3f of %.3f m, struck at %.2f (%.2f) m/s\n",
                seed, k, sliders[k].name, ground.floor.name, sliders[k].speed, 1 / dt, 1000 * hop,
                1000 * (got.aside - plain.aside), 1000 * plain.way, got.way, plain.way, got.struck, plain.struck);
        }
    }
    flat.print("flat floors");
    hills.print("hills");
    EXPECT_LE(100 * flat.bad, flat.cases);
    EXPECT_LE(100 * (flat.bad + hills.bad), flat.cases + hills.cases);
    EXPECT_LE(100 * hills.bad, 2 * hills.cases);
    EXPECT_LT(flat.highest, 0.01f);
    EXPECT_LT(hills.highest, 0.01f);
}

/// Four of them, each in its lane, of the kinds from `first` on.
std::vector<Slider> sliders_abreast(Chance& chance, const std::vector<std::string>& kinds, float least_speed) {
    std::vector<Slider> sliders;
    while (sliders.size() < kAbreast) {
        const Slider slider = random_slider(chance);
        if (slider.speed < least_speed || std::find(kinds.begin(), kinds.end(), slider.name) == kinds.end()) continue;
        sliders.push_back(slider);
        sliders.back().side = -0.9f + 0.6f * real(sliders.size() - 1);
    }
    return sliders;
}

// Past a ridge the planes of triangles rise over the pieces of what lies on the near side: they were held from both.
TEST(InnerEdges, WhatIsLaidLevelIntoAHillComesOutOfIt) {
    uint32_t stuck = 0;
    for (uint32_t seed = 0; seed < 12; ++seed) {
        Chance chance{std::mt19937(seed)};
        const Ground ground = random_hill(chance);
        const auto world = laid_world(ground.floor, sliders_abreast(chance, {"pane", "shard"}, 0), true);
        for (int n = 0; n < 60; ++n) step(*world);
        std::vector<float> deepest(kAbreast, 0);
        world->detect(kStep);
        for (const RigidContact& c : world->contacts()) {
            float& d = deepest[std::max(c.a, c.b) - kFirst];
            d = std::min(d, c.distance);
        }
        for (const float d : deepest) stuck += d < -0.0015f;
    }
    EXPECT_EQ(stuck, 0u);
}

// Without friction's share: mu g t^2 / 2, of the way.
TEST(InnerEdges, WhatGlidesFastOverAFineHillKeepsItsWay) {
    uint32_t held = 0, cases = 0;
    for (uint32_t seed = 0; seed < 6; ++seed) {
        Chance chance{std::mt19937(seed)};
        const Ground ground = random_hill(chance);
        const auto sliders = sliders_abreast(chance, {"pane", "shard", "box", "box of pieces"}, 8);
        const auto trips = slide(ground.plain, sliders, 1.0f / 120);
        for (uint32_t k = 0; k < kAbreast; ++k) {
            const float seconds = real(trips[k].size()) / 120;
            const float whole = sliders[k].speed * seconds - 0.5f * 0.6f * 9.81f * seconds * seconds;
            ++cases, held += trips[k].back().way < 0.9f * whole;
        }
    }
    EXPECT_EQ(held, 0u) << "of " << cases;
}

// What a ridge lets fall comes down on the next slope at a tenth of a metre a second, and went no farther in that step.
TEST(InnerEdges, RidgesOfADegreeHoldNothingUp) {
    uint32_t held = 0, cases = 0;
    for (uint32_t seed = 0; seed < 24; ++seed) {
        Chance chance{std::mt19937(seed)};
        const Ground ground = random_ridges(chance);
        const auto sliders = sliders_abreast(chance, {"pane", "shard", "box", "box of pieces"}, 4);
        const auto got = slide(ground.floor, sliders, 1.0f / 60), plain = slide(ground.plain, sliders, 1.0f / 60);
        for (uint32_t k = 0; k < kAbreast; ++k) {
            const size_t steps = std::min(got[k].size(), plain[k].size());
            const float way = got[k][steps - 1].way, whole = plain[k][steps - 1].way;
            ++cases;
            if (way >= 0.95f * whole) continue;
            ++held;
            std::printf("seed %u lane %u: %s at %.1f m/s: %.3f of %.3f m\n", seed, k, sliders[k].name, sliders[k].speed,
                        way, whole);
        }
    }
    EXPECT_LE(100 * held, cases);
}

// A fast ball sinks in by half a centimetre where a hill rises before it, and the next triangle's edge is as deep in
// it. Pushed by that it flew up by a metre. Wanted: 10 mm; one in 160 hops by 17 to 25.
TEST(InnerEdges, ABallThatSinksIntoAHillIsNotThrownUpByTheNextTriangle) {
    uint32_t thrown = 0, cases = 0;
    for (uint32_t seed = 0; seed < 40; ++seed) {
        Chance chance{std::mt19937(seed)};
        const Ground ground = random_hill(chance);
        const auto balls = sliders_abreast(chance, {"ball"}, 15);
        const auto got = slide(ground.floor, balls, 1.0f / 60), plain = slide(ground.plain, balls, 1.0f / 60);
        for (uint32_t k = 0; k < kAbreast; ++k) {
            const size_t steps = std::min(got[k].size(), plain[k].size());
            ++cases, thrown += got[k][steps - 1].top > plain[k][steps - 1].top + 0.025f;
        }
    }
    EXPECT_EQ(thrown, 0u) << "of " << cases;
}

}  // namespace
}  // namespace cullet
