#include "sample_game/allocations.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

#include "engine/jobs.hpp"
#include "engine/rigid_allocations.hpp"
#include "engine/rigid_world.hpp"

namespace cullet {
namespace {

// Keeps the compiler from leaving out an allocation that nobody uses.
void use(void* memory) {
    asm volatile("" : : "g"(memory) : "memory");
}

template <class F>
AllocationCounts counted(F call) {
    start_counting_allocations();
    call();
    return stop_counting_allocations();
}

TEST(Allocations, NothingIsCountedWhenNothingIsAllocated) {
    const AllocationCounts counts = counted([] {});
    EXPECT_EQ(counts.ours, 0u);
    EXPECT_EQ(counts.rigid, 0u);
}

// The thread sanitizer of clang 14 does not tell of the C library's aligned calls.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CULLET_ALIGNED_CALLS_ARE_HIDDEN 1
#endif
#endif
#ifdef CULLET_ALIGNED_CALLS_ARE_HIDDEN
constexpr uint64_t kSeenOfAligned = 0;
#else
constexpr uint64_t kSeenOfAligned = 1;
#endif

TEST(Allocations, EveryWayToAskForMemoryIsSeenOnce) {
    const auto one = [](auto ask) { return counted([&] { use(ask()); }).ours; };
    std::vector<void*> mine(16);
    EXPECT_EQ(one([&] { return mine[0] = std::malloc(10); }), 1u);
    EXPECT_EQ(one([&] { return mine[1] = std::calloc(3, 10); }), 1u);
    EXPECT_EQ(one([&] { return mine[0] = std::realloc(mine[0], 1000); }), 1u);
    EXPECT_EQ(one([&] { return mine[2] = std::aligned_alloc(64, 128); }), kSeenOfAligned);
    EXPECT_EQ(one([&] { return mine[3] = memalign(256, 10); }), kSeenOfAligned);
    EXPECT_EQ(one([&] { return posix_memalign(&mine[4], 4096, 10), mine[4]; }), kSeenOfAligned);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(mine[4]) % 4096, 0u);
    for (void* memory : mine) std::free(memory);
    void* wrong = nullptr;
    EXPECT_EQ(posix_memalign(&wrong, 3, 10), EINVAL);
}

TEST(Allocations, OperatorNewIsSeenOnceAlignedOrNot) {
    struct alignas(128) Wide {
        char bytes[128];
    };
    std::unique_ptr<int> plain;
    std::unique_ptr<Wide> wide;
    EXPECT_EQ(counted([&] { plain.reset(new int(3)), use(plain.get()); }).ours, 1u);
    EXPECT_EQ(counted([&] { wide.reset(new Wide), use(wide.get()); }).ours, 1u);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(wide.get()) % 128, 0u);
}

TEST(Allocations, AVectorThatDoublesAsksElevenTimesForAThousandRows) {
    const AllocationCounts counts = counted([] {
        std::vector<int> rows;
        for (int r = 0; r < 1000; ++r) rows.push_back(r), use(rows.data());
    });
    EXPECT_EQ(counts.ours, 11u);  // 1, 2, 4 ... 1024
}

TEST(Allocations, WithinReservedRoomNothingIsAsked) {
    std::vector<int> rows;
    rows.reserve(1000);
    const AllocationCounts counts = counted([&] {
        for (int r = 0; r < 1000; ++r) rows.push_back(r), use(rows.data());
    });
    EXPECT_EQ(counts.ours, 0u);
}

TEST(Allocations, NothingIsCountedAfterTheEndOrBeforeTheStart) {
    counted([] {});
    use(std::make_unique<int>(1).get());
    EXPECT_EQ(counted([] {}).ours, 0u);
    EXPECT_EQ(stop_counting_allocations().ours, 0u);
}

TEST(Allocations, InsideTheRigidEngineTheyAreCountedApart) {
    std::vector<std::unique_ptr<int>> kept(3);
    const AllocationCounts counts = counted([&] {
        {
            const InsideRigidEngine inside;
            kept[0] = std::make_unique<int>(1);
            {
                const InsideRigidEngine again;
                kept[1] = std::make_unique<int>(2);
            }
        }
        kept[2] = std::make_unique<int>(3);
    });
    EXPECT_EQ(counts.rigid, 2u);
    EXPECT_EQ(counts.ours, 1u);
}

TEST(Allocations, TheRigidWorldKnowsItsOwnSinceItsCreation) {
    auto world = make_bullet_world(16);
    EXPECT_EQ(world->counts().allocations, 0u);
    const AllocationCounts counts = counted([&] {
        const Vec3 corners[] = {{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}, {0, -1, 0}};
        const std::array<uint32_t, 3> faces[] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
        world->add_static_triangles(0, corners, faces, 0.5f, 0, 1, ~0u);
        world->detect(0.01f);
        world->solve(0.01f);
    });
    EXPECT_GT(counts.rigid, 0u);
    EXPECT_EQ(world->counts().allocations, counts.rigid);
    EXPECT_EQ(counts.ours, 0u);
}

void every_job_allocates(JobSystem& jobs, uint64_t& ours) {
    constexpr uint32_t kJobs = 2000;
    std::vector<void*> kept(kJobs);
    const auto pass = [&] {
        parallel_for(jobs, kJobs, [&](uint32_t i) { use(kept[i] = std::malloc(16)); });
        for (void* memory : kept) std::free(memory);
    };
    pass();  // the threads' own first allocations
    start_counting_allocations();
    pass();
    ours = stop_counting_allocations().ours;
}

TEST(Allocations, ThreadsOfOurOwnAreSeen) {
    const auto jobs = make_jobs(JobBackend::Threads, 3);
    uint64_t ours = 0;
    every_job_allocates(*jobs, ours);
    EXPECT_EQ(ours, 2000u);
}

TEST(Allocations, ThreadsOfTbbAreSeen) {
    const auto jobs = make_jobs(JobBackend::Tbb, 2);
    uint64_t ours = 0;
    every_job_allocates(*jobs, ours);
    EXPECT_GE(ours, 2000u);
    EXPECT_LT(ours, 2100u);  // tasks of TBB's own come from its pools
}

}  // namespace
}  // namespace cullet
