#include <x86intrin.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "components/state.hpp"
#include "engine/fp_mode.hpp"
#include "engine/hash.hpp"
#include "engine/jobs.hpp"
#include "perf/cook_vase.hpp"
#include "perf/hidden_yardsticks.hpp"
#include "perf/perf.hpp"
#include "systems/models/thick_shell/hidden/brittle_loop.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/run_hit.hpp"
#include "systems/structures/shell/costs.hpp"
#include "systems/structures/shell/group_fragments.hpp"
#include "systems/structures/shell/make_piece.hpp"
#include "systems/structures/shell/rigid_handoff.hpp"

namespace cullet::perf {
namespace {

constexpr Row<Tasks> kTask{0};
constexpr uint32_t kSliceSteps = 3, kTeamSliceSteps = 24;
constexpr double kFallSpeed = 5.4;  // m/s, 1.5 m

/// Least time of each of a run's small parts over many equal runs. The run does the same work every time. So the sum of
/// the least is what it takes on a machine that does nothing else, however busy this one is.
class LeastTimes {
 public:
    void begin_run() { at_ = 0, run_ticks_ = 0; }
    template <class Call>
    void part(Call call) {
        const uint64_t start = __rdtsc();
        call();
        const uint64_t ticks = __rdtsc() - start;
        if (at_ == ticks_.size()) ticks_.push_back(ticks);
        ticks_[at_] = std::min(ticks_[at_], ticks);
        run_ticks_ += ticks;
        ++at_;
    }
    double total(double seconds_a_tick) const {
        uint64_t sum = 0;
        for (const uint64_t t : ticks_) sum += t;
        return static_cast<double>(sum) * seconds_a_tick;
    }
    /// Of all parts of this run.
    uint64_t run_ticks() const { return run_ticks_; }

 private:
    std::vector<uint64_t> ticks_;
    uint64_t run_ticks_ = 0;
    size_t at_ = 0;
};

double measure_tick() {
    const uint64_t start = __rdtsc();
    const double waited = seconds([&] {
        const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
        while (std::chrono::steady_clock::now() < until) _mm_pause();
    });
    return waited / static_cast<double>(__rdtsc() - start);
}

/// The vase, and one blow against the floor.
struct Vase : CookedVase {
    explicit Vase(const Model& model)
        : CookedVase(model),
          hit(fall_on_floor(state, shell, normalised(Vec3{0.9f, -1.0f, 0.1f}), static_cast<float>(kFallSpeed))) {}
    HitDescription hit;
};

bool is_running(const State& state) {
    return static_cast<TaskState>(state.tasks.state[kTask]) == TaskState::Running;
}

/// What follows the last step: parts, their motions, a shell for each but the largest.
struct Ending {
    std::vector<FragmentPart> parts{kMostParts};
    Fragments fragments{kMostParts};
    Touches touches{1};
    std::vector<Row<Structures>> shells;
    uint32_t count = 0;

    void group(State& state) { count = group_fragments(ShellView(state, state.tasks.working[kTask]), parts); }
    /// Each part is timed apart.
    template <class Timed>
    void hand_off(State& state, Timed timed) {
        const ShellView shell(state, state.tasks.working[kTask]);
        const HandoffStart start{Vec3d(state.tasks.start_velocity[kTask]), Vec3d(),
                                 shell.structures().centre[shell.structure], kFallSpeed};
        timed([&] { rigid_handoff(shell, start, std::span(parts.data(), count), fragments, touches); });
        // The largest part keeps the working shell.
        uint32_t largest = 0;
        for (uint32_t p = 1; p < count; ++p)
            if (parts[p].element_count > parts[largest].element_count) largest = p;
        for (uint32_t p = 0; p < count; ++p)
            timed([&] {
                if (p != largest && parts[p].element_count >= 6)
                    shells.push_back(make_piece(state, shell.structure, parts[p], 1));
            });
    }
    void release(State& state) {
        for (const Row<Structures> s : shells)
            if (s.exists()) release_shell(state, s);
        shells.clear();
    }
};

/// Of where everything went and what came apart.
uint64_t hash_of(ShellView shell) {
    const Range vertices = shell.vertices(), elements = shell.elements();
    uint64_t hash = 0;
    for (int k = 0; k < 3; ++k)
        hash = hash_bytes(shell.state.vertices.displacement.lane(k) + vertices.first, 4 * vertices.count, hash);
    return hash_bytes(shell.state.elements.part.data() + elements.first, 4 * elements.count, hash);
}

/// One whole hit, opened, run by `advance(first step, steps)` until it is over, ended. Returns the state's hash before
/// the end.
template <class Open, class Advance, class Group, class HandOff>
uint64_t run_whole(Vase& vase, Ending& ending, Open open, Advance advance, Group group, HandOff hand_off) {
    State& state = vase.state;
    open([&] { open_hit(state, vase.shell, vase.hit); });
    while (is_running(state)) advance();
    group([&] { ending.group(state); });
    const uint64_t hash = hash_of(ShellView(state, state.tasks.working[kTask]));
    ending.hand_off(state, hand_off);
    ending.release(state);
    close_hit(state);
    return hash;
}

/// Every system of every repetition timed apart.
struct Systems {
    explicit Systems(const BrittleLoop& l) : loop(l), times(l.systems().size()) {}
    const BrittleLoop& loop;
    std::vector<LeastTimes> times;

    void repetition(LoopWorld& world) {
        const uint32_t r = world.state.tasks.steps_done[kTask];
        for (size_t s = 0; s < loop.systems().size(); ++s) {
            const auto& system = loop.systems()[s];
            if ((r + 1) % system.every != 0) continue;
            times[s].part([&] { run_system(system, world, r); });
        }
    }
    static void run_system(const PlannedSystem<LoopWorld>& system, LoopWorld& world, uint32_t r) {
        const Rows<void> rows = system.kind == CallKind::Rows ? system.rows_of_body(world, kTask) : Rows<void>{0, 1};
        Call<LoopWorld> call{world};
        call.body = kTask;
        call.side = static_cast<int>(r & 1);
        call.first = rows.first;
        call.count = rows.count;
        system.invoke(call);
    }
};

/// The bare kernel on the intact shell, as many steps as the hit made, timed in the same slices.
void run_bare(BareHidden& bare, uint32_t steps, LeastTimes& times) {
    times.begin_run();
    for (uint32_t step = 0; step < steps; step += kSliceSteps)
        times.part([&] {
            for (uint32_t i = step; i < std::min(step + kSliceSteps, steps); ++i)
                bare.run_packs(i & 1, 0, bare.pack_count());
        });
}

struct Measured {
    double open = 0, loop = 0, group = 0, hand_off = 0;  // s
    uint64_t hash = 0;
    std::vector<double> in_bare;  // of each round: the whole hit over the bare steps that ran just before it
    double whole() const { return open + loop + group + hand_off; }
};

/// `yardstick` runs the bare steps and returns their ticks: before each round, so that what the machine does meanwhile
/// is the same for both.
template <class Yardstick>
Measured measure_slices(Vase& vase, const BrittleLoop& loop, JobSystem* team, double tick, uint32_t rounds,
                        Yardstick yardstick) {
    LeastTimes open, steps, group, hand_off;
    Measured result;
    Ending ending;
    State& state = vase.state;
    LoopWorld world{state, state.blows};
    for (uint32_t round = 0; round < rounds; ++round) {
        const uint64_t bare = yardstick();
        for (LeastTimes* t : {&open, &steps, &group, &hand_off}) t->begin_run();
        const auto advance = [&] {
            const uint32_t count = team ? kTeamSliceSteps : kSliceSteps;
            state.tasks.steps_granted[kTask] = count;
            const BrittleLoop::Run run{kTask, state.tasks.steps_done[kTask], count, task_goes_on};
            steps.part([&] {
                if (!team) return loop.run_alone(world, run);
                BrittleLoop::Team shared(loop, world, run, team->worker_count());
                parallel_for(*team, team->worker_count(), [&](uint32_t worker) { shared.work(worker); });
            });
        };
        result.hash = run_whole(
            vase, ending, [&](auto call) { open.part(call); }, advance, [&](auto call) { group.part(call); },
            [&](auto call) { hand_off.part(call); });
        uint64_t whole = 0;
        for (const LeastTimes* t : {&open, &steps, &group, &hand_off}) whole += t->run_ticks();
        if (bare > 0) result.in_bare.push_back(static_cast<double>(whole) / static_cast<double>(bare));
    }
    std::sort(result.in_bare.begin(), result.in_bare.end());
    result.open = open.total(tick), result.loop = steps.total(tick);
    result.group = group.total(tick), result.hand_off = hand_off.total(tick);
    return result;
}

struct Counts {
    uint32_t steps = 0, cuts = 0, parts = 0;
    uint64_t units = 0;                          // that the budget counts for it
    uint32_t slots_before = 0, slots_after = 0;  // blocks and links of stiffness that a step reads
    uint64_t vertex_steps = 0;                   // vertices of the growing shell, summed over the steps
};

uint32_t stiffness_slots(const ShellView& shell) {
    const Range packs = shell.shells().packs[shell.row];
    uint32_t slots = 0;
    for (uint32_t p = packs.first; p < packs.first + packs.count; ++p)
        slots += shell.state.stiffness_packs.block_count[p] + shell.state.stiffness_packs.link_count[p];
    return slots;
}

Counts count_work(Vase& vase, const BrittleLoop& loop) {
    State& state = vase.state;
    open_hit(state, vase.shell, vase.hit);
    const ShellView shell(state, state.tasks.working[kTask]);
    Counts counts;
    counts.slots_before = stiffness_slots(shell);
    LoopWorld world{state, state.blows};
    while (is_running(state)) {
        const uint32_t done = state.tasks.steps_done[kTask], vertices = shell.vertex_count();
        state.tasks.steps_granted[kTask] = kSliceSteps;
        loop.run_alone(world, {kTask, done, kSliceSteps, task_goes_on});
        counts.vertex_steps += uint64_t{vertices} * (state.tasks.steps_done[kTask] - done);
    }
    counts.slots_after = stiffness_slots(shell);
    const HitReport report = finish_hit(state);
    counts.steps = report.steps, counts.cuts = report.cuts, counts.parts = report.parts;
    counts.units = uint64_t{report.steps} * units_a_step(state, kTask) +
                   report.cuts * units_of_crack(state.shells.vertices[state.shell_of(vase.shell)].count, false) +
                   state.shells.vertices[state.shell_of(vase.shell)].count * kUnitsOpen;
    close_hit(state);
    return counts;
}

void measure_vase(const char* name, float edge, const Options& options, uint32_t rounds, Figures& figures) {
    const Result<Model> model = cook_vase(edge);
    if (!model.ok()) {
        std::printf("%s\n", model.error().c_str());
        return;
    }
    const FpMode mode;
    const std::string prefix = std::string(name) + ": ";
    const double tick = measure_tick();
    Vase vase(*model);
    const BrittleLoop loop = make_brittle_loop();
    const Counts counts = count_work(vase, loop);
    const float dt = vase.state.shells.time_step[vase.state.shell_of(vase.shell)];
    BareHidden bare_hidden(ShellView(vase.state, vase.shell), dt, 0.15f * dt);
    LeastTimes bare_times;

    Systems systems(loop);
    Ending ending;
    LoopWorld world{vase.state, vase.state.blows};
    uint64_t hash = 0;
    const auto yardstick = [&] {
        if (BareHidden::is_supported()) run_bare(bare_hidden, counts.steps, bare_times);
        return bare_times.run_ticks();
    };
    for (uint32_t round = 0; round < rounds; ++round) {
        yardstick();
        for (LeastTimes& t : systems.times) t.begin_run();
        const auto plain = [](auto call) { call(); };
        hash = run_whole(
            vase, ending, plain,
            [&] {
                vase.state.tasks.steps_granted[kTask] = 1;
                systems.repetition(world);
            },
            plain, plain);
    }
    const double bare = bare_times.total(tick);
    figures.add(prefix + "vertices", vase.state.shells.vertices[vase.state.shell_of(vase.shell)].count, "");
    figures.add(prefix + "steps", counts.steps, "");
    figures.add(prefix + "cut edges", counts.cuts, "");
    figures.add(prefix + "pieces", counts.parts, "");
    figures.add(prefix + "bare steps", 1e3 * bare, "ms");
    const double intact_steps =
        double{1} * counts.steps * vase.state.shells.vertices[vase.state.shell_of(vase.shell)].count;
    // The bare steps that the hit made are of the shell as it was then, with the vertices that cracks had added.
    const double growth = static_cast<double>(counts.vertex_steps) / intact_steps;
    figures.add(prefix + "mean vertices / intact ones", growth, "x");
    figures.add(prefix + "stiffness slots at the end / intact",
                static_cast<double>(counts.slots_after) / counts.slots_before, "x");
    for (size_t s = 0; s < systems.times.size(); ++s)
        figures.add(prefix + loop.systems()[s].name, 1e3 * systems.times[s].total(tick), "ms");
    bool agrees = true;
    double alone = 0;
    for (const unsigned threads : options.threads) {
        const auto jobs = threads > 1 ? make_jobs(JobBackend::Threads, threads) : nullptr;
        const Measured m = measure_slices(vase, loop, jobs.get(), tick, rounds, yardstick);
        agrees = agrees && m.hash == hash;
        const std::string suffix = ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
        if (threads == 1) {
            alone = m.whole();
            figures.add(prefix + "open", 1e3 * m.open, "ms");
            figures.add(prefix + "group", 1e3 * m.group, "ms");
            figures.add(prefix + "hand off", 1e3 * m.hand_off, "ms");
            figures.add(prefix + "units", 1e-6 * static_cast<double>(counts.units), "M");
            figures.add(prefix + "whole hit / its units", 1e9 * m.whole() / static_cast<double>(counts.units), "ns");
            figures.add(
                prefix + "bare steps / 5 units a vertex",
                1e9 * bare / (5.0 * counts.steps * vase.state.shells.vertices[vase.state.shell_of(vase.shell)].count),
                "ns");
        }
        figures.add(prefix + "whole hit" + suffix, 1e3 * m.whole(), "ms");
        // The middle round: this figure is a ratio of neighbours in time, the rest are sums of least times.
        if (threads == 1 && !m.in_bare.empty()) {
            const double middle = m.in_bare[m.in_bare.size() / 2];
            figures.add(prefix + "whole hit / bare steps of the intact shell" + suffix, middle, "x");
            figures.add(prefix + "whole hit / bare steps" + suffix, middle / growth, "x", 2);
        }
        if (threads > 1 && alone > 0) figures.add(prefix + "speed-up" + suffix, alone / m.whole(), "x");
    }
    std::printf("  %shash %016llx%s\n", prefix.c_str(), static_cast<unsigned long long>(hash),
                agrees ? "" : ", AND OTHERS");
}

}  // namespace

bool measure_hit(const Options& options, Figures& figures) {
    measure_vase("vase of 3,200", 0.0075f, options, options.rounds_of_a_pass(20), figures);
    return true;
}

bool measure_large_hit(const Options& options, Figures& figures) {
    measure_vase("vase of 11,000", 0.00405f, options, options.rounds_of_a_pass(6), figures);
    return true;
}

}  // namespace cullet::perf
