// Heaps: rest and sleep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/engine/rigid_scenes.hpp"

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

class HeapOfSeed : public testing::TestWithParam<uint32_t> {};

// 95 % of the contacts are less than 2 mm deep (1 mm seen), all less than 4 mm (3.6 mm seen); 95 % sleep after 4.0 to
// 5.1 s.
TEST_P(HeapOfSeed, FiftyCurvedShardsSleepWithinSixAndAHalfSeconds) {
    constexpr uint32_t kShards = 50;
    auto world = floor_world(kShards + 8);
    drop_shards(*world, 1, kShards, GetParam());
    int most_asleep = -1;
    for (int k = 0; k < 390; ++k) {
        step(*world);
        uint32_t asleep = 0;
        for (uint32_t id = 1; id <= kShards; ++id) asleep += world->is_asleep(id);
        if (most_asleep < 0 && 20 * asleep >= 19 * kShards) most_asleep = k;
    }
    uint32_t asleep = 0;
    for (uint32_t id = 1; id <= kShards; ++id) {
        asleep += world->is_asleep(id);
        EXPECT_GT(world->pose(id).position.y, -0.01f) << id;
        world->wake(id);
    }
    EXPECT_GE(20 * asleep, 19 * kShards);
    world->detect(kStep);
    std::vector<float> depths;
    float floor_depth = 0;
    for (const RigidContact& c : world->contacts()) {
        depths.push_back(-c.distance);
        if (c.a == 0) floor_depth = std::max(floor_depth, -c.distance);
    }
    std::sort(depths.begin(), depths.end());
    std::printf("seed %u: asleep %u of %u, 95 %% at %.2f s; overlap 95 %% %.2f mm, worst %.2f mm, floor %.2f mm\n",
                GetParam(), asleep, kShards, real(most_asleep) * kStep, 1000 * depths[depths.size() * 95 / 100],
                1000 * depths.back(), 1000 * floor_depth);
    EXPECT_LT(depths[depths.size() * 95 / 100], 0.002f);
    EXPECT_LT(floor_depth, 0.004f);
    EXPECT_LT(depths.back(), 0.004f);
    world->solve(kStep);
}

INSTANTIATE_TEST_SUITE_P(RigidPile, HeapOfSeed, testing::Range(0u, 4u));

}  // namespace
}  // namespace cullet
