// Rays, nearest surfaces and overlaps against a brute force over all drawn triangles, in world coordinates.
#include "cullet/query.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "components/body_id.hpp"
#include "engine/random.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/hulls/triangle_queries.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

struct Corners {
    uint32_t body, number;
    Triangle3 triangle;  // world
};

Vec3d world_place(const Pose& pose, Vec3 p) {
    const Vec3d u(pose.orientation.x, pose.orientation.y, pose.orientation.z), v(p);
    const Vec3d t = 2.0 * cross(u, v);
    return v + static_cast<double>(pose.orientation.w) * t + cross(u, t) + Vec3d(pose.position);
}

// Everything with triangles: views, and what the test itself gave the world.
struct Mixture {
    World world;
    BodyId ball, lift, steps;
    std::vector<Vec3> step_points;
    std::vector<uint32_t> step_indices;

    std::vector<Corners> triangles() const {
        std::vector<Corners> all;
        for (const BodyId body : all_bodies(world)) {
            const BodyView view = world.view(body).value();
            for (uint32_t i = 0; i + 2 < view.index_count; i += 3) {
                const auto place = [&](uint32_t k) {
                    return world_place(view.pose, view.vertices[view.indices[i + k]].position);
                };
                all.push_back({body.index, i / 3, {place(0), place(1), place(2)}});
            }
        }
        for (uint32_t i = 0; i < step_indices.size(); i += 3) {
            const auto place = [&](uint32_t k) { return Vec3d(step_points[step_indices[i + k]]); };
            all.push_back({steps.index, i / 3, {place(0), place(1), place(2)}});
        }
        return all;
    }
};

// A broken vase among a whole one, a ball, a turned lift and a flight of steps.
Mixture mixture(Vec3 at = {}) {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    Mixture m{make_world(settings), {}, {}, {}, {}, {}};
    const ModelId vase = m.world.add_model(small_vase()).value();
    SpawnSettings spawn;
    spawn.pose = {at, {}};
    spawn.user_data = 42;
    (void)m.world.spawn(vase, spawn).value();
    SphereSettings ball = ball_at(at + Vec3{0.01f, 0.13f, 0}, 0.3f, 8);
    ball.contact.layer = 2;
    m.ball = m.world.add_sphere(ball).value();
    for (uint32_t k = 0; k < 200; ++k) {
        const float x = 0.05f * static_cast<float>(k % 20), z = 0.1f * static_cast<float>(k / 20);
        const auto first = static_cast<uint32_t>(m.step_points.size());
        for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{0, 0, 0.1f}, Vec3{0.05f, 0.03f, 0}})
            m.step_points.push_back(at + Vec3{x - 0.5f, 0.4f * x - 0.6f, z - 0.5f} + p);
        for (uint32_t i = 0; i < 3; ++i) m.step_indices.push_back(first + i);
    }
    m.steps = m.world.add_static({m.step_points.data(), m.step_points.size(), m.step_indices.data(), 200}).value();
    EXPECT_GT(step_until_born(m.world, 30), 0u);
    for (int k = 0; k < 10; ++k) m.world.step();
    // Since the last step:
    spawn.pose = {at + Vec3{0.4f, 0.1f, 0.2f}, normalised(Quat{0.1f, 0.5f, -0.3f, 0.8f})};
    (void)m.world.spawn(vase, spawn).value();
    KinematicSettings lift;
    lift.pose = {at + Vec3{-0.4f, 0.2f, 0.1f}, normalised(Quat{0.4f, 0.1f, 0.2f, 0.9f})};
    lift.half_extents = {0.2f, 0.05f, 0.1f};
    m.lift = m.world.add_kinematic_box(lift).value();
    return m;
}

SphereSettings still_ball(Vec3 at, float radius) {
    SphereSettings ball;
    ball.pose.position = at;
    ball.radius = radius;
    return ball;
}

struct Places {
    Random random;
    uint64_t drawn = 0;
    Vec3 any(float reach) { return {reach * (2 * next() - 1), reach * (2 * next() - 1), reach * (2 * next() - 1)}; }
    float next() { return static_cast<float>(random.uniform(drawn++)); }
};

TEST(Query, ARayHitsWhatABruteForceOverAllDrawnTrianglesHits) {
    for (const Vec3 at : {Vec3{}, Vec3{4000, 0, -4000}}) {
        const Mixture m = mixture(at);
        const std::vector<Corners> all = m.triangles();
        Places places{Random{7}};
        // Far from the origin a drawn place is a float of 0.25 mm; positions of bodies are what is rounded.
        uint32_t hits = 0;
        for (int k = 0; k < 2000; ++k) {
            const Vec3 from = at + places.any(1), to = at + places.any(0.4f);
            const SurfaceHit hit = ray(m.world, from, to - from, 3, 1);
            double nearest = 3;
            const Corners* found = nullptr;
            for (const Corners& c : all) {
                const double t = distance_along(c.triangle, Vec3d(from), normalised(Vec3d(to - from)));
                if (t >= 0 && t <= nearest) nearest = t, found = &c;
            }
            if (hit.body == m.lift) {
                EXPECT_LE(hit.distance, nearest + 1e-6);
                continue;
            }
            ASSERT_EQ(static_cast<bool>(hit), found != nullptr) << "ray " << k;
            if (!found) continue;
            ++hits;
            EXPECT_NEAR(hit.distance, nearest, 1e-6) << "ray " << k;
            EXPECT_EQ(hit.body.index, found->body) << "ray " << k;
            EXPECT_EQ(hit.triangle, found->number) << "ray " << k;
            EXPECT_NEAR(length(hit.normal), 1, 1e-6);
        }
        EXPECT_GT(hits, 500u);
    }
}

TEST(Query, TheNearestSurfaceIsABruteForces) {
    const Mixture m = mixture();
    const std::vector<Corners> all = m.triangles();
    Places places{Random{8}};
    for (int k = 0; k < 500; ++k) {
        const Vec3 point = places.any(0.6f);
        const SurfaceHit found = closest(m.world, point, 0.3f, 1);
        double nearest = 0.3;
        for (const Corners& c : all)
            nearest = std::min(nearest, length(nearest_point(c.triangle, Vec3d(point)) - Vec3d(point)));
        if (found.body == m.lift) {
            EXPECT_LE(found.distance, nearest + 1e-6);
            continue;
        }
        ASSERT_EQ(static_cast<bool>(found), nearest < 0.3) << "point " << k;
        if (!found) continue;
        EXPECT_NEAR(found.distance, nearest, 1e-6) << "point " << k;
        EXPECT_NEAR(length(found.place - point), nearest, 1e-6) << "point " << k;
    }
}

TEST(Query, WhatABallOrABoxMeetsIsWhatABruteForceMeets) {
    const Mixture m = mixture();
    const std::vector<Corners> all = m.triangles();
    Places places{Random{9}};
    const uint32_t rows = m.world.bodies(nullptr, 0) + 8;
    for (int k = 0; k < 200; ++k) {
        const Vec3 centre = places.any(0.5f), half{0.15f * places.next(), 0.15f * places.next(), 0.15f * places.next()};
        const float radius = 0.2f * places.next();
        std::vector<uint8_t> in_ball(rows), in_box(rows);
        for (const Corners& c : all) {
            if (length(nearest_point(c.triangle, Vec3d(centre)) - Vec3d(centre)) <= radius) in_ball[c.body] = 1;
            if (meets_box(c.triangle, Vec3d(centre), Vec3d(half))) in_box[c.body] = 1;
        }
        in_ball[m.lift.index] = in_box[m.lift.index] = 0;
        const auto expect_same = [&](std::vector<BodyId> found, const std::vector<uint8_t>& expected) {
            std::erase(found, m.lift);
            std::vector<uint32_t> rows_found, rows_expected;
            for (const BodyId body : found) rows_found.push_back(body.index);
            for (uint32_t row = 0; row < rows; ++row)
                if (expected[row]) rows_expected.push_back(row);
            EXPECT_EQ(rows_found, rows_expected) << "place " << k;
        };
        BodyId out[256];
        expect_same({out, out + overlap(m.world, centre, radius, out, 256, 1)}, in_ball);
        expect_same({out, out + overlap(m.world, Box{centre - half, centre + half}, out, 256, 1)}, in_box);
    }
}

TEST(Query, SpheresAndBoxesAreMetWhereGeometrySays) {
    World world = make_world(small_settings());
    SphereSettings sphere = still_ball({0, 1, 0}, 0.25f);
    sphere.user_data = 5;
    const BodyId ball = world.add_sphere(sphere).value();
    KinematicSettings crate;
    crate.pose.position = {3, 0, 0};
    crate.half_extents = {0.5f, 1, 0.25f};
    const BodyId box = world.add_kinematic_box(crate).value();
    SurfaceHit hit = ray(world, {0, 1, 2}, {0, 0, -10}, 5);
    EXPECT_EQ(hit.body, ball);
    EXPECT_EQ(hit.user_data, 5u);
    EXPECT_NEAR(hit.distance, 1.75, 1e-6);
    EXPECT_NEAR(hit.normal.z, 1, 1e-6);
    EXPECT_NEAR(hit.place.z, 0.25, 1e-6);
    EXPECT_NEAR(ray(world, {0, 1, 0}, {1, 0, 0}, 1).distance, 0.25, 1e-6) << "from inside";
    EXPECT_FALSE(ray(world, {0, 1, 2}, {0, 0, -1}, 1.7f)) << "too short";
    EXPECT_FALSE(ray(world, {0, 1, 2}, {0, 0, 1}, 5)) << "behind";
    const Vec3 ways[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const Vec3 way : ways) {
        hit = ray(world, Vec3{3.01f, 0.02f, 0.03f} - 5.0f * way, way, 10);
        EXPECT_EQ(hit.body, box);
        EXPECT_NEAR(dot(hit.normal, way), -1, 1e-6) << way.x << way.y << way.z;
    }
    hit = closest(world, {3, 0, 1}, 10);
    EXPECT_EQ(hit.body, box);
    EXPECT_NEAR(hit.distance, 0.75, 1e-6);
    EXPECT_NEAR(closest(world, {0, 2, 0}, 10).distance, 0.75, 1e-6);
    EXPECT_NEAR(closest(world, {0, 1.1f, 0}, 10).distance, 0.15, 1e-6) << "from inside";
    BodyId out[2];
    EXPECT_EQ(overlap(world, {0, 1, 0}, 0.01f, out, 2), 1u) << "balls are solid";
    EXPECT_EQ(overlap(world, {3, 0, 0}, 0.01f, out, 2), 1u) << "boxes are solid";
    EXPECT_EQ(overlap(world, Box{{-9, -9, -9}, {9, 9, 9}}, out, 1), 2u);
    EXPECT_EQ(out[0], ball);
}

TEST(Query, AMaskPassesOverOtherLayersAndARemovedBodyIsGoneAtOnce) {
    World world = make_world(small_settings());
    SphereSettings near = still_ball({0, 0, 1}, 0.1f), far = still_ball({0, 0, -1}, 0.1f);
    near.contact.layer = 4, far.contact.layer = 8;
    const BodyId first = world.add_sphere(near).value(), second = world.add_sphere(far).value();
    EXPECT_EQ(ray(world, {0, 0, 3}, {0, 0, -1}, 10).body, first);
    EXPECT_EQ(ray(world, {0, 0, 3}, {0, 0, -1}, 10, 8).body, second);
    EXPECT_FALSE(ray(world, {0, 0, 3}, {0, 0, -1}, 10, 16));
    ASSERT_TRUE(world.remove(first).ok());
    EXPECT_EQ(ray(world, {0, 0, 3}, {0, 0, -1}, 10).body, second);
    ASSERT_TRUE(world.set_pose(second, {{0, 5, 0}, {}}).ok());
    EXPECT_FALSE(ray(world, {0, 0, 3}, {0, 0, -1}, 10));
    EXPECT_EQ(ray(world, {0, 9, 0}, {0, -1, 0}, 10).body, second);
}

TEST(Query, HundredsOfBodiesAddedAtOnceAreFoundBeforeAStep) {
    World world = make_world(small_settings());
    for (uint32_t k = 0; k < 300; ++k)
        (void)world.add_sphere(still_ball({static_cast<float>(k % 20), static_cast<float>(k / 20), 0}, 0.2f)).value();
    for (uint32_t k = 0; k < 300; ++k) {
        const Vec3 at{static_cast<float>(k % 20), static_cast<float>(k / 20), 0};
        EXPECT_EQ(ray(world, at + Vec3{0, 0, 2}, {0, 0, -1}, 5).body.index, k);
    }
    EXPECT_EQ(overlap(world, Box{{0, 0, 0}, {19, 14, 0}}, nullptr, 0), 300u);
}

TEST(Query, ABoxMayBeAsLargeAsItLikes) {
    const Mixture m = mixture();
    const uint32_t all = m.world.bodies(nullptr, 0);
    const float inf = std::numeric_limits<float>::infinity();
    EXPECT_EQ(overlap(m.world, Box{{-1e7f, -1e7f, -1e7f}, {1e7f, 1e7f, 1e7f}}, nullptr, 0), all);
    EXPECT_EQ(overlap(m.world, Box{{-inf, -inf, -inf}, {inf, inf, inf}}, nullptr, 0), all);
}

// Rays aimed at the middle of an edge of two triangles, from anywhere: one of the two is hit.
TEST(TriangleQueries, NoRaySlipsThroughBetweenTwoTriangles) {
    Places places{Random{11}};
    uint32_t aimed = 0;
    for (int k = 0; k < 200000; ++k) {
        const Vec3d a(places.any(1)), b(places.any(1)), origin(places.any(4));
        const Vec3d beside(places.any(1)), middle = 0.5 * (a + b);
        const Vec3d away = cross(cross(b - a, beside - a), b - a);  // from the edge, within the first one's plane
        const Triangle3 first{a, b, middle + away}, second{b, a, middle - away};
        const Vec3d direction = middle - origin;
        if (std::fabs(dot(cross(b - a, away), direction)) < 1e-3) continue;
        ++aimed;
        ASSERT_TRUE(distance_along(first, origin, direction) >= 0 || distance_along(second, origin, direction) >= 0)
            << k;
    }
    EXPECT_GT(aimed, 100000u);
}

TEST(Query, NumbersThatAreNoneHitNothing) {
    const Mixture m = mixture();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(ray(m.world, {nan, 0, 0}, {0, 0, 1}, 5));
    EXPECT_FALSE(ray(m.world, {}, {0, nan, 1}, 5));
    EXPECT_FALSE(ray(m.world, {}, {}, 5));
    EXPECT_FALSE(ray(m.world, {0, 1, 0}, {0, -1, 0}, nan));
    EXPECT_FALSE(closest(m.world, {nan, 0, 0}, 5));
    EXPECT_EQ(overlap(m.world, {0, nan, 0}, 5, nullptr, 0), 0u);
    EXPECT_EQ(overlap(m.world, Box{{0, 0, nan}, {1, 1, 1}}, nullptr, 0), 0u);
    EXPECT_EQ(overlap(m.world, Box{{1, 1, 1}, {0, 0, 0}}, nullptr, 0), 0u);
}

TEST(Query, ManyThreadsMayAskAtOnceBetweenSteps) {
    Mixture m = mixture();
    for (int step = 0; step < 4; ++step) {
        const World& world = m.world;
        const auto ask = [&world] {
            Places places{Random{3}};
            double sum = 0;
            BodyId out[16];
            for (int k = 0; k < 300; ++k) {
                const Vec3 from = places.any(1), to = places.any(0.3f);
                sum += ray(world, from, to - from, 3).distance + closest(world, from, 1).distance;
                sum += overlap(world, to, 0.2f, out, 16);
                sum += overlap(world, Box{to, to + Vec3{0.1f, 0.1f, 0.1f}}, out, 16);
            }
            return sum;
        };
        double sums[3] = {};
        std::vector<std::thread> threads;
        for (double& sum : sums) threads.emplace_back([&sum, &ask] { sum = ask(); });
        for (std::thread& thread : threads) thread.join();
        EXPECT_EQ(sums[0], sums[1]);
        EXPECT_EQ(sums[0], sums[2]);
        EXPECT_GT(sums[0], 0);
        m.world.step();
    }
}

}  // namespace
}  // namespace cullet::test
