// The quick mode at its bounds. Without a limit nothing splits. With none to bear each interior edge of a uniform
// stretch can. The run still ends, its energy no larger than what was put in, with no more splits a step than it may
// make.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>

#include "components/state.hpp"
#include "engine/fp_mode.hpp"
#include "sample_game/hit_bench.hpp"
#include "sample_game/props.hpp"
#include "systems/models/thick_shell/hidden/brittle_loop.hpp"
#include "systems/models/thick_shell/quick/quick_loop.hpp"
#include "systems/models/thick_shell/quick/region_motion.hpp"
#include "systems/models/thick_shell/quick/strained_edges.hpp"
#include "systems/models/thick_shell/springs/start_springs.hpp"
#include "tests/support/expect_always.hpp"
#include "tests/support/real_meshes.hpp"

namespace cullet {
namespace {

constexpr Row<Tasks> kTask{0};
constexpr float kBoundless = 1e9f, kNothing = 1e-9f;  // limits of the strain

/// All that moves at places (1 + strain) times those at rest, which is what the run starts with.
void stretch(const RegionView& region, float strain) {
    RunRows& state = region.state;
    const SpringView& view = region.springs;
    region.for_each([&](uint32_t v, bool is_held) {
        if (is_held) return;
        view.place(v, (1 + strain) * view.position(v));
        if (view.has_layers()) view.place_twin(v, (1 + strain) * view.twin_position(v));
    });
    state.hidden_runs.start_energy[kTask] += region_energy(region).total();
    state.quick_runs.energy_scale[kTask] += region_energy(region).total();
}

/// Edges of two elements whose ends both move: of the ring that is held only what springs give it is known.
uint32_t interior_springs(const RegionView& region) {
    const ShellView& shell = region.shell;
    uint32_t count = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t row = shell.element(e), n = region.state.elements.neighbour[row][k];
            if (n == kNone || n < e) continue;
            const uint32_t a = region.state.elements.corner[row][k], b = region.state.elements.corner[row][(k + 1) % 3];
            count += region.is_awake(a) && region.is_awake(b);
        }
    return count;
}

uint32_t strained_interior_edges(const RegionView& region) {
    auto found = std::make_unique<StrainedEdges>();
    find_strained_edges(region, StrainedEdges::kMost, *found);
    const ShellView& shell = region.shell;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> sides;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            const auto& corner = region.state.elements.corner[shell.element(e)];
            ++sides[std::minmax(corner[k], corner[(k + 1) % 3])];
        }
    uint32_t count = 0;
    for (uint32_t i = 0; i < found->count; ++i) {
        const auto& edge = found->edge[i];
        count += sides[{edge.low, edge.high}] == 2 && region.is_awake(edge.low) && region.is_awake(edge.high);
    }
    return count;
}

struct Outcome {
    uint32_t steps = 0, splits = 0, most_in_a_step = 0;
    bool has_ended = false, is_dropped = false;
};

/// Cut edges are counted: a split that does not run on has at most two.
Outcome run_to_its_end(State& state) {
    const BrittleLoop loop = make_quick_loop();
    LoopWorld world{state, state.blows};
    Outcome run;
    const uint32_t most = 4u * state.quick_runs.steps[kTask];
    while (run.steps < most && static_cast<TaskState>(state.tasks.state[kTask]) == TaskState::Running) {
        const uint32_t before = state.tasks.crack_count[kTask];
        state.tasks.steps_granted[kTask] = 1;
        loop.run_alone(world, {kTask, state.tasks.steps_done[kTask], 1, task_goes_on});
        run.most_in_a_step = std::max(run.most_in_a_step, state.tasks.crack_count[kTask] - before);
        ++run.steps;
    }
    run.splits = state.tasks.crack_count[kTask];
    run.has_ended = static_cast<TaskState>(state.tasks.state[kTask]) != TaskState::Running;
    run.is_dropped = static_cast<TaskState>(state.tasks.state[kTask]) == TaskState::Dropped;
    return run;
}

/// A blow on a porcelain vase whose cracks do not run on, and a region that is stretched besides.
struct StretchedHit {
    HitBench& bench;
    QuickSettings quick;

    Outcome run(uint32_t placement, float strain, float limit) {
        HitDescription hit = bench.blow(placement, 5);
        quick.strain_limit = limit;
        hit.quick = &quick;
        RC_ASSERT(open_hit(bench.state(), bench.shell(), hit));
        stretch(RegionView(bench.state(), kTask), strain);
        const Outcome done = run_to_its_end(bench.state());
        (void)finish_hit(bench.state());
        close_hit(bench.state());
        return done;
    }
};

Model cook_vase() {
    Result<HitSubject> vase = make_subject(Subject::Vase);
    EXPECT_TRUE(vase.ok()) << vase.error();
    return std::move(vase->model);
}

/// A mesh of the data folder as porcelain, 0.4 m large.
Model cook_real(const char* name) {
    Mesh mesh = test::read_real_mesh(name);
    Vec3 low = mesh.positions.at(0), high = low;
    for (const Vec3 p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    for (Vec3& p : mesh.positions) p = (0.4f / length(high - low)) * (p - low);
    CookSettings settings;
    settings.thickness = 0.006f;
    settings.thick_shell.measures_threshold = false;
    Result<Model> model = cook(view_of(mesh), settings);
    EXPECT_TRUE(model.ok()) << model.error();
    return std::move(model).value();
}

/// Blows anywhere on the body, as a vase's: a fall on a floor, any side down.
void expect_splits_by_the_limit_alone(const Model& model, int cases) {
    HitBench bench(Subject::Vase, model);
    uint32_t splits = 0, dropped = 0;
    test::expect_always(cases, [&](uint16_t placement, uint8_t share, bool two_layers) {
        StretchedHit hit{bench, {}};
        hit.quick.layers = two_layers ? 2 : 1;
        hit.quick.steps = 60;
        hit.quick.crack_frequency = static_cast<uint16_t>(1 + share % 32);
        hit.quick.crack_length = 0;
        const float strain = 1e-4f * static_cast<float>(1 + share);
        const Outcome whole = hit.run(placement, strain, kBoundless);
        RC_ASSERT(whole.has_ended && !whole.is_dropped);
        RC_ASSERT(whole.splits == 0u);
        const Outcome broken = hit.run(placement, strain, kNothing);
        RC_ASSERT(broken.has_ended);
        dropped += broken.is_dropped;
        if (broken.is_dropped) return;
        RC_ASSERT(broken.splits > 0u);
        RC_ASSERT(broken.most_in_a_step <= 2u * hit.quick.crack_frequency);
        splits += broken.splits;
    });
    std::printf("%u cut edges in %d runs, %u dropped for their energy\n", splits, cases, dropped);
    EXPECT_EQ(dropped, 0u);
}

/// One step of a region that is stretched when its run starts, without a limit: its springs know their strains then.
bool step_stretched(HitBench& bench, uint32_t placement, float strain) {
    QuickSettings quick;
    quick.steps = 6;  // a region of some hundred edges: as many as one look may find
    quick.strain_limit = kBoundless;
    HitDescription hit = bench.blow(placement, 5);
    hit.quick = &quick;
    State& state = bench.state();
    if (!open_hit(state, bench.shell(), hit)) return false;
    stretch(RegionView(state, kTask), strain);
    const BrittleLoop loop = make_quick_loop();
    LoopWorld world{state, state.blows};
    state.tasks.steps_granted[kTask] = 1;
    loop.run_alone(world, {kTask, 0, 1, task_goes_on});
    return true;
}

void expect_each_interior_edge_can_split(const Model& model, int cases) {
    HitBench bench(Subject::Vase, model);
    test::expect_always(cases, [&](uint16_t placement, uint8_t share) {
        State& state = bench.state();
        RC_ASSERT(step_stretched(bench, placement, 1e-3f * static_cast<float>(1 + share)));
        const RegionView region(state, kTask);
        state.quick_runs.split_strain[kTask] = kNothing;
        RC_ASSERT(interior_springs(region) > 50u);
        RC_ASSERT(strained_interior_edges(region) == interior_springs(region));
        (void)finish_hit(state);
        close_hit(state);
    });
}

// Damping takes from it, and nothing gives: not even for a step, as it looks of lengths of the same time alone.
void expect_kept_energy_never_rises(const Model& model, int cases) {
    HitBench bench(Subject::Vase, model);
    test::expect_always(cases, [&](uint16_t placement, uint8_t share) {
        State& state = bench.state();
        RC_ASSERT(step_stretched(bench, placement, 1e-3f * static_cast<float>(1 + share)));
        const RegionView region(state, kTask);
        const auto kept = [&] {
            const TaskEnergy energy = region_energy(region);
            return energy.total() - energy.work - energy.membrane + kept_spring_energy(region.springs);
        };
        const BrittleLoop loop = make_quick_loop();
        LoopWorld world{state, state.blows};
        const double start = kept();
        double most = start;
        for (uint32_t step = 1; step < 6; ++step) {
            state.tasks.steps_granted[kTask] = 1;
            loop.run_alone(world, {kTask, step, 1, task_goes_on});
            most = std::max(most, kept());
        }
        const double scale = std::max(start, state.quick_runs.energy_scale[kTask]);
        (void)finish_hit(state);
        close_hit(state);
        RC_ASSERT(most <= start + 0.005 * scale);
    });
}

TEST(RegionProperties, TheEnergyThatStepsKeepDoesNotRise) {
    const FpMode mode;
    expect_kept_energy_never_rises(cook_vase(), 40);
}

TEST(RegionProperties, WithoutALimitNothingSplitsAndWithNoneToBearTheRunEndsWithinItsSplits) {
    const FpMode mode;
    expect_splits_by_the_limit_alone(cook_vase(), 40);
}

// A region squeezed by 2 %: at a strain limit of 1 % none of its edges is too long; those shorter than the compression
// limit times that may split, and no others.
TEST(RegionProperties, WhatIsSqueezedSplitsAtTheCompressionLimit) {
    const FpMode mode;
    const Model model = cook_vase();
    HitBench bench(Subject::Vase, model);
    State& state = bench.state();
    ASSERT_TRUE(step_stretched(bench, 3, -0.02f));
    const RegionView region(state, kTask);
    state.quick_runs.split_strain[kTask] = 0.01f;
    const uint32_t all = interior_springs(region);
    uint32_t found[3];
    const float limits[] = {0, 1, 3};  // none, 1 %, 3 %
    for (size_t k = 0; k < 3; ++k) {
        state.quick_runs.compression_limit[kTask] = limits[k];
        found[k] = strained_interior_edges(region);
    }
    EXPECT_EQ(found[0], 0u) << "of " << all;
    EXPECT_GT(found[1], all / 2) << "of " << all;
    EXPECT_EQ(found[2], 0u) << "of " << all;
    (void)finish_hit(state);
    close_hit(state);
}

TEST(RegionProperties, EachInteriorEdgeOfAUniformStretchCanSplit) {
    const FpMode mode;
    expect_each_interior_edge_can_split(cook_vase(), 20);
}

TEST(RegionProperties, HoldOnRealMeshes) {
    CULLET_SKIP_WITHOUT_DATA();
    const FpMode mode;
    for (const char* name : {"thick_shell/husky.glb", "thick_shell/vase.glb", "thick_shell/spot_control_mesh.obj",
                             "thick_shell/curtains_double.glb"}) {
        SCOPED_TRACE(name);
        const Model model = cook_real(name);
        std::printf("%s: %u vertices; ", name, model.report().vertices);
        expect_splits_by_the_limit_alone(model, 8);
        expect_kept_energy_never_rises(model, 10);
        // Of the curtains' fine mesh a region has more edges than one look finds.
        if (model.report().vertices < 8000) expect_each_interior_edge_can_split(model, 4);
    }
}

}  // namespace
}  // namespace cullet
