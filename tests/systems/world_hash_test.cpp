// The same bytes after every frame, whoever runs the jobs. A difference is told by frame, system and place.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <numeric>
#include <thread>

#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// Backward, shuffled anew each call, or forward; always on the caller's thread, whatever worker_count says.
struct OddJobs {
    enum class Order { Forward, Backward, Shuffled } order;
    uint64_t calls = 0;
    static void run(void* user, uint32_t count, void (*job)(void* context, uint32_t index), void* context) {
        auto& self = *static_cast<OddJobs*>(user);
        uint64_t stride = 1, start = 0;
        if (self.order == Order::Shuffled && count > 0) {
            for (stride = (self.calls * 2654435761u) % count + 1; std::gcd<uint64_t>(stride, count) != 1;) ++stride;
            start = self.calls++ * 40503u;
        }
        for (uint32_t n = 0; n < count; ++n) {
            const uint32_t i = self.order == Order::Forward ? n : count - 1 - n;
            job(context, static_cast<uint32_t>((start + i * stride) % count));
        }
    }
    Host host() {
        Host h;
        h.jobs.user = this;
        h.jobs.worker_count = [](void*) { return 3u; };
        h.jobs.parallel_for = &OddJobs::run;
        return h;
    }
};

using MakeBreakage = std::function<Breakage(const Settings&, const Host&)>;

struct Scene {
    const char* name;
    MakeBreakage make;
    uint32_t frames;
};

const Scene kScenes[] = {
    {"Vase", [](const Settings& s, const Host& h) { return vase_and_ball(s, 8, h); }, 40},
    {"FineVase", [](const Settings& s, const Host& h) { return vase_and_ball(s, 8, h, 0.3f, fine_vase()); }, 24},
    {"Wall", [](const Settings& s, const Host& h) { return wall_and_ball(s, 10, h); }, 40},
    {"Pane", [](const Settings& s, const Host& h) { return pane_and_ball(s, 8, h); }, 40},
};

/// A budget that a hit does not finish in one frame, so that holds are part of what is compared.
Settings held_settings(uint32_t threads) {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    settings.units_a_frame = 2'000'000;
    settings.threads = threads;
    return settings;
}

uint64_t hash_of_run(const Scene& scene, const Settings& settings, const Host& host, std::vector<uint64_t>& hashes) {
    Breakage b = scene.make(settings, host);
    for (uint32_t frame = 0; frame < scene.frames; ++frame) {
        b.world.step();
        hashes.push_back(b.world.hash());
    }
    return hashes.back();
}

/// Above this many vertices all workers share one body: the fine vase must be among them.
TEST(WorldHashScenes, TheFineVaseIsLargeEnoughForATeam) {
    EXPECT_GT(fine_vase().report().vertices, kTeamVertices);
}

/// Two worlds side by side: after each system the tables are compared; the first difference is told.
std::string first_difference(const Scene& scene, const Settings& a, const Host& host_a, const Settings& b,
                             const Host& host_b) {
    Breakage one = scene.make(a, host_a), two = scene.make(b, host_b);
    // Worlds step one after the other, so each system's hash of the first is kept for the second.
    std::vector<std::pair<std::string, uint64_t>> trail;
    std::string found;
    size_t at = 0;
    after_each_system(one.world, [&](const std::string& name) { trail.push_back({name, one.world.hash()}); });
    after_each_system(two.world, [&](const std::string& name) {
        if (found.empty() && trail[at].second != two.world.hash()) found = name;
        ++at;
    });
    for (uint32_t frame = 0; frame < scene.frames; ++frame) {
        trail.clear();
        at = 0;
        one.world.step();
        two.world.step();
        if (!found.empty())
            return "after " + found + ", frame " + std::to_string(frame) +
                   ", seen at its end: " + state_of(one.world).first_difference(state_of(two.world));
    }
    return "";
}

class WorldHash : public testing::TestWithParam<Scene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, WorldHash, testing::ValuesIn(kScenes),
                         [](const auto& s) { return std::string(s.param.name); });

TEST_P(WorldHash, IsEqualAfterEverySystemOnOneTwoAndThreeThreads) {
    for (const uint32_t threads : few_or_all<std::vector<uint32_t>>({3}, {2, 3}))
        EXPECT_EQ(first_difference(GetParam(), held_settings(1), {}, held_settings(threads), {}), "")
            << threads << " threads";
}

TEST_P(WorldHash, IsEqualWhenAHostRunsJobsForwardBackwardOrShuffledOnOneThread) {
    using Order = OddJobs::Order;
    for (const Order order :
         few_or_all<std::vector<Order>>({Order::Shuffled}, {Order::Forward, Order::Backward, Order::Shuffled})) {
        OddJobs jobs{order};
        EXPECT_EQ(first_difference(GetParam(), held_settings(1), {}, held_settings(1), jobs.host()), "")
            << "order " << static_cast<int>(order);
    }
}

TEST_P(WorldHash, ChangesWhenSomethingBreaks) {
    std::vector<uint64_t> hashes;
    hash_of_run(GetParam(), held_settings(1), {}, hashes);
    EXPECT_NE(hashes.front(), hashes.back());
}

TEST(WorldHashScenes, TwoWorldsOnTwoThreadsAtOnceGiveWhatTheyGiveAlone) {
    std::vector<uint64_t> alone[2], together[2];
    for (size_t i = 0; i < 2; ++i) hash_of_run(kScenes[i], held_settings(2), {}, alone[i]);
    std::thread other([&] { hash_of_run(kScenes[1], held_settings(2), {}, together[1]); });
    hash_of_run(kScenes[0], held_settings(2), {}, together[0]);
    other.join();
    for (size_t i = 0; i < 2; ++i) EXPECT_EQ(alone[i], together[i]) << kScenes[i].name;
}

}  // namespace
}  // namespace cullet::test
