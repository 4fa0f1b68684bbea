// What slides over a body of many pieces that moves by forces, or is moved, goes as over one of a single box; so does a
// body of many pieces over others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/engine/rigid_scenes.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/random_sliders.hpp"

namespace cullet {
namespace {

constexpr uint32_t kAbreast = 4;  // lanes
constexpr RigidId kPlank = 1, kFirst = 10, kLimit = 100;
constexpr Vec3 kGravity{0, -9.81f, 0};

/// Of the whole trip up to a step.
struct Trip {
    float top = 0, way = 0, aside = 0, struck = 0;
};
using Trips = std::vector<Trip>;  // by steps, as long as there is something before it to slide on

struct Figures {
    uint32_t cases = 0, hops = 0, aside = 0, held = 0, struck = 0, bad = 0;
    float highest = 0;  // m

    /// True: the two trips differ. They are compared for as long as both last.
    bool add(const Trips& all_got, const Trips& all_plain) {
        const size_t steps = std::min(all_got.size(), all_plain.size());
        const Trip got = all_got[steps - 1], plain = all_plain[steps - 1];
        const float hop = got.top - plain.top;
        const bool hops_too = hop > 0.003f, is_aside = std::fabs(got.aside - plain.aside) > 0.02f * plain.way,
                   is_held = got.way<0.95f * plain.way, is_struck = got.struck> plain.struck + 0.5f;
        ++cases, hops += hops_too, aside += is_aside, held += is_held, struck += is_struck;
        highest = std::max(highest, hop);
        if (!hops_too && !is_aside && !is_held && !is_struck) return false;
        ++bad;
        std::printf("hop %.1f mm, aside %.1f of %.0f mm, way %.3f of %.3f m, struck at %.2f (%.2f) m/s: ", 1000 * hop,
                    1000 * (got.aside - plain.aside), 1000 * plain.way, got.way, plain.way, got.struck, plain.struck);
        return true;
    }
    void expect(uint32_t most_of_a_hundred) const {
        std::printf("%u cases: %u hop, the highest %.1f mm; %u turned aside, %u held up, %u struck; %u in all\n", cases,
                    hops, 1000 * highest, aside, held, struck, bad);
        EXPECT_LE(100 * bad, most_of_a_hundred * cases);
        EXPECT_LT(highest, 0.01f);
    }
};

/// CULLET_MOVING_EDGES_CASES in the environment asks for another number.
uint32_t wanted(uint32_t usual) {
    const char* text = std::getenv("CULLET_MOVING_EDGES_CASES");
    return text ? static_cast<uint32_t>(std::atoi(text)) : usual;
}

/// The plank as a body of its pieces, or of its one box.
RigidDescription body_of(const Plank& plank, const Floor& floor, double density, std::vector<ConvexPiece>& pieces) {
    const FloorPart& part = floor.parts[0];
    for (const auto& p : part.pieces) pieces.push_back({p, static_cast<uint32_t>(pieces.size())});
    RigidDescription d;
    d.margin = part.margin;
    d.pieces = pieces;
    const double x = plank.extent.high - plank.extent.low, y = plank.thickness, z = 2 * plank.extent.side;
    d.mass = density * x * y * z;
    d.centre = {0.5 * (plank.extent.low + plank.extent.high), -0.5 * y, 0};
    d.inertia = {d.mass / 12 * (y * y + z * z), d.mass / 12 * (x * x + z * z), d.mass / 12 * (x * x + y * y)};
    return d;
}

struct Scene {
    Plank plank;
    RigidKind kind = RigidKind::Dynamic;
    std::vector<Slider> sliders;
    float dt = kStep;
};

std::unique_ptr<RigidWorld> laid_world(const Scene& scene, const Floor& floor) {
    auto world = make_bullet_world(kLimit);
    world->set_gravity(kGravity);
    const float below = -scene.plank.thickness;
    const std::vector<Vec3> ground{{-20, below, -20}, {-20, below, 20}, {20, below, 20}, {20, below, -20}};
    const std::array<uint32_t, 3> triangles[] = {{0, 1, 2}, {0, 2, 3}};
    world->add_static_triangles(0, ground, triangles, 0.45f, 0.2f, 1, ~0u);
    std::vector<ConvexPiece> pieces;
    RigidDescription d = body_of(scene.plank, floor, 20000, pieces);
    d.kind = scene.kind;
    world->add(kPlank, d);
    for (uint32_t k = 0; k < scene.sliders.size(); ++k) {
        const Slider& s = scene.sliders[k];
        add_slider(*world, kFirst + k, s, laid_level(floor.height, s), {s.speed, 0, 0});
    }
    return world;
}

std::vector<Trips> slide(const Scene& scene, const Floor& floor) {
    const auto world = laid_world(scene, floor);
    std::vector<Trips> trips(scene.sliders.size());
    std::vector<float> struck(scene.sliders.size());
    std::vector<bool> is_over(scene.sliders.size());
    for (int n = 0; real(n) * scene.dt < 1; ++n) {
        world->detect(scene.dt);
        for (const RigidContact& c : world->contacts()) {
            if (std::max(c.a, c.b) < kFirst || c.distance >= 0.001f) continue;
            float& most = struck[std::max(c.a, c.b) - kFirst];
            most = std::max(most, c.approach_speed);
        }
        world->solve(scene.dt);
        for (uint32_t k = 0; k < scene.sliders.size(); ++k) {
            const Vec3 p = world->pose(kFirst + k).position;
            is_over[k] = is_over[k] || p.x > kFloorHigh - 1.2f;
            if (is_over[k]) continue;
            const float top = std::max(trips[k].empty() ? 0.0f : trips[k].back().top, p.y - scene.sliders[k].lift);
            trips[k].push_back({top, p.x, p.z - scene.sliders[k].side, struck[k]});
        }
    }
    return trips;
}

TEST(MovingEdges, WhatSlidesOverABodyOfManyPiecesGoesAsOverOneOfASingleBox) {
    Figures figures;
    for (uint32_t seed = 0; seed < wanted(test::few_or_all(168u, 504u)) / kAbreast; ++seed) {
        Chance chance{std::mt19937(seed)};
        Scene scene{random_plank(chance, {}, chance.between(0.03f, 0.3f)),
                    chance.below(3) == 0 ? RigidKind::Kinematic : RigidKind::Dynamic,
                    {},
                    chance.below(2) ? 1.0f / 60 : 1.0f / 120};
        for (uint32_t k = 0; k < kAbreast; ++k) {
            scene.sliders.push_back(random_slider(chance));
            scene.sliders.back().side = -0.9f + 0.6f * real(k) + chance.between(-0.02f, 0.02f);
        }
        const auto got = slide(scene, scene.plank.floor), plain = slide(scene, scene.plank.plain);
        for (uint32_t k = 0; k < kAbreast; ++k)
            if (figures.add(got[k], plain[k]))
                std::printf("seed %u lane %u, %s on %s %s at %.1f m/s, %.0f steps a second\n", seed, k,
                            scene.sliders[k].name, scene.kind == RigidKind::Kinematic ? "kinematic" : "dynamic",
                            scene.plank.floor.name, scene.sliders[k].speed, 1 / scene.dt);
    }
    figures.expect(1);
}

struct Glide {
    Plank slab, ground;
    RigidKind kind = RigidKind::Static;  // of the ground
    float speed = 0, dt = kStep;
};

Trips glide(const Glide& scene, const Floor& slab, const Floor& ground) {
    auto world = make_bullet_world(kLimit);
    world->set_gravity(kGravity);
    std::vector<ConvexPiece> ground_pieces, pieces;
    RigidDescription below = body_of(scene.ground, ground, 20000, ground_pieces);
    below.kind = scene.kind;
    world->add(0, below);
    RigidDescription d = body_of(scene.slab, slab, 2400, pieces);
    d.pose.position = {0, scene.slab.thickness + 0.0005f, 0};
    d.motion.velocity = {scene.speed, 0, 0};
    world->add(kPlank, d);
    Trips trips;
    float struck = 0;
    for (int n = 0; real(n) * scene.dt < 1; ++n) {
        world->detect(scene.dt);
        for (const RigidContact& c : world->contacts())
            if (c.distance < 0.001f) struck = std::max(struck, c.approach_speed);
        world->solve(scene.dt);
        const Vec3 p = world->pose(kPlank).position;
        if (p.x > kFloorHigh - 1.2f) break;
        const float top = std::max(trips.empty() ? 0.0f : trips.back().top, p.y - scene.slab.thickness);
        trips.push_back({top, p.x, p.z, struck});
    }
    return trips;
}

TEST(MovingEdges, ABodyOfManyPiecesSlidesOverManyPiecesAsOneBoxDoesOverOne) {
    Figures figures;
    for (uint32_t seed = 0; seed < wanted(test::few_or_all(168u, 504u)) / 2; ++seed) {
        Chance chance{std::mt19937(seed)};
        const Extent extent{-0.4f, 0.4f, chance.between(0.1f, 0.4f)};
        // Even in scale: each octave as often. (Without libm, whose last bits differ between machines.)
        const float octave = 0.5f * real(1u << chance.below(6));
        const Glide scene{random_plank(chance, extent, chance.between(0.01f, 0.1f)), random_plank(chance, {}, 0.1f),
                          chance.below(2) ? RigidKind::Static : RigidKind::Kinematic, octave * chance.between(1, 2),
                          chance.below(2) ? 1.0f / 60 : 1.0f / 120};
        const bool is_plain = chance.below(3) == 0;
        const Trips got = glide(scene, scene.slab.floor, is_plain ? scene.ground.plain : scene.ground.floor);
        if (figures.add(got, glide(scene, scene.slab.plain, scene.ground.plain)))
            std::printf("seed %u, %s over %s %s at %.1f m/s, %.0f steps a second\n", seed, scene.slab.floor.name,
                        scene.kind == RigidKind::Static ? "static" : "kinematic",
                        is_plain ? "one box" : scene.ground.floor.name, scene.speed, 1 / scene.dt);
    }
    figures.expect(1);
}

}  // namespace
}  // namespace cullet
