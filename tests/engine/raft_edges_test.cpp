// What slides over bodies side by side that no solver moves, as a raft of lifts or a lift in its floor, goes as over
// one box that moves like them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/engine/rigid_scenes.hpp"
#include "tests/support/random_sliders.hpp"

namespace cullet {
namespace {

constexpr uint32_t kAbreast = 4;  // lanes
constexpr RigidId kFirst = 1000, kLimit = 1100;
constexpr float kHalfHeight = 0.1f, kSide = 1.5f, kFrom = -1.5f, kTo = 12;

void lay(RigidWorld& world, RigidId id, float low_x, float high_x, float low_z, float high_z, RigidKind kind,
         Vec3 velocity) {
    const Vec3 half{0.5f * (high_x - low_x), kHalfHeight, 0.5f * (high_z - low_z)};
    add_box(world, id, {0.5f * (low_x + high_x), -kHalfHeight, 0.5f * (low_z + high_z)}, half, 1000, kind);
    world.set_motion(id, {velocity, {}});
}

struct Raft {
    float tile = 0.5f;  // m; 0: it is one box
    Vec3 velocity;
    bool is_mixed = false;  // every other tile is static
};

void lay_raft(RigidWorld& world, const Raft& raft) {
    if (!(raft.tile > 0)) return lay(world, 0, kFrom, kTo, -kSide, kSide, RigidKind::Kinematic, raft.velocity);
    const int along = static_cast<int>((kTo - kFrom) / raft.tile), across = static_cast<int>(2 * kSide / raft.tile);
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < across; ++j) {
            const float x = kFrom + raft.tile * real(i), z = -kSide + raft.tile * real(j);
            const bool is_static = raft.is_mixed && (i + j) % 2 == 0;
            lay(world, static_cast<RigidId>(i * across + j), x, x + raft.tile, z, z + raft.tile,
                is_static ? RigidKind::Static : RigidKind::Kinematic, raft.velocity);
        }
}

struct Trip {
    float top = 0, way = 0, aside = 0;
};

std::vector<Trip> slide(const Raft& raft, const std::vector<Slider>& sliders, float dt, uint32_t steps) {
    const auto world = make_bullet_world(kLimit);
    world->set_gravity({0, -9.81f, 0});
    lay_raft(*world, raft);
    const auto level = [](float, float) { return 0.0f; };
    for (uint32_t k = 0; k < sliders.size(); ++k)
        add_slider(*world, kFirst + k, sliders[k], laid_level(level, sliders[k]),
                   raft.velocity + Vec3{sliders[k].speed, 0, 0});
    std::vector<Trip> trips(sliders.size());
    for (uint32_t n = 0; n < steps; ++n) {
        world->detect(dt);
        world->solve(dt);
        const float raised = raft.velocity.y * dt * real(n + 1);
        for (uint32_t k = 0; k < sliders.size(); ++k) {
            const Vec3 p = world->pose(kFirst + k).position;
            trips[k] = {std::max(trips[k].top, p.y - raised - sliders[k].lift), p.x, p.z - sliders[k].side};
        }
    }
    return trips;
}

TEST(RaftEdges, WhatSlidesOverDrivenTilesGoesAsOverOneBox) {
    uint32_t cases = 0, bad = 0;
    float highest = 0;
    for (uint32_t seed = 0; seed < 48; ++seed) {
        Chance chance{std::mt19937(seed)};
        Raft raft;
        const float tiles[] = {0.25f, 0.5f, 0.75f};
        raft.tile = tiles[chance.below(3)];
        const uint32_t kind = chance.below(4);
        if (kind == 1) raft.velocity = {0, chance.between(-0.3f, 0.5f), 0};
        if (kind == 2) raft.velocity = {chance.between(-0.5f, 0.5f), 0, chance.between(-0.1f, 0.1f)};
        raft.is_mixed = kind == 3;
        std::vector<Slider> sliders;
        for (uint32_t k = 0; k < kAbreast; ++k) {
            sliders.push_back(random_slider(chance));
            sliders.back().side = -0.9f + 0.6f * real(k) + chance.between(-0.02f, 0.02f);
        }
        float fastest = 0;
        for (const Slider& s : sliders) fastest = std::max(fastest, s.speed);
        const float dt = chance.below(2) ? 1.0f / 60 : 1.0f / 120;
        const auto steps = static_cast<uint32_t>(std::min(1.0f, 0.8f * kTo / (fastest + 0.5f)) / dt);
        Raft plain = raft;
        plain.tile = 0;
        const auto got = slide(raft, sliders, dt, steps), wanted = slide(plain, sliders, dt, steps);
        for (uint32_t k = 0; k < kAbreast; ++k) {
            const float hop = got[k].top - wanted[k].top;
            ++cases, highest = std::max(highest, hop);
            const float way = std::fabs(wanted[k].way);
            if (hop < 0.003f && std::fabs(got[k].aside - wanted[k].aside) < 0.02f * way + 0.001f &&
                got[k].way > wanted[k].way - 0.05f * way)
                continue;
            ++bad;
            std::printf(
                "seed %u lane %u: %s at %.1f m/s on tiles of %.2f m%s, %.2f %.2f %.2f m/s: hop %.1f mm, aside "
                "%.1f (%.1f) mm, way %.3f of %.3f m\n",
                seed, k, sliders[k].name, sliders[k].speed, raft.tile, raft.is_mixed ? " and static ones" : "",
                raft.velocity.x, raft.velocity.y, raft.velocity.z, 1000 * hop, 1000 * got[k].aside,
                1000 * wanted[k].aside, got[k].way, wanted[k].way);
        }
    }
    std::printf("%u cases, %u bad, the highest hop %.1f mm\n", cases, bad, 1000 * highest);
    EXPECT_LE(100 * bad, cases);
    EXPECT_LT(highest, 0.01f);
}

/// A pane whose cells are of different height, as those of cooked ones are.
Slider wavy_pane(Chance& chance, float side) {
    Slider pane;
    pane.name = "wavy pane";
    pane.margin = 0.00056f;
    constexpr float kCell = 0.025f;
    constexpr int kCells = 8;
    float low[kCells + 1][kCells + 1];
    for (auto& row : low)
        for (float& y : row) y = -0.0024f + chance.between(-0.0002f, 0.0002f);
    for (int i = 0; i < kCells; ++i)
        for (int j = 0; j < kCells; ++j) {
            std::vector<Vec3> points;
            for (int k = 0; k < 4; ++k) {
                const int a = i + (k & 1), b = j + (k >> 1);
                const float x = kCell * (real(a) - 0.5f * kCells), z = kCell * (real(b) - 0.5f * kCells);
                points.push_back({x, low[a][b], z});
                points.push_back({x, 0.0024f, z});
            }
            pane.pieces.push_back(points);
        }
    pane.mass = 0.6;
    pane.inertia = {0.002, 0.004, 0.002};
    pane.lift = 0.003f;
    pane.turn = chance.between(0, 3.14f);
    pane.side = side;
    pane.speed = 6;
    return pane;
}

// It lies there when the lift begins to move: it is struck by that, and rides on it after.
TEST(RaftEdges, WhatALiftOfTilesStrikesSlidesOnAndTheTilesStayLevel) {
    for (const Vec3 velocity :
         {Vec3{0, 0.2f, 0}, Vec3{0, 0.5f, 0}, Vec3{0, -0.4f, 0}, Vec3{0, -1, 0}, Vec3{0.2f, 0, 0}, Vec3{0, 0, 0.2f}}) {
        const auto world = make_bullet_world(kLimit);
        world->set_gravity({0, -9.81f, 0});
        const Raft raft{0.5f, velocity, false};
        lay_raft(*world, raft);
        Chance chance{std::mt19937(7)};
        const auto level = [](float, float) { return 0.0f; };
        for (uint32_t k = 0; k < kAbreast; ++k) {
            const Slider pane = wavy_pane(chance, -0.9f + 0.6f * real(k));
            add_slider(*world, kFirst + k, pane, laid_level(level, pane), {pane.speed, 0, 0});
        }
        for (int n = 0; n < 60; ++n) step(*world);
        const Vec3 first = world->pose(0).position;
        for (RigidId id = 1; id < 150; ++id) EXPECT_NEAR(world->pose(id).position.y, first.y, 1e-5f);
        // One that goes 1 m/s down is overtaken in a fall, and any may wait for what it strikes.
        EXPECT_NEAR(first.y, -kHalfHeight + velocity.y, 0.005f);
        for (uint32_t k = 0; k < kAbreast; ++k) {
            const Vec3 p = world->pose(kFirst + k).position;
            EXPECT_NEAR(p.y, first.y + kHalfHeight + 0.003f, 0.002f) << velocity.y;
            EXPECT_GT(p.x, 0.95f * (6 - 0.45f * (std::fabs(velocity.y) + 0.5f * 9.81f))) << velocity.y;
        }
    }
}

// A lift that stands above its floor is a step.
TEST(RaftEdges, ALiftThatStandsHigherStopsWhatComes) {
    for (const float up : {0.0f, 0.5f}) {
        const auto world = make_bullet_world(kLimit);
        world->set_gravity({0, -9.81f, 0});
        lay(*world, 0, -3, 1, -1, 1, RigidKind::Static, {});
        add_box(*world, 1, {2, -0.05f, 0}, {1, 0.1f, 1}, 1000, RigidKind::Kinematic);
        world->set_motion(1, {{0, up, 0}, {}});
        add_box(*world, 2, {0, 0.0505f, 0}, {0.05f, 0.05f, 0.05f}, 1000);
        world->set_motion(2, {{4, 0, 0}, {}});
        for (int n = 0; n < 40; ++n) step(*world);
        EXPECT_LT(world->pose(2).position.x, 1);
    }
}

}  // namespace
}  // namespace cullet
