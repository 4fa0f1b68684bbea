// The rigid world on the threads that there are: the same bytes whatever their number.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/byte_stream.hpp"
#include "engine/jobs.hpp"
#include "engine/math.hpp"
#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

constexpr uint32_t kShards = 20;

/// Shards of many cells fall on a floor, and balls of brick are shot through them: pairs come and go, and sweeps stop
/// what is fast. The world's bytes after each tenth step.
std::vector<std::vector<uint8_t>> course_of(JobSystem* jobs) {
    auto world = floor_world(kShards + 16);
    if (jobs) world->use_jobs(*jobs);
    for (uint32_t k = 0; k < kShards; ++k)
        add_shard(*world, 1 + k, {0.1f * real(k % 3), 0.1f + 0.1f * real(k), 0.08f * real(k % 4)},
                  normalised(Quat{real(k % 5) - 2, real(k % 7) - 3, 1, 2}));
    std::vector<std::vector<uint8_t>> course;
    uint32_t sweeps = 0;
    for (uint32_t step_number = 0; step_number < 60; ++step_number) {
        if (step_number % 10 == 5) {
            const RigidId shot = kShards + 1 + step_number / 10;
            add_box(*world, shot, {-2, 0.1f, 0.1f}, {0.05f, 0.05f, 0.05f}, 2000);
            world->set_motion(shot, {{60, 0.5f, 0}, {20, 5, 0}});
        }
        step(*world);
        sweeps = world->counts().sweeps;
        if (step_number % 10 != 9) continue;
        ByteWriter out;
        world->save(out);
        course.push_back(out.bytes);
    }
    EXPECT_GT(sweeps, 20u);
    EXPECT_GT(world->counts().contacts, 30u);
    return course;
}

TEST(RigidThreads, GiveTheBytesOfNone) {
    const auto alone = course_of(nullptr);
    for (const uint32_t threads : {2u, 3u, 8u}) {
        const auto jobs = make_jobs(JobBackend::Threads, threads);
        EXPECT_EQ(course_of(jobs.get()), alone) << threads << " threads";
    }
}

/// Forty stacks of four boxes: so many contacts that their islands are solved in two groups.
std::vector<uint8_t> stacks_of(JobSystem* jobs) {
    constexpr uint32_t kStacks = 40, kHigh = 4;
    auto world = floor_world(kStacks * kHigh + 1);
    if (jobs) world->use_jobs(*jobs);
    for (uint32_t k = 0; k < kStacks * kHigh; ++k)
        add_box(*world, 1 + k,
                {0.3f * real(k % 8) - 1, 0.05f + 0.101f * real(k / kStacks), 0.3f * real(k % kStacks / 8) - 0.6f},
                {0.1f, 0.05f, 0.1f}, 1000);
    uint32_t contacts = 0;
    for (int k = 0; k < 40; ++k) {
        step(*world);
        contacts = std::max(contacts, static_cast<uint32_t>(world->counts().contacts));
    }
    EXPECT_GT(contacts, 600u);
    for (uint32_t k = 0; k < kStacks; ++k)
        EXPECT_NEAR(world->pose(1 + (kHigh - 1) * kStacks + k).position.y, 0.35f, 0.002f);
    ByteWriter out;
    world->save(out);
    return out.bytes;
}

TEST(RigidThreads, GiveTheBytesOfNoneWhereIslandsAreSolvedSideBySide) {
    const auto alone = stacks_of(nullptr);
    for (const uint32_t threads : {2u, 3u, 8u}) {
        const auto jobs = make_jobs(JobBackend::Threads, threads);
        EXPECT_EQ(stacks_of(jobs.get()), alone) << threads << " threads";
    }
}

/// More boxes cross each other's ways than the sweep has rows for neighbours: 400 in a metre, at 60 m/s. In the second
/// step there are 40,000, and room for 35,584.
std::vector<uint8_t> burst_of(JobSystem* jobs) {
    constexpr uint32_t kBoxes = 400;
    auto world = make_bullet_world(kBoxes);
    if (jobs) world->use_jobs(*jobs);
    for (uint32_t k = 0; k < kBoxes; ++k) {
        add_box(*world, k, {0.1f * real(k % 8), 0.1f * real(k / 8 % 8), 0.1f * real(k / 64)}, {0.02f, 0.03f, 0.04f},
                1000);
        const double rise = static_cast<double>(k % 11) / 5 - 1, flat = std::sqrt(1 - rise * rise);
        double sine = 0, cosine = 0;
        sine_cosine(2.4 * k, sine, cosine);
        world->set_motion(k, {(60.0 * Vec3d{flat * cosine, rise, flat * sine}).to_float(), {}});
    }
    for (int k = 0; k < 4; ++k) step(*world);
    EXPECT_GT(world->counts().sweeps, 100u);
    ByteWriter out;
    world->save(out);
    return out.bytes;
}

TEST(RigidThreads, GiveTheBytesOfNoneWhereMoreMeetThanThereIsRoomFor) {
    const auto alone = burst_of(nullptr);
    for (const uint32_t threads : {2u, 8u}) {
        const auto jobs = make_jobs(JobBackend::Threads, threads);
        EXPECT_EQ(burst_of(jobs.get()), alone) << threads << " threads";
    }
}

}  // namespace
}  // namespace cullet
