// Which part of a body wakes, and that nothing is lost on its border.
#include <gtest/gtest.h>

#include <queue>

#include "components/state.hpp"
#include "engine/fp_mode.hpp"
#include "engine/random.hpp"
#include "sample_game/hit_bench.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/props.hpp"
#include "systems/models/thick_shell/hidden/contact.hpp"
#include "systems/models/thick_shell/quick/costs.hpp"
#include "systems/models/thick_shell/quick/quick_loop.hpp"
#include "systems/models/thick_shell/quick/region_motion.hpp"
#include "systems/structures/shell/ring.hpp"
#include "tests/support/effort.hpp"

namespace cullet {
namespace {

constexpr Row<Tasks> kTask{0};

Model cook_vase(float height) {
    CookSettings settings;
    settings.material = "porcelain", settings.thickness = 0.005f;
    settings.longest_edge = 100;
    settings.thick_shell.measures_threshold = false;
    Result<Model> model = cook(view_of(make_vase(height, 0.0075f)), settings);
    EXPECT_TRUE(model.ok()) << model.error();
    return std::move(model).value();
}

HitDescription quick_blow(const HitBench& bench, uint32_t placement, float speed, const QuickSettings& quick) {
    HitDescription hit = bench.blow(placement, speed);
    hit.quick = &quick;
    return hit;
}

TEST(QuickRegion, AwakeIsWhatLiesWithinTheRingsAndHeldIsTheRingRoundIt) {
    const FpMode mode;
    const Model model = cook_vase(0.3f);
    HitBench bench(Subject::Vase, model);
    QuickSettings quick;
    quick.steps = 30;  // 10 + 3 rings
    State& state = bench.state();
    ASSERT_TRUE(open_hit(state, bench.shell(), quick_blow(bench, 0, 5, quick)));
    const ShellView shell(state, state.tasks.working[kTask]);
    std::vector<std::vector<uint32_t>> beside(shell.vertex_count());
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (const uint32_t a : state.elements.corner[shell.element(e)])
            for (const uint32_t b : state.elements.corner[shell.element(e)])
                if (a != b) beside[a].push_back(b);
    std::vector<uint32_t> ring(shell.vertex_count(), kNone);
    std::queue<uint32_t> queue;
    const uint32_t first = state.task_contacts.first_patch[0];
    for (uint32_t p = first; p < first + state.task_contacts.patch_count[0]; ++p)
        ring[state.patch_vertices.vertex[p]] = 0, queue.push(state.patch_vertices.vertex[p]);
    for (; !queue.empty(); queue.pop())
        for (const uint32_t n : beside[queue.front()])
            if (ring[n] == kNone) ring[n] = ring[queue.front()] + 1, queue.push(n);
    const RegionView region(state, kTask);
    uint32_t awake = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        EXPECT_EQ(region.is_awake(v), ring[v] <= 13) << "vertex " << v << ", ring " << ring[v];
        EXPECT_EQ(region.is_held(v), ring[v] == 14) << "vertex " << v << ", ring " << ring[v];
        awake += ring[v] <= 13;
    }
    EXPECT_EQ(state.quick_runs.awake_count[kTask], awake);
    (void)finish_hit(state);
    close_hit(state);
}

TEST(QuickRegion, TenTimesTheVerticesWakeAtMostAThirdMore) {
    const Model small = cook_vase(0.3f), large = cook_vase(0.3f * std::sqrt(10.0f));
    HitBench few(Subject::Vase, small), many(Subject::Vase, large);
    const QuickSettings quick;
    double worst = 0;
    for (uint32_t placement = 0; placement < 5; ++placement) {
        const uint32_t a = few.run(quick_blow(few, placement, 5, quick)).awake;
        const uint32_t b = many.run(quick_blow(many, placement, 5, quick)).awake;
        std::printf("placement %u: %u of %u vertices awake, %u of %u\n", placement, a, small.report().vertices, b,
                    large.report().vertices);
        worst = std::max(worst, static_cast<double>(b) / a);
    }
    std::printf("awake grows %.2f times with %.1f times the vertices\n", worst,
                static_cast<double>(large.report().vertices) / small.report().vertices);
    EXPECT_GT(large.report().vertices, 8 * small.report().vertices);
    EXPECT_LE(worst, 1.3);
}

/// One run, opened and driven to its end; `f(region)` after each step.
template <class F>
void drive(State& state, F&& f) {
    const BrittleLoop loop = make_quick_loop();
    LoopWorld world{state, state.blows};
    Tasks& tasks = state.tasks;
    while (static_cast<TaskState>(tasks.state[kTask]) == TaskState::Running) {
        tasks.steps_granted[kTask] = 1;
        loop.run_alone(world, {kTask, tasks.steps_done[kTask], 1, task_goes_on});
        f(RegionView(state, kTask));
    }
}

TEST(QuickRegion, WhatTheStrikerGivesTheBodyHasToRounding) {
    const FpMode mode;
    for (const uint32_t layers : {1u, 2u}) {
        const Model model = cook_vase(0.3f);
        HitBench bench(Subject::Vase, model);
        QuickSettings quick;
        quick.layers = layers;
        State& state = bench.state();
        double worst = 0;
        uint32_t broke = 0;
        for (uint32_t placement = 0; placement < 12; ++placement) {
            HitDescription hit = quick_blow(bench, placement, 12, quick);
            hit.spin = {0.5f, -1, 2};
            ASSERT_TRUE(open_hit(state, bench.shell(), hit));
            const ShellView shell(state, state.tasks.working[kTask]);
            drive(state, [](const RegionView&) {});
            const HitReport report = finish_hit(state);
            EXPECT_FALSE(report.dropped) << "placement " << placement;
            broke += report.broke;
            const double mass = state.structures.mass[bench.shell()];
            // The body's own: of the vertices' centre, which is at rest in what moves with it.
            const Vec3d before = mass * Vec3d(hit.velocity), given = report.impulse * Vec3d(hit.normal);
            const double off = length(momentum(shell) - before - given) / (length(given) + 1e-9);
            worst = std::max(worst, off);
            close_hit(state);
        }
        std::printf("%u layers: momentum off by at most %.2e of the blow's, %u of 12 broke\n", layers, worst, broke);
        EXPECT_LT(worst, 2e-4);
    }
}

TEST(QuickRegion, EnergyFallsOrStaysInRandomBlows) {
    const FpMode mode;
    const Random random{31};
    for (const uint32_t layers : {1u, 2u})
        for (const Subject subject : kSubjects) {
            const Result<HitSubject> known = make_subject(subject);
            ASSERT_TRUE(known.ok()) << known.error();
            HitBench bench(subject, known->model);
            QuickSettings quick;
            quick.layers = layers;
            // Its limit as a spawn finds it: without a first-crack speed it is the material's, and no wall breaks.
            bench.break_quickly(quick, static_cast<float>(known->known.first_crack));
            double worst = 0;
            uint32_t broke = 0, dropped = 0;
            const uint32_t blows = test::few_or_all(24u, 60u);
            for (uint32_t i = 0; i < blows; ++i) {
                const auto speed = static_cast<float>(3 + 47 * random.uniform(i, layers));
                State& state = bench.state();
                ASSERT_TRUE(open_hit(state, bench.shell(), bench.blow(500 + i, speed)));
                drive(state, [&](const RegionView& region) {
                    const TaskEnergy energy = region_energy(region);
                    const double wanted = state.hidden_runs.start_energy[kTask] + energy.work;
                    const double scale = std::max(wanted, state.quick_runs.energy_scale[kTask]);
                    worst = std::max(worst, 1 + (energy.total() - wanted) / scale);
                });
                const HitReport report = finish_hit(state);
                broke += report.broke, dropped += report.dropped;
                close_hit(state);
            }
            std::printf("%s, %u layers: %u blows, %u broke, %u dropped, at most %.4f of the energy put in\n",
                        known->name, layers, blows, broke, dropped, worst);
            EXPECT_GE(broke, blows / 4) << known->name;
            EXPECT_EQ(dropped, 0u) << known->name;
            EXPECT_LE(worst, 1.05) << known->name;
        }
}

TEST(QuickRegion, CutsUseUpStepsThatWereGrantedAndTheRunGoesOnAsItWas) {
    const FpMode mode;
    const Model model = cook_vase(0.3f);
    HitBench bench(Subject::Vase, model);
    const QuickSettings quick;
    State& state = bench.state();
    Tasks& tasks = state.tasks;
    const HitDescription hit = quick_blow(bench, 1, 30, quick);
    ASSERT_TRUE(open_hit(state, bench.shell(), hit));
    drive(state, [](const RegionView&) {});
    const HitReport alone = finish_hit(state);
    close_hit(state);
    ASSERT_GT(alone.cuts, 20u);

    constexpr uint32_t kGranted = 40;
    const BrittleLoop loop = make_quick_loop();
    LoopWorld world{state, state.blows};
    ASSERT_TRUE(open_hit(state, bench.shell(), hit));
    uint32_t calls = 0, stopped_by_cuts = 0;
    while (static_cast<TaskState>(tasks.state[kTask]) == TaskState::Running) {
        const uint32_t steps_before = tasks.steps_done[kTask], cuts_before = tasks.crack_count[kTask];
        const uint64_t least_step = quick_units_a_step(state, kTask);
        tasks.units_owed[kTask] = 0;
        tasks.steps_granted[kTask] = kGranted;
        loop.run_alone(world, {kTask, steps_before, kGranted, task_goes_on});
        ++calls;
        const uint32_t steps = tasks.steps_done[kTask] - steps_before;
        const uint64_t cuts = kUnitsQuickCut * (tasks.crack_count[kTask] - cuts_before),
                       most_step = quick_units_a_step(state, kTask);
        EXPECT_GE(steps, 1u) << "none starves";
        if (tasks.units_owed[kTask] > 0) {
            // Used up, and what is owed is what could not be paid: cuts make springs, so a step costs more behind them.
            EXPECT_EQ(tasks.steps_granted[kTask], 0u);
            EXPECT_GE(cuts + steps * most_step + most_step, kGranted * least_step + tasks.units_owed[kTask]);
            EXPECT_LE(cuts + steps * least_step, kGranted * most_step + tasks.units_owed[kTask]);
            stopped_by_cuts += steps < kGranted;
        }
    }
    const HitReport in_parts = finish_hit(state);
    close_hit(state);
    EXPECT_GT(stopped_by_cuts, 0u);
    EXPECT_GT(calls, 2u);
    EXPECT_EQ(in_parts.cuts, alone.cuts);
    EXPECT_EQ(in_parts.parts, alone.parts);
    EXPECT_EQ(in_parts.end_energy, alone.end_energy) << "to the last bit";
}

TEST(QuickRegion, NothingSplitsBelowTheLimitAndARunWithoutOneEnds) {
    const FpMode mode;
    const Model model = cook_vase(0.3f);
    HitBench bench(Subject::Vase, model);
    QuickSettings quick;
    HitDescription hit = quick_blow(bench, 1, 30, quick);
    hit.strength_scale = 1e9f;
    EXPECT_EQ(bench.run(hit).cuts, 0u);
    quick.strain_limit = 1e-5f;
    hit.strength_scale = 1;
    const HitReport report = bench.run(hit);
    EXPECT_GT(report.cuts, 50u);
    EXPECT_EQ(report.steps, quick.steps);
}

}  // namespace
}  // namespace cullet
