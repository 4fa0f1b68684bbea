// Heaps: rest and sleep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "tests/engine/rigid_scenes.hpp"
#include "tests/support/effort.hpp"

namespace cullet {
namespace {

TEST(RigidPile, AShardAloneRestsOnTheFloorWithoutSinkingOrHovering) {
    auto world = floor_world(8);
    add_shard(*world, 1, {0, 0.1f, 0}, normalised(Quat{0.2f, 0.1f, 0.1f, 0.9f}));
    float least = 1;
    for (int k = 0; k < 180; ++k) {
        world->detect(kStep);
        if (!world->contacts().empty()) least = 1;
        for (const RigidContact& c : world->contacts()) least = std::min(least, c.distance);
        world->solve(kStep);
    }
    EXPECT_TRUE(world->is_asleep(1));
    EXPECT_GT(least, -0.001f);
    EXPECT_LT(least, 0.001f);
}

/// J/kg, of half a second.
struct Window {
    double most = 0;            // kinetic energy
    double start = 0, end = 0;  // of height
};

struct Energy {
    double kinetic, height;
};

struct Heap {
    uint32_t asleep = 0;                                 // after six and a half seconds
    uint32_t moved = 0;                                  // in the two seconds after that
    float depth_95 = 0, depth_most = 0, floor_most = 0;  // m, of its contacts
    std::vector<Window> windows;                         // after the last hit
};

constexpr uint32_t kShards = 50;
constexpr uint32_t kAsleepBy = 390, kStillFor = 120, kWindow = 30;  // steps; the last shard lands before step 120
constexpr float kHitSpeed = 0.05f;                                  // m/s, above the 0.04 of settled piles

// What the last bits of a solve leave over: half a millimetre a second.
constexpr double kNoise = 1e-7;  // J/kg

std::vector<Pose> poses_of(const RigidWorld& world) {
    std::vector<Pose> poses;
    for (uint32_t id = 1; id <= kShards; ++id) poses.push_back(world.pose(id));
    return poses;
}

/// Of unit mass, as if all turned about their thickest axis.
Energy energy_of(const RigidWorld& world) {
    const double turning = test_shard().inertia.xx / test_shard().mass;
    Energy sum{};
    for (uint32_t id = 1; id <= kShards; ++id) {
        const Motion m = world.motion(id);
        sum.kinetic += 0.5 * (dot(Vec3d(m.velocity), Vec3d(m.velocity)) +
                              turning * dot(Vec3d(m.angular_velocity), Vec3d(m.angular_velocity)));
        sum.height += 9.81 * Vec3d(to_world(world.pose(id), test_shard().centre.to_float())).y;
    }
    return sum;
}

/// Steps the world on, and begins the windows anew where something is hit.
void follow(RigidWorld& world, uint32_t steps, std::vector<Energy>& since_hit) {
    for (uint32_t k = 0; k < steps; ++k) {
        world.detect(kStep);
        for (const RigidContact& c : world.contacts())
            if (c.approach_speed > kHitSpeed) since_hit.clear();
        world.solve(kStep);
        since_hit.push_back(energy_of(world));
    }
}

void measure_depths(RigidWorld& world, Heap& heap) {
    for (uint32_t id = 1; id <= kShards; ++id) world.wake(id);
    world.detect(kStep);
    std::vector<float> depths;
    for (const RigidContact& c : world.contacts()) {
        depths.push_back(-c.distance);
        if (c.a == 0) heap.floor_most = std::max(heap.floor_most, -c.distance);
    }
    world.solve(kStep);
    std::sort(depths.begin(), depths.end());
    heap.depth_95 = depths[depths.size() * 95 / 100], heap.depth_most = depths.back();
}

Heap drop_heap(uint32_t seed) {
    auto world = floor_world(kShards + 8);
    drop_shards(*world, 1, kShards, seed);
    Heap heap;
    std::vector<Energy> since_hit;
    follow(*world, kAsleepBy, since_hit);
    for (uint32_t id = 1; id <= kShards; ++id) {
        heap.asleep += world->is_asleep(id);
        EXPECT_GT(world->pose(id).position.y, -0.01f) << id;
    }
    const std::vector<Pose> before = poses_of(*world);
    follow(*world, kStillFor, since_hit);
    const std::vector<Pose> after = poses_of(*world);
    for (uint32_t k = 0; k < kShards; ++k) heap.moved += std::memcmp(&before[k], &after[k], sizeof(Pose)) != 0;
    for (size_t f = 0; f + kWindow <= since_hit.size(); f += kWindow) {
        Window& w = heap.windows.emplace_back(Window{0, since_hit[f].height, since_hit[f + kWindow - 1].height});
        for (size_t k = f; k < f + kWindow; ++k) w.most = std::max(w.most, since_hit[k].kinetic);
    }
    measure_depths(*world, heap);
    std::printf("seed %u: asleep %u of %u, moved %u; overlap 95 %% %.2f mm, worst %.2f mm, floor %.2f mm; J/kg", seed,
                heap.asleep, kShards, heap.moved, 1000 * heap.depth_95, 1000 * heap.depth_most, 1000 * heap.floor_most);
    for (const Window& w : heap.windows)
        if (w.most > 0) std::printf(" %.2g", w.most);
    std::printf("\n");
    return heap;
}

// One heap says little. Of 16 none has a contact deeper than 2.2 mm, and the worst of their 95th percentiles is 0.4 mm.
TEST(RigidPile, FiftyCurvedShardsSleepWithinSixAndAHalfSecondsAndLieNowhereDeeperThanThreeMillimetres) {
    const uint32_t heaps = test::few_or_all(2u, 16u);
    uint32_t asleep = 0, moved = 0;
    for (uint32_t seed = 0; seed < heaps; ++seed) {
        const Heap heap = drop_heap(seed);
        asleep += heap.asleep, moved += heap.moved;
        EXPECT_LT(heap.depth_95, 0.001f) << seed;
        EXPECT_LT(heap.depth_most, 0.003f) << seed;
        // Nothing is hit, so nothing gains speed but by falling: a shard that slides off another one.
        for (size_t k = 1; k < heap.windows.size(); ++k) {
            const double fell = std::max(0.0, heap.windows[k - 1].start - heap.windows[k].end);
            EXPECT_LE(heap.windows[k].most, heap.windows[k - 1].most + fell + kNoise)
                << "seed " << seed << ", window " << k;
        }
    }
    EXPECT_GE(100 * asleep, 99 * heaps * kShards);
    EXPECT_EQ(moved, 0u);
}

}  // namespace
}  // namespace cullet
