// What a host hears and gives: log, zones, assert handler, memory; on which threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "engine/assert.hpp"
#include "engine/host_scope.hpp"
#include "engine/jobs.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

struct Heard {
    std::thread::id thread = std::this_thread::get_id();
    std::vector<std::pair<LogLevel, std::string>> sentences;
    std::vector<std::string> open_zones;
    std::map<std::string, uint32_t> zones;
    uint32_t on_other_threads = 0, deepest = 0;

    Host host() {
        Host host;
        host.user = this;
        host.log = [](void* user, LogLevel level, const char* sentence) {
            of(user).sentences.emplace_back(level, sentence);
        };
        host.zone_begin = [](void* user, const char* name) {
            Heard& heard = of(user);
            heard.open_zones.push_back(name);
            ++heard.zones[name];
            heard.deepest = std::max(heard.deepest, static_cast<uint32_t>(heard.open_zones.size()));
        };
        host.zone_end = [](void* user) { of(user).open_zones.pop_back(); };
        return host;
    }

 private:
    static Heard& of(void* user) {
        Heard& heard = *static_cast<Heard*>(user);
        heard.on_other_threads += std::this_thread::get_id() != heard.thread;
        return heard;
    }
};

void expect_sentence(const std::string& sentence) {
    ASSERT_GT(sentence.size(), 20u);
    EXPECT_EQ(sentence.back(), '.') << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
}

TEST(HostLog, ALimitIsNamedOnceASecondWithTheSettingAndTheUserData) {
    Heard heard;
    Settings settings = small_settings();
    settings.limits.bodies = 3;
    settings.threads = 3;
    Breakage b = vase_and_ball(settings, 8, heard.host());
    uint32_t events = 0;
    for (int frame = 0; frame < 30; ++frame) {
        b.world.step();
        for (const RefusedEvent& e : b.world.events().refused) {
            ++events;
            EXPECT_EQ(e.body_user_data, 42u);
            const Vec3 place = b.world.pose(e.body).value().position;
            EXPECT_LT(length(e.place - place), 1.0f);
            EXPECT_GT(length(e.place), 0.01f);  // the centre of mass, not the body frame's origin at the foot
        }
    }
    EXPECT_GT(events, 1u);
    ASSERT_EQ(heard.sentences.size(), 1u);
    EXPECT_EQ(heard.sentences[0].first, LogLevel::Warning);
    expect_sentence(heard.sentences[0].second);
    EXPECT_NE(heard.sentences[0].second.find("limits.bodies"), std::string::npos) << heard.sentences[0].second;
    EXPECT_NE(heard.sentences[0].second.find("42"), std::string::npos) << heard.sentences[0].second;
    EXPECT_EQ(heard.on_other_threads, 0u);
}

TEST(HostLog, AFaultIsAnErrorAndAnEventWithUserDataAndPlace) {
    Heard heard;
    Settings settings = small_settings();
    settings.units_a_frame = 1'000'000;
    Breakage b = vase_and_ball(settings, 8, heard.host());
    for (int frame = 0; frame < 20 && open_tasks(b.world) == 0; ++frame) b.world.step();
    ASSERT_EQ(open_tasks(b.world), 1u);
    Tasks& tasks = tasks_of(b.world);
    uint32_t task = 0;
    while (static_cast<TaskState>(tasks.state[task]) == TaskState::Free) ++task;
    tasks.state[task] = static_cast<uint8_t>(TaskState::Dropped);  // as after a run that gains energy three times over
    b.world.step();
    const EventSpan<FaultEvent> faults = b.world.events().faults;
    ASSERT_EQ(faults.count, 1u);
    EXPECT_EQ(faults[0].body, b.body);
    EXPECT_EQ(faults[0].body_user_data, 42u);
    EXPECT_NEAR(faults[0].place.x, 0, 0.05);
    EXPECT_GT(faults[0].place.y, 0.1f);  // the middle of the vase
    ASSERT_EQ(heard.sentences.size(), 1u);
    EXPECT_EQ(heard.sentences[0].first, LogLevel::Error);
    expect_sentence(heard.sentences[0].second);
    EXPECT_NE(heard.sentences[0].second.find(faults[0].reason), std::string::npos);
    b.world.step();
    EXPECT_EQ(b.world.events().faults.count, 0u);
    EXPECT_EQ(heard.sentences.size(), 1u);
}

TEST(HostLog, AModelWhoseHitsWillBeLateIsAnnouncedWhenItIsAdded) {
    const std::string path = testing::TempDir() + "host_test.cmodel";
    Heard heard;
    World world = make_world(small_settings(), heard.host());
    ASSERT_TRUE(world.add_model(small_pane()).ok());
    EXPECT_EQ(heard.sentences.size(), small_pane().report().advice.empty() ? 0u : 1u);
    heard.sentences.clear();
    Model slow = small_pane();
    auto contents = std::const_pointer_cast<Model::Contents>(slow.contents);  // ours for a moment
    const ModelReport before = contents->report;
    contents->report.advice = "A hit will be late.";
    contents->report.units_of_a_hit = uint64_t{1} << 60;
    ASSERT_TRUE(world.add_model(slow).ok());
    contents->report = before;
    ASSERT_EQ(heard.sentences.size(), 1u);
    EXPECT_EQ(heard.sentences[0].first, LogLevel::Warning);
    EXPECT_EQ(heard.sentences[0].second, contents->name + ": A hit will be late.");
}

TEST(HostZones, EachSystemThatWorkedHasAZoneInTheStepsOnTheThreadThatSteps) {
    Heard heard;
    Settings settings = small_settings();
    settings.threads = 3;
    Breakage b = vase_and_ball(settings, 8, heard.host());
    EXPECT_TRUE(heard.zones.empty());
    ASSERT_GT(step_until_born(b.world, 10), 0u);
    EXPECT_TRUE(heard.open_zones.empty());
    EXPECT_EQ(heard.on_other_threads, 0u);
    EXPECT_EQ(heard.deepest, 2u);
    const uint64_t steps = b.world.report().frame;
    EXPECT_EQ(heard.zones["cullet step"], steps);
    std::string names;
    for (const auto& [name, count] : heard.zones) names += ", " + name;
    names += ",";
    for (const PlannedSystem<WorldData>& system : b.world.contents().plan.systems()) {
        const std::set<std::string> of_some_runs{"fill_stiffness", "measure_regions", "lay_regions",
                                                 "find_soft_strikers", "shape_soft"};
        if (of_some_runs.count(system.name)) continue;
        EXPECT_NE(names.find(", " + system.name + ","), std::string::npos) << system.name << " in" << names;
    }
    EXPECT_EQ(heard.zones["solve_rigid"], steps);
}

struct Failing {
    static void handle(void* user, const char* sentence) {
        std::fprintf(stderr, "the host %s hears: %s\n", static_cast<const char*>(user), sentence);
        std::_Exit(3);
    }
    static Host host() {
        Host host;
        host.user = const_cast<char*>("of this world");
        host.assertion_failed = handle;
        return host;
    }
};
constexpr const char* kHeard = "the host of this world hears: .*job 77";

void fail_in_job_77(JobSystem& jobs) {
    const Host host = Failing::host();
    const HostScope call(host);
    parallel_for(jobs, 200, [](uint32_t i) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));  // so that all threads get some
        if (i == 77) assertion_failed("false", __FILE__, __LINE__, "job %u", i);
    });
}

// Runs all jobs on a thread that is not the caller's.
HostJobs jobs_elsewhere() {
    HostJobs jobs;
    jobs.worker_count = [](void*) { return 2u; };
    jobs.parallel_for = [](void*, uint32_t count, void (*job)(void*, uint32_t), void* context) {
        std::thread([=] {
            for (uint32_t i = 0; i < count; ++i) job(context, i);
        }).join();
    };
    return jobs;
}

TEST(HostAssertDeathTest, AJobOnAnyThreadReachesTheHost) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(fail_in_job_77(*make_jobs(JobBackend::Tbb, 3)), testing::ExitedWithCode(3), kHeard);
    EXPECT_EXIT(fail_in_job_77(*make_jobs(JobBackend::Threads, 3)), testing::ExitedWithCode(3), kHeard);
    EXPECT_EXIT(fail_in_job_77(*make_host_jobs(jobs_elsewhere())), testing::ExitedWithCode(3), kHeard);
}

TEST(HostAssertDeathTest, AJobThatAWorldRunsElsewhereReachesItsHost) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto fail = [] {
        Host host = Failing::host();
        host.jobs = jobs_elsewhere();
        Breakage b = vase_and_ball(small_settings(), 8, host);
        b.world.set_veto(
            [](void*, const ImpactEvent&) -> bool { assertion_failed("false", __FILE__, __LINE__, "job %u", 77u); },
            nullptr);
        for (int frame = 0; frame < 10; ++frame) b.world.step();
    };
    EXPECT_EXIT(fail(), testing::ExitedWithCode(3), kHeard);
}

TEST(HostAssertDeathTest, CookingReachesTheHostItIsGiven) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto fail = [] {
        const Host host = Failing::host();
        CookSettings settings;
        settings.host = &host;
        settings.progress = [](void*, float) { assertion_failed("false", __FILE__, __LINE__, "job %u", 77u); };
        const Vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        const uint32_t triangle[] = {0, 1, 2};
        (void)cook({points, 3, triangle, 1}, settings);
    };
    EXPECT_EXIT(fail(), testing::ExitedWithCode(3), kHeard);
}

TEST(HostAssert, AHandlerEndsWithTheCall) {
    World world = make_world(small_settings(), Failing::host());
    world.step();
    ASSERT_TRUE(world.add_sphere({}).ok());
    EXPECT_EQ(assert_handler().call, nullptr);
}

struct Given {
    std::mutex mutex;
    std::map<void*, size_t> blocks;
    uint64_t taken = 0, wrong = 0;
    uint64_t most = ~0ull;  // blocks; then there is no more
    size_t bytes = 0;

    HostAllocator allocator() {
        return {this,
                [](void* user, size_t size, size_t alignment) -> void* {
                    Given& given = *static_cast<Given*>(user);
                    const std::scoped_lock lock(given.mutex);
                    given.wrong += size == 0 || alignment != 64;
                    if (given.taken == given.most) return nullptr;
                    void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
                    given.wrong += reinterpret_cast<uintptr_t>(memory) % alignment != 0;
                    given.blocks[memory] = size;
                    given.bytes += size;
                    ++given.taken;
                    return memory;
                },
                [](void* user, void* memory, size_t size) {
                    Given& given = *static_cast<Given*>(user);
                    const std::scoped_lock lock(given.mutex);
                    const auto at = given.blocks.find(memory);
                    given.wrong += at == given.blocks.end() || at->second != size;
                    if (at != given.blocks.end()) given.blocks.erase(at);
                    std::free(memory);
                }};
    }
};

TEST(HostMemory, AWorldsBlocksAreTakenWhenItIsMadeAndAllGivenBack) {
    Given given;
    Host host;
    host.allocator = given.allocator();
    {
        Breakage b = vase_and_ball(small_settings(), 8, host);
        const uint64_t taken = given.taken;
        EXPECT_GT(taken, 100u);  // every column, the queues, the arena, the profiler
        ASSERT_GT(step_until_born(b.world, 10), 0u);
        for (int frame = 0; frame < 20; ++frame) b.world.step();
        EXPECT_EQ(given.taken, taken);
    }
    EXPECT_EQ(given.blocks.size(), 0u);
    EXPECT_EQ(given.wrong, 0u);
}

TEST(HostMemory, TwoWorldsAreTheSameOnTheHostsMemoryAndOnTheSystems) {
    Given given;
    Host host;
    host.allocator = given.allocator();
    Breakage ours = vase_and_ball(small_settings()), theirs = vase_and_ball(small_settings(), 8, host);
    for (int frame = 0; frame < 15; ++frame) {
        ours.world.step(), theirs.world.step();
        ASSERT_EQ(ours.world.hash(), theirs.world.hash()) << "frame " << frame;
    }
}

TEST(HostMemory, AModelsTablesComeFromTheHostAndGoBackWithTheLastOfIt) {
    Given given;
    Host host;
    host.allocator = given.allocator();
    const std::string path = testing::TempDir() + "host_test.cmodel";
    ASSERT_TRUE(write_model(small_pane(), path).ok());
    {
        const Model model = read_model(path, &host).value();
        EXPECT_GT(given.taken, 20u);
        const Model same = model;
        EXPECT_GT(given.blocks.size(), 20u);
    }
    EXPECT_EQ(given.blocks.size(), 0u);
    EXPECT_EQ(given.wrong, 0u);
}

/// Refused with a sentence, and all is given back.
template <class Call>
void expect_refused_without_memory(Given& given, const Call& call) {
    const auto result = call();
    EXPECT_FALSE(result.ok());
    expect_sentence(result.error());
    EXPECT_NE(result.error().find("memory"), std::string::npos) << result.error();
    EXPECT_EQ(given.blocks.size(), 0u) << "of " << given.most;
}

TEST(HostMemory, AWorldThatFindsNoMemoryIsRefusedWithItsLimitsAndGivesBackWhatItTook) {
    for (const bool is_hosted : {false, true}) {
        Given given;
        Host host;
        host.allocator = given.allocator();
        const auto make = [&] {
            given.taken = 0;
            return is_hosted ? World::create_hosted(small_settings(), host) : World::create(small_settings(), host);
        };
        ASSERT_TRUE(make().ok());
        const uint64_t blocks = given.taken;
        for (given.most = 0; given.most < blocks; given.most += given.most < 20 ? 1 : 7)
            expect_refused_without_memory(given, make);
        given.most = 20;
        EXPECT_NE(make().error().find("vertices 65536"), std::string::npos) << make().error();
        given.most = ~0ull;
        EXPECT_TRUE(make().ok());
    }
}

TEST(HostMemory, ASnapshotOrAModelThatFindsNoMemoryIsRefusedAndTheWorldStands) {
    Given given;
    Host host;
    host.allocator = given.allocator();
    const std::string path = testing::TempDir() + "host_test.cmodel";
    ASSERT_TRUE(write_model(small_pane(), path).ok());
    for (given.most = 0; given.most < 60; given.most += 7) {
        given.taken = 0;
        expect_refused_without_memory(given, [&] { return read_model(path, &host); });
    }
    given.most = ~0ull;
    Breakage b = vase_and_ball(small_settings(), 8, host);
    b.world.step();
    const auto bytes = b.world.snapshot();
    ASSERT_TRUE(bytes.ok()) << bytes.error();
    const uint64_t hash = b.world.hash();
    given.most = given.taken + 50;
    const Result<void> loaded = b.world.restore(bytes->data(), bytes->size());
    EXPECT_NE(loaded.error().find("vertices 65536"), std::string::npos) << loaded.error();
    EXPECT_EQ(b.world.hash(), hash);
    b.world.step();
}

/// Memory in which something stood before.
Host host_of_used_memory() {
    Host host;
    host.allocator.allocate = [](void*, size_t size, size_t alignment) {
        void* const memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
        return std::memset(memory, 0xcd, size);
    };
    host.allocator.release = [](void*, void* memory, size_t) { std::free(memory); };
    return host;
}

/// Hashes of a vase that breaks, is saved and loaded, beside the free row of a body that is gone.
std::vector<uint64_t> hashes_in(const Host& host) {
    Settings settings = small_settings();
    settings.limits = {64, 8, 1u << 15, 1u << 15, 2, 1u << 17, 64, 8};
    settings.units_a_frame = 2'000'000;
    Breakage hit = vase_and_ball(settings, 8, host);
    const BodyId floor = add_floor(hit.world);
    std::vector<uint64_t> hashes;
    for (int frame = 0; frame < 40; ++frame) {
        const bool is_removed = frame == 2 && hit.world.remove(floor).ok();
        EXPECT_EQ(is_removed, frame == 2);
        if (frame == 8) {
            const auto bytes = hit.world.snapshot().value();
            EXPECT_TRUE(hit.world.restore(bytes.data(), bytes.size()).ok());
        }
        hit.world.step();
        hashes.push_back(hit.world.hash());
    }
    EXPECT_GT(shells_of(hit.world).size(), 1u) << "nothing broke";
    return hashes;
}

TEST(HostMemory, WhatStoodInItBeforeDoesNotMatter) {
    EXPECT_EQ(hashes_in({}), hashes_in(host_of_used_memory()));
}

TEST(HostMemory, AFreeRowOfABodyNamesNoShell) {
    World world = make_world(small_settings(), host_of_used_memory());
    const BodyId floor = add_floor(world);
    (void)world.add_sphere(ball_at({0, 1, 0}, 1, 1)).value();
    world.step();
    EXPECT_TRUE(world.remove(floor).ok());
    for (int frame = 0; frame < 3; ++frame) world.step();
    EXPECT_EQ(shells_of(world).size(), 0u);
}

}  // namespace
}  // namespace cullet::test
