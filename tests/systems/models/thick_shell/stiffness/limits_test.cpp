// Limits on what lives and on what is born in a frame, and hits that wait while every task is taken.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "components/state.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

Settings settings_of(uint32_t fragments, uint32_t births) {
    Settings settings = small_settings();
    settings.debris_share = 0;
    settings.debris_elements = 0;
    settings.limits.fragments = fragments;
    settings.limits.births_a_frame = births;
    return settings;
}

/// What one frame gave: births, and the limits that refused some.
struct FrameTold {
    uint32_t born = 0;
    std::vector<std::string> refused;
    uint64_t hash = 0;
    bool operator==(const FrameTold&) const = default;
};
std::vector<FrameTold> told(World& world, uint32_t frames) {
    std::vector<FrameTold> list;
    for (uint32_t f = 0; f < frames; ++f) {
        world.step();
        FrameTold now{world.events().fragments_born.count, {}, world.hash()};
        for (const RefusedEvent& e : world.events().refused) now.refused.emplace_back(e.setting);
        list.push_back(now);
    }
    return list;
}

uint32_t sum_of_births(const std::vector<FrameTold>& list) {
    uint32_t sum = 0;
    for (const FrameTold& frame : list) sum += frame.born;
    return sum;
}

/// The first frame with births.
size_t first_birth(const std::vector<FrameTold>& list) {
    size_t frame = 0;
    while (frame < list.size() && list[frame].born == 0) ++frame;
    return frame;
}

TEST(Limits, BirthsAFrameAreSpreadOverTheNextFramesAndNoneIsLost) {
    constexpr uint32_t kMost = 3;
    Breakage all = vase_and_ball(settings_of(1000, 1000), 12);
    const std::vector<FrameTold> free = told(all.world, 20);
    const size_t first = first_birth(free);
    ASSERT_LT(first, free.size());
    ASSERT_GT(free[first].born, 2 * kMost);
    Breakage few = vase_and_ball(settings_of(1000, kMost), 12);
    expect_valid_after_each_system(few.world);
    const double mass = matter_of(few.world).mass;
    const std::vector<FrameTold> list = told(few.world, 60);
    ASSERT_EQ(first_birth(list), first);
    EXPECT_EQ(list[first].refused.size(), free[first].born - kMost) << "what is not born asks again";
    EXPECT_EQ(list[first + 1].refused.size(), free[first].born - 2 * kMost);
    for (const FrameTold& frame : list) {
        EXPECT_LE(frame.born, kMost);
        for (const std::string& name : frame.refused) EXPECT_EQ(name, "limits.births_a_frame");
    }
    EXPECT_GE(sum_of_births(list), free[first].born);
    EXPECT_EQ(few.world.report().waiting_bodies, 0u);
    EXPECT_NEAR(matter_of(few.world).mass, mass, 1e-9 * mass);
}

/// J that the pieces have beyond their common velocity, and momentum of all, once nothing waits any more.
std::pair<double, Vec3d> parting(const Settings& settings) {
    Breakage b = vase_and_ball(settings, 12);
    const Matter before = matter_of(b.world);
    uint32_t waiting = 0;
    const uint32_t frames = step_until_born(b.world, 20);
    EXPECT_GT(frames, 0u);
    for (uint32_t frame = 0; frame < 40; ++frame) {
        waiting += b.world.report().waiting_bodies;
        b.world.step();
        EXPECT_EQ(b.world.events().faults.count, 0u);
    }
    EXPECT_EQ(b.world.report().waiting_bodies, 0u);
    EXPECT_EQ(waiting > 0, settings.limits.births_a_frame < 100);
    const Matter after = matter_of(b.world);
    EXPECT_LE(after.kinetic_energy, (1 + 1e-6) * before.kinetic_energy);
    double energy = 0, mass = 0;
    Vec3d momentum;
    const Bodies& bodies = state_of(b.world).bodies;
    for (const BodyId id : shells_of(b.world)) {
        const Row<Bodies> row(id.index);
        const Vec3d v(bodies.velocity[row]);
        mass += bodies.mass[row];
        momentum += bodies.mass[row] * v;
        energy += 0.5 * bodies.mass[row] * dot(v, v);
    }
    return {energy - dot(momentum, momentum) / (2 * mass), {after.momentum[0], after.momentum[1], after.momentum[2]}};
}

TEST(Limits, PiecesThatWaitForRoomLeaveWithTheirOwnMotion) {
    const auto [free, momentum] = parting(settings_of(1000, 1000));
    ASSERT_GT(free, 0);
    for (const uint32_t births : {1u, 2u, 5u}) {
        const auto [late, same] = parting(settings_of(1000, births));
        EXPECT_GT(late, 0.55 * free) << births;  // what still waits is in the way of what has left
        EXPECT_LT(late, 1.2 * free) << births;
        EXPECT_LT(length(same - momentum), 1e-4 * length(momentum)) << births;
    }
}

TEST(Limits, FragmentsBeyondTheLimitComeOffWhenOldOnesAreRetired) {
    Breakage b = vase_and_ball(settings_of(4, 1000), 12);
    const std::vector<FrameTold> list = told(b.world, 30);
    EXPECT_EQ(b.world.report().fragments, 4u);
    EXPECT_EQ(sum_of_births(list), 4u);
    EXPECT_EQ(b.world.report().waiting_bodies, 1u);
    std::set<std::string> names;
    for (const FrameTold& frame : list) names.insert(frame.refused.begin(), frame.refused.end());
    EXPECT_EQ(names, std::set<std::string>{"limits.fragments"});
    ASSERT_EQ(b.world.retire({.count = 2}).value_or(0), 2u);
    b.world.step();
    EXPECT_EQ(b.world.events().fragments_born.count, 2u);
    EXPECT_EQ(b.world.report().fragments, 4u);
}

TEST(Limits, TheSameIsRefusedOnAnyNumberOfThreads) {
    std::vector<FrameTold> first;
    for (const uint32_t threads : {1u, 2u, 3u, 8u}) {
        Settings settings = settings_of(6, 2);
        settings.threads = threads;
        settings.limits.open_hits = 1;
        settings.units_a_frame = 3'000'000;
        Breakage b = vase_and_ball(settings, 12);
        SpawnSettings vase;
        vase.pose.position = {1, 0, 0};
        (void)b.world.spawn({0, 1}, vase).value();
        (void)b.world.add_sphere(ball_at({1.01f, 0.13f, 0}, 0.3f, 12)).value();
        const std::vector<FrameTold> list = told(b.world, 40);
        EXPECT_EQ(sum_of_births(list), 6u);
        if (first.empty()) first = list;
        EXPECT_EQ(list, first) << threads << " threads";
    }
}

/// Vases in a row, each struck by a ball of its own in the same frame.
World struck_row(Settings settings, uint32_t vases, uint32_t tasks, std::vector<BodyId>& struck) {
    settings.limits.bodies = settings.limits.debris = 8192;
    settings.limits.vertices = 1u << 21, settings.limits.elements = 1u << 22;
    settings.limits.view_vertices = 1u << 24, settings.limits.open_hits = tasks;
    World world = make_world(settings);
    const ModelId model = world.add_model(small_vase()).value();
    for (uint32_t n = 0; n < vases; ++n) {
        SpawnSettings vase;
        vase.pose.position = {static_cast<float>(n), 0, 0};
        struck.push_back(world.spawn(model, vase).value());
        (void)world.add_sphere(ball_at({static_cast<float>(n) + 0.01f, 0.13f, 0}, 0.3f, 8)).value();
    }
    return world;
}

/// Two vases, each struck by a ball of its own in the same frame, which cracks nothing; rows for that many vertices of
/// all shells. A run takes some frames.
World two_struck(uint32_t vertices, std::vector<BodyId>& struck) {
    Settings settings = small_settings();
    settings.limits.vertices = vertices;
    settings.units_a_frame = 2'000'000;
    World world = make_world(settings);
    const ModelId model = world.add_model(small_vase()).value();
    for (uint32_t n = 0; n < 2; ++n) {
        SpawnSettings vase;
        vase.pose.position = {static_cast<float>(n), 0, 0};
        struck.push_back(world.spawn(model, vase).value());
        (void)world.add_sphere(ball_at({static_cast<float>(n) + 0.01f, 0.13f, 0}, 0.3f, 1)).value();
    }
    return world;
}

/// How many of the bodies tell an impact, and whether some limit refused, in so many frames.
std::pair<uint32_t, std::set<std::string>> hit_bodies(World& world, std::span<const BodyId> bodies, uint32_t frames) {
    std::set<uint32_t> hit;
    std::set<std::string> refused;
    for (uint32_t frame = 0; frame < frames; ++frame) {
        world.step();
        EXPECT_EQ(world.events().faults.count, 0u);
        for (const RefusedEvent& e : world.events().refused) refused.insert(e.setting);
        for (const ImpactEvent& e : world.events().impacts)
            for (const BodyId id : bodies)
                if (e.body == id) hit.insert(id.index);
    }
    return {static_cast<uint32_t>(hit.size()), refused};
}

TEST(Limits, AHitThatFindsNoRowsWaitsForThoseOfAnother) {
    std::vector<BodyId> struck;
    World wide = two_struck(1u << 16, struck);
    EXPECT_EQ(hit_bodies(wide, struck, 60), std::pair(2u, std::set<std::string>{}));
    const State& state = state_of(wide);
    const uint32_t own = state.shells.vertices[state.shell_of(state.bodies.structure[struck[0].index])].capacity;
    struck.clear();
    World narrow = two_struck(3 * own + 1100, struck);  // the model's and a copy with room for cracks
    const auto [hit, refused] = hit_bodies(narrow, struck, 60);
    EXPECT_EQ(hit, 2u);
    EXPECT_EQ(refused, std::set<std::string>{"limits.vertices"});
    EXPECT_EQ(narrow.report().waiting_hits, 0u);
}

/// Until its task comes a body stands in whole for its pieces.
TEST(Limits, AHundredHitsOfOneFrameWaitForTasksAndAreWorkedOffInOrder) {
    constexpr uint32_t kTasks = 16;
    const uint32_t vases = few_or_all(100u, 200u);
    std::vector<BodyId> struck, order;
    World world = struck_row(small_settings(), vases, kTasks, struck);
    uint32_t most_waiting = 0;
    uint64_t oldest = 0;
    for (uint32_t frame = 0; frame < 60; ++frame) {
        world.step();
        for (const ImpactEvent& e : world.events().impacts)
            if (std::find(order.begin(), order.end(), e.body) == order.end()) order.push_back(e.body);
        for (const FragmentBornEvent& e : world.events().fragments_born)
            EXPECT_NE(std::find(order.begin(), order.end(), e.parent), order.end()) << frame << ": " << e.parent.index;
        for (const RefusedEvent& e : world.events().refused) ADD_FAILURE() << e.setting;
        most_waiting = std::max(most_waiting, world.report().waiting_hits);
        oldest = std::max(oldest, world.report().oldest_hit_frames);
    }
    EXPECT_EQ(most_waiting, vases - kTasks);
    EXPECT_GE(oldest, 5u);
    EXPECT_EQ(world.report().waiting_hits, 0u);
    std::vector<BodyId> asked;
    for (const BodyId id : order)
        if (std::find(struck.begin(), struck.end(), id) != struck.end()) asked.push_back(id);
    EXPECT_EQ(asked, struck) << "in order of row, every one of them";
    std::set<uint32_t> broken;
    const State& state = state_of(world);
    for (const BodyId id : shells_of(world))
        if (born_of(state.fragment_ages, id.index)) broken.insert(state.bodies.parent[id.index].index);
    for (const BodyId id : struck) EXPECT_TRUE(broken.contains(id.index)) << id.index;
}

/// What the open tasks of one frame were granted, in units, against what they made of it.
struct FrameWork {
    uint64_t granted = 0, done = 0, first_steps = 0;
    bool operator==(const FrameWork&) const = default;
};

/// One step of each open task is granted whatever is left, so that none starves; work beyond that fits.
TEST(Limits, WorkAFrameStaysWithinItsUnitsOnAnyNumberOfThreads) {
    constexpr uint64_t kUnits = 300'000;
    std::vector<FrameTold> first_told;
    std::vector<FrameWork> first_work;
    for (const uint32_t threads : {1u, 2u, 3u, 8u}) {
        Settings settings = small_settings();
        settings.units_a_frame = kUnits;
        settings.threads = threads;
        settings.limits.fragments = 20, settings.limits.births_a_frame = 4;
        std::vector<BodyId> struck;
        World world = struck_row(settings, 12, 5, struck);
        std::vector<FrameWork> work;
        std::vector<uint32_t> steps, units;
        after_each_system(world, [&](const std::string& system) {
            const State& state = state_of(world);
            const Tasks& tasks = state.tasks;
            if (system == "grant_units") {
                steps.clear(), units.clear();
                work.emplace_back();
            }
            if (system != "grant_units" && system != "advance_runs") return;
            for (uint32_t t = 0; t < tasks.size(); ++t) {
                const bool runs = static_cast<TaskState>(tasks.state[t]) == TaskState::Running;
                if (system == "grant_units") {
                    steps.push_back(tasks.steps_done[t]);
                    units.push_back(runs ? static_cast<uint32_t>(units_a_step(state, t)) : 0);
                    work.back().granted += runs ? uint64_t{tasks.steps_granted[t]} * units[t] : 0;
                    work.back().first_steps += units[t];
                } else if (t < units.size()) {
                    work.back().done += uint64_t{tasks.steps_done[t] - steps[t]} * units[t];
                }
            }
        });
        std::vector<FrameTold> list;
        for (uint32_t frame = 0; frame < 40; ++frame) {
            const std::vector<FrameTold> one = told(world, 1);
            list.insert(list.end(), one.begin(), one.end());
            const FrameWork& now = work.back();
            EXPECT_LE(now.granted, std::max(kUnits, now.first_steps)) << frame;
            EXPECT_LE(now.done, now.granted) << frame;
            EXPECT_LE(world.report().units_used, std::max(kUnits, now.first_steps)) << frame;
            EXPECT_GE(world.report().units_used, now.done) << frame;
            EXPECT_EQ(world.report().units_left, kUnits - std::min(kUnits, world.report().units_used)) << frame;
        }
        // Cuts take the rest.
        const auto is_full = [](const FrameWork& w) { return 10 * w.done > 8 * kUnits; };
        EXPECT_GE(std::count_if(work.begin(), work.end(), is_full), 10) << "the limit was reached";
        if (first_work.empty()) first_work = work, first_told = list;
        EXPECT_EQ(work, first_work) << threads << " threads";
        EXPECT_EQ(list, first_told) << threads << " threads";
    }
}

/// Units for steps, and then for births: never both in one frame, whose worst they were.
TEST(Limits, TheLastStepOfAHitWaitsForTheUnitsOfItsBirths) {
    Settings settings = settings_of(1000, 1000);
    settings.units_a_frame = 4'000'000;
    Breakage b = vase_and_ball(settings, 12);
    const State& state = state_of(b.world);
    const Tasks& tasks = state.tasks;
    uint32_t before = 0, done = 0, left = 0, waited = 0;
    uint64_t births = 0, a_step = 0;
    after_each_system(b.world, [&](const std::string& system) {
        if (system != "grant_units" && system != "advance_runs") return;
        for (uint32_t t = 0; t < tasks.size(); ++t) {
            const auto task_state = static_cast<TaskState>(tasks.state[t]);
            if (system == "grant_units" && task_state == TaskState::Running) {
                before = tasks.steps_done[t], left = steps_left(state, t, 0);
                births = units_of_birth(state, t), a_step = units_a_step(state, t);
            } else if (system == "advance_runs" && task_state != TaskState::Free) {
                done = tasks.steps_done[t] - before;
                waited += task_state == TaskState::Running && tasks.crack_count[t] > 0 && steps_left(state, t, 0) <= 1;
            }
        }
    });
    const uint32_t frames = step_until_born(b.world, 60);
    ASSERT_GT(frames, 1u);
    EXPECT_EQ(waited, 1u) << "the frame before had used up its units";
    EXPECT_LE(left, 1u);
    EXPECT_EQ(done, 1u);
    EXPECT_GT(births, 100 * a_step) << "or there were nothing to wait for";
    EXPECT_GE(b.world.report().units_used, births);
}

}  // namespace
}  // namespace cullet::test
