#include "engine/inner_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numeric>

#include "engine/jobs.hpp"
#include "engine/random.hpp"

namespace cullet {

// A rod of cells that conduct heat, one range of rows a task; small chunks, so that a short rod has many.
struct Rods : Table<Rods> {
    using Table::Table;
    static constexpr const char* kName = "rods";
    Column<float, Buffers::Two> heat{*this, "heat", "K"};
    Column<float> work{*this, "work"};
    Column<uint32_t> calls{*this, "calls"};
};
template <>
inline constexpr uint32_t kRowsPerChunk<Rods> = 16;

struct RodTasks : Table<RodTasks> {
    using Table::Table;
    static constexpr const char* kName = "rod_tasks";
    Column<uint32_t> first{*this, "first"};
    Column<uint32_t> count{*this, "count"};
    Column<float> total{*this, "total"};
    Column<uint32_t> checks{*this, "checks"};
    Column<uint32_t> repetitions{*this, "repetitions"};
    Column<uint32_t> last{*this, "last"};  // repetitions after which it ends early
};

struct Stalls {
    uint32_t every = 0;  // calls of a chunk between two naps of a tenth of a millisecond
};

struct RodWorld {
    Rods rods{4096};
    RodTasks tasks{4};
    Stalls stalls;

    explicit RodWorld(uint32_t cells = 1000) {
        rods.append(3000);
        tasks.append(2);
        tasks.first[0] = 0, tasks.count[0] = cells;
        tasks.first[1] = 1501, tasks.count[1] = cells;
        tasks.last[0] = tasks.last[1] = 0xffffffffu;
        for (uint32_t r = 0; r < rods.size(); ++r) rods.heat.set(r, static_cast<float>(Random{1}.uniform(r) * 300), 0);
    }
    template <class T>
    T& table() {
        if constexpr (std::is_same_v<T, Rods>)
            return rods;
        else
            return tasks;
    }
    template <class T>
    T& resource() {
        return stalls;
    }
    template <class T>
    Row<T> row_of(uint32_t task) const {
        return Row<T>(task);
    }
    template <class T>
    Rows<T> rows_of(uint32_t task) {
        return {tasks.first[task], tasks.count[task]};
    }
    uint64_t hash() const { return tasks.hash(rods.hash(0)); }
};

// h' = h + (left + right - 2 h) / 4, from the old side. Rows beyond the first and last of the table mirror.
void conduct(Rows<Rods> rows, In<&Rods::heat> old, Out<&Rods::heat> heat, InOut<&Rods::calls> calls) {
    for (const uint32_t r : rows) {
        const float left = old[r ? r - 1 : 0], right = old[r + 1];
        heat.set(r, old[r] + 0.25f * (left + right - 2 * old[r]));
        calls.set(r, calls[r] + 1);
    }
}
void do_work(Rows<Rods> rows, const Stalls& stalls, In<&Rods::heat> old, In<&Rods::calls> calls,
             InOut<&Rods::work> work) {
    for (const uint32_t r : rows) work.set(r, work[r] * 0.999f + old[r] / 3.0f);
    if (stalls.every && Random{2}.bits(rows.first, calls[rows.first]) % stalls.every == 0)
        std::this_thread::sleep_for(std::chrono::microseconds(100));
}
void add_up(Of<RodTasks> task, const Rods& rods, RodTasks& tasks) {
    float total = 0;
    for (uint32_t r = 0; r < tasks.count[task.row]; ++r) total += rods.work[tasks.first[task.row] + r];
    tasks.total[task.row] = total;
    ++tasks.checks[task.row];
}
// A split: the task's range grows by one row, copied from the middle, while the loop runs.
void grow(Of<RodTasks> task, Rods& rods, RodTasks& tasks) {
    const uint32_t first = tasks.first[task.row], count = tasks.count[task.row];
    if (count == 1400) return;
    rods.copy_rows(rods, first + count / 2, first + count, 1);
    ++tasks.count[task.row];
}
void count_repetition(Serial, RodTasks& tasks) {
    ++tasks.repetitions[0];
}

bool goes_on(RodWorld& world, uint32_t task) {
    return world.tasks.checks[task] < world.tasks.last[task];
}

namespace {

using Loop = InnerLoop<RodWorld>;

Loop make_loop(bool grows = false) {
    Loop loop;
    loop.then<conduct>().then<do_work>().then<add_up>(3);
    if (grows) loop.then<grow>(5);
    loop.then<count_repetition>();
    loop.finish();
    return loop;
}

void run_team(const Loop& loop, RodWorld& world, const Loop::Run& run, JobSystem& jobs) {
    Loop::Team team(loop, world, run, jobs.worker_count());
    parallel_for(jobs, jobs.worker_count(), [&](uint32_t) { team.work(); });
}

// A host that runs the team's jobs in a strange way.
enum class Order { Backwards, Random, OneThread, LateStart };
struct Host {
    Order order;
    uint32_t workers;
    std::unique_ptr<JobSystem> jobs;
    Host(Order o, uint32_t w) : order(o), workers(w) {
        HostJobs table;
        table.user = this;
        table.worker_count = [](void* host) { return static_cast<Host*>(host)->workers; };
        table.parallel_for = run;
        jobs = make_host_jobs(table);
    }
    static void run(void* user, uint32_t count, void (*job)(void*, uint32_t), void* context) {
        const Order order = static_cast<Host*>(user)->order;
        std::vector<uint32_t> list(count);
        std::iota(list.begin(), list.end(), 0u);
        if (order == Order::Backwards) std::reverse(list.begin(), list.end());
        if (order == Order::Random)
            for (uint32_t i = count; i > 1; --i) std::swap(list[i - 1], list[Random{7}.bits(i) % i]);
        if (order == Order::OneThread) {
            std::thread other([&] {
                for (const uint32_t i : list) job(context, i);
            });
            return other.join();
        }
        if (order != Order::LateStart) {
            for (const uint32_t i : list) job(context, i);
            return;
        }
        std::vector<std::thread> threads;
        for (const uint32_t i : list)
            threads.emplace_back([=] {
                std::this_thread::sleep_for(std::chrono::milliseconds(3 * (count - 1 - i)));
                job(context, i);
            });
        for (std::thread& thread : threads) thread.join();
    }
};

struct Backend {
    std::string name;
    std::unique_ptr<JobSystem> jobs;
    std::unique_ptr<Host> host;
    JobSystem& get() { return host ? *host->jobs : *jobs; }
};
std::vector<Backend> all_backends() {
    std::vector<Backend> list;
    for (const uint32_t threads : {1u, 2u, 3u, 8u})
        list.push_back({std::to_string(threads) + " threads", make_jobs(JobBackend::Threads, threads), nullptr});
    for (const uint32_t threads : {2u, 8u})
        list.push_back({std::to_string(threads) + " of TBB", make_jobs(JobBackend::Tbb, threads), nullptr});
    list.push_back({"a host that runs them backwards", nullptr, std::make_unique<Host>(Order::Backwards, 4u)});
    list.push_back({"a host that runs them in some order", nullptr, std::make_unique<Host>(Order::Random, 4u)});
    list.push_back({"a host that runs all on one thread", nullptr, std::make_unique<Host>(Order::OneThread, 3u)});
    list.push_back({"a host whose threads come late", nullptr, std::make_unique<Host>(Order::LateStart, 3u)});
    return list;
}

uint64_t hash_alone(const Loop& loop, const Loop::Run& run) {
    RodWorld world;
    loop.run_alone(world, run);
    return world.hash();
}

void expect_the_same_everywhere(const Loop& loop, const Loop::Run& run) {
    const uint64_t alone = hash_alone(loop, run);
    RodWorld reference;
    loop.run_alone(reference, run);
    for (Backend& backend : all_backends()) {
        RodWorld world;
        run_team(loop, world, run, backend.get());
        EXPECT_EQ(world.hash(), alone) << backend.name;
        EXPECT_EQ(world.rods.first_difference(reference.rods), "") << backend.name;
        EXPECT_EQ(world.tasks.first_difference(reference.tasks), "") << backend.name;
    }
}

TEST(InnerLoop, AloneOrInAnyTeamTheBitsAreTheSame) {
    const Loop loop = make_loop();
    expect_the_same_everywhere(loop, {0, 0, 150, goes_on});
    expect_the_same_everywhere(loop, {1, 7, 100, goes_on});  // rows that start inside of a chunk, an odd first side
}

TEST(InnerLoop, ATableThatGrowsInsideTheLoopGivesTheSameBits) {
    expect_the_same_everywhere(make_loop(true), {1, 3, 400, goes_on});
}

TEST(InnerLoop, RowsOfOtherTasksAreNotTouched) {
    const Loop loop = make_loop();
    RodWorld world, before;
    run_team(loop, world, {1, 0, 50, goes_on}, *make_jobs(JobBackend::Threads, 3));
    for (uint32_t r = 0; r < world.rods.size(); ++r) {
        const bool is_own = r >= 1501 && r < 2501;
        ASSERT_EQ(world.rods.calls[r], is_own ? 50u : 0u);
        if (!is_own) {
            ASSERT_EQ(world.rods.heat.get(r, 0), before.rods.heat.get(r, 0));
        }
    }
}

TEST(InnerLoop, ASystemMayRunInEachThirdRepetitionOnly) {
    const Loop loop = make_loop();
    const auto checks = [&](uint32_t first, uint32_t repetitions) {
        RodWorld world;
        loop.run_alone(world, {0, first, repetitions, nullptr});
        return world.tasks.checks[0];
    };
    EXPECT_EQ(checks(0, 2), 0u);
    EXPECT_EQ(checks(0, 3), 1u);
    EXPECT_EQ(checks(0, 9), 3u);
    EXPECT_EQ(checks(2, 1), 1u);  // number 2 is the third
    EXPECT_EQ(checks(3, 2), 0u);
}

TEST(InnerLoop, CutInSlicesItGivesTheBitsOfOneRun) {
    const Loop loop = make_loop(true);
    RodWorld one, sliced;
    loop.run_alone(one, {0, 0, 101, goes_on});
    const auto jobs = make_jobs(JobBackend::Threads, 2);
    for (uint32_t first = 0, n = 1; first < 101; first += n, ++n)
        run_team(loop, sliced, {0, first, std::min(n, 101 - first), goes_on}, *jobs);
    EXPECT_EQ(sliced.hash(), one.hash());
}

TEST(InnerLoop, ItEndsAfterTheRepetitionThatSaysSo) {
    const Loop loop = make_loop();
    for (Backend& backend : all_backends()) {
        RodWorld world;
        world.tasks.last[0] = 4;
        run_team(loop, world, {0, 0, 1000, goes_on}, backend.get());
        EXPECT_EQ(world.tasks.repetitions[0], 12u) << backend.name;  // the fourth check is in number 11
    }
    RodWorld world;
    world.tasks.last[0] = 4;
    loop.run_alone(world, {0, 0, 1000, goes_on});
    EXPECT_EQ(world.tasks.repetitions[0], 12u);
}

TEST(InnerLoop, NoRepetitionsDoNothing) {
    const Loop loop = make_loop();
    RodWorld world, before;
    loop.run_alone(world, {0, 5, 0, goes_on});
    run_team(loop, world, {0, 5, 0, goes_on}, *make_jobs(JobBackend::Threads, 2));
    EXPECT_EQ(world.hash(), before.hash());
}

TEST(InnerLoop, ATaskWithoutRowsEnds) {
    const Loop loop = make_loop();
    RodWorld world(0);
    run_team(loop, world, {0, 0, 10, goes_on}, *make_jobs(JobBackend::Threads, 3));
    EXPECT_EQ(world.tasks.repetitions[0], 10u);
}

TEST(InnerLoop, TheSidesOfATwoSidedColumnTakeTurns) {
    Loop loop;
    loop.then<conduct>();
    loop.finish();
    RodWorld world, before;
    loop.run_alone(world, {0, 0, 1, nullptr});
    EXPECT_EQ(world.rods.heat.get(10, 0), before.rods.heat.get(10, 0)) << "the old side is kept";
    const float expected =
        before.rods.heat.get(10, 0) +
        0.25f * (before.rods.heat.get(9, 0) + before.rods.heat.get(11, 0) - 2 * before.rods.heat.get(10, 0));
    EXPECT_EQ(world.rods.heat.get(10, 1), expected);
    const float after_one = world.rods.heat.get(10, 1);
    loop.run_alone(world, {0, 1, 1, nullptr});
    EXPECT_EQ(world.rods.heat.get(10, 1), after_one);
    EXPECT_NE(world.rods.heat.get(10, 0), before.rods.heat.get(10, 0));
}

TEST(InnerLoop, EachChunkRunsExactlyOnceInManyShortRepetitions) {
    // Passes of two, three and many chunks by turns: a ticket of one pass must never pass for one of the next.
    Loop loop;
    loop.then<conduct>().then<do_work>().then<grow>(50).then<count_repetition>();
    loop.finish();
    for (const uint32_t threads : {2u, 3u, 8u}) {
        const auto jobs = make_jobs(JobBackend::Threads, threads);
        RodWorld world(20), reference(20);
        run_team(loop, world, {0, 0, 6000, nullptr}, *jobs);
        loop.run_alone(reference, {0, 0, 6000, nullptr});
        ASSERT_EQ(world.rods.first_difference(reference.rods), "") << threads;
        ASSERT_EQ(world.tasks.repetitions[0], 6000u);
    }
}

TEST(InnerLoop, AWorkerThatStallsHoldsUpNobodyForever) {
    const Loop loop = make_loop();
    RodWorld reference(60);
    loop.run_alone(reference, {0, 0, 1500, goes_on});
    for (Backend& backend : all_backends()) {
        RodWorld world(60);
        world.stalls.every = 200;
        run_team(loop, world, {0, 0, 1500, goes_on}, backend.get());
        EXPECT_EQ(world.hash(), reference.hash()) << backend.name;
    }
}

TEST(InnerLoop, ManyShortTeamsEnd) {
    const Loop loop = make_loop();
    const auto jobs = make_jobs(JobBackend::Threads, 4);
    RodWorld world(50), reference(50);
    for (uint32_t n = 0; n < 2000; ++n) {
        run_team(loop, world, {n % 2, n, 1, goes_on}, *jobs);
        loop.run_alone(reference, {n % 2, n, 1, goes_on});
    }
    EXPECT_EQ(world.hash(), reference.hash());
}

TEST(InnerLoop, TwoTeamsMayRunBesideEachOther) {
    const Loop loop = make_loop();
    RodWorld reference;
    loop.run_alone(reference, {0, 0, 60, goes_on});
    std::vector<RodWorld> worlds(2);
    const auto work = [&](size_t w) {
        const auto jobs = make_jobs(JobBackend::Threads, 2);
        run_team(loop, worlds[w], {0, 0, 60, goes_on}, *jobs);
    };
    std::thread other(work, 1);
    work(0);
    other.join();
    EXPECT_EQ(worlds[0].hash(), reference.hash());
    EXPECT_EQ(worlds[1].hash(), reference.hash());
}

TEST(InnerLoop, TheCallersRoundingDoesNotChangeTheBits) {
    const Loop loop = make_loop();
    RodWorld nearest, alone, team;
    loop.run_alone(nearest, {0, 0, 60, goes_on});
    const auto jobs = make_jobs(JobBackend::Threads, 2);
    const unsigned before = _mm_getcsr();
    _mm_setcsr(0x1f80u | 0x4000u);  // upwards, denormals kept
    loop.run_alone(alone, {0, 0, 60, goes_on});
    run_team(loop, team, {0, 0, 60, goes_on}, *jobs);
    const unsigned after = _mm_getcsr();
    _mm_setcsr(before);
    EXPECT_EQ(after & 0xe040u, 0x4000u) << "the caller's own mode is back";
    EXPECT_EQ(alone.hash(), nearest.hash());
    EXPECT_EQ(team.hash(), nearest.hash());
}

TEST(InnerLoop, ItDescribesItself) {
    EXPECT_EQ(make_loop().describe(),
              "        conduct  [rows]\n"
              "        reads  rods.heat, rods.calls\n"
              "        writes rods.heat (new side), rods.calls\n"
              "        do_work  [rows]\n"
              "        reads  Stalls, rods.heat, rods.calls, rods.work\n"
              "        writes rods.work\n"
              "        after  conduct\n"
              "        add_up  [bodies]  every 3 repetitions\n"
              "        reads  rods, rod_tasks\n"
              "        writes rod_tasks\n"
              "        after  do_work\n"
              "        count_repetition  [serial]\n"
              "        reads  rod_tasks\n"
              "        writes rod_tasks\n"
              "        after  add_up\n");
}

}  // namespace
}  // namespace cullet
