#include <algorithm>
#include <span>

#include "systems/models.hpp"
#include "systems/systems.hpp"
#include "systems/tasks/birth_cost.hpp"

namespace cullet {
namespace {

constexpr uint32_t kStepsARound = 16;

struct Cost {
    int64_t step, end;  // end: what the last step brings with it
};

/// The frame's work on open tasks, whatever models work on them.
struct Granting {
    WorldRows& rows;
    const DamageModels& models;
    int64_t units_a_frame;

    const TaskLoop& loop_of(uint32_t t) const { return models.loop_of(rows, t); }
    Cost cost_of(uint32_t t) const {
        const RunCost cost = loop_of(t).cost(rows, t);
        return {static_cast<int64_t>(cost.step), static_cast<int64_t>(cost.end)};
    }
    /// What one worker has to do alone is at most half of a frame's units: the other has nothing to do meanwhile.
    int64_t most_units(uint32_t t) const {
        return loop_of(t).may_be_shared(rows, t) ? units_a_frame : units_a_frame / 2;
    }
};

/// As many of `most` as `budget` is enough for; `is_last`: the last of them ends the run.
uint32_t affordable(int64_t budget, const Cost& cost, uint32_t most, bool is_last) {
    const auto steps = static_cast<uint32_t>(std::min<int64_t>(most, std::max<int64_t>(budget, 0) / cost.step));
    const bool is_dear = is_last && steps == most && steps > 0 && budget < steps * cost.step + cost.end;
    return steps - is_dear;
}

/// The step that each task gets first: the oldest hits first, and of brief runs only the oldest where units are used up
/// by then. One that ends a run, with births, waits for units unless it is the oldest of all: two hand-offs in one
/// frame were its worst.
uint32_t first_step(const Granting& g, uint32_t t, const Cost& cost, int64_t budget, bool is_oldest,
                    bool is_first_brief) {
    if (is_oldest) return 1;
    if (cost.end > 0 && steps_left(g.rows, t) <= 1) return budget >= cost.step + cost.end;
    return !g.loop_of(t).is_brief() || is_first_brief || budget > 0;
}

/// What was owed is paid first, but for the units of the step that each task gets whatever is left, and of the end of
/// the oldest.
void pay_owed(const Granting& g, std::span<const uint32_t> order, int64_t& budget) {
    Tasks& tasks = g.rows.tasks;
    int64_t kept = 0;
    for (const uint32_t t : order) {
        const Cost cost = g.cost_of(t);
        kept += cost.step + (t == order[0] && steps_left(g.rows, t) <= 1 ? cost.end : 0);
    }
    for (const uint32_t t : order) {
        const auto owed = static_cast<int64_t>(tasks.units_owed[t]);
        const int64_t paid = std::min(owed, std::max<int64_t>(budget - kept, 0));
        tasks.units_owed[t] -= static_cast<uint64_t>(paid);
        budget -= paid;
    }
}

/// Foreseen, run to its end before, and touched in this frame: what its cracks part is born whatever is left.
bool is_due(const Tasks& tasks, uint32_t t) {
    return static_cast<TaskState>(tasks.state[t]) == TaskState::Whole && !is_ahead(tasks, t) &&
           tasks.steps_done[t] > 0 && tasks.crack_count[t] > 0;
}

uint32_t points_of(const WorldRows& rows, uint32_t t) {
    const Row<Structures> working = rows.tasks.working[t];
    return calls_of(rows.structures, working).points_at_birth(rows, working);
}

/// At most half of what is left, so that other hits go on.
int64_t units_of_due_birth(const WorldRows& state, uint32_t t, int64_t budget) {
    return std::min(static_cast<int64_t>(units_of_birth(state.tasks, t, points_of(state, t))),
                    std::max<int64_t>(budget, 0) / 2);
}

/// Longer runs that so small a share of the frame's units ends, births and all, are not cut into rounds: shards and
/// garden walls do not wait for houses. As much as for their steps is for their cuts.
constexpr int64_t kSmallShare = 16;
void grant_small(const Granting& g, std::span<const uint32_t> order, int64_t& budget) {
    Tasks& tasks = g.rows.tasks;
    for (const uint32_t t : order) {
        const int64_t step = g.cost_of(t).step;
        const auto births = static_cast<int64_t>(kUnitsBirth * points_of(g.rows, t));
        const int64_t steps = 2 * int64_t{steps_left(g.rows, t)} + births / step, units = steps * step;
        if (g.loop_of(t).is_brief() || units > g.units_a_frame / kSmallShare || units > budget) continue;
        tasks.steps_granted[t] = static_cast<uint32_t>(steps);
        budget -= units;
    }
}

/// What no step wants is for what cracks cost, in equal shares, counted in steps: the loop takes them back. `ends` are
/// paid already.
void grant_cuts(const Granting& g, std::span<const uint32_t> order, std::span<const int64_t> ends, int64_t& budget) {
    Tasks& tasks = g.rows.tasks;
    const auto is_cutting = [&](uint32_t t) { return tasks.steps_granted[t] > 0; };
    auto sharers = std::count_if(order.begin(), order.end(), is_cutting);
    for (size_t i = 0; i < order.size(); ++i) {
        const uint32_t t = order[i];
        if (!is_cutting(t)) continue;
        const Cost cost = g.cost_of(t);
        const int64_t room = g.most_units(t) - tasks.steps_granted[t] * cost.step;
        const int64_t share = std::clamp<int64_t>(budget / sharers--, 0, std::max<int64_t>(room, 0));
        tasks.steps_granted[t] += static_cast<uint32_t>(ends[i] / cost.step + share / cost.step);
        budget -= share / cost.step * cost.step;
    }
}

}  // namespace

// A run's last step waits for a frame that has units for what follows it, so that no frame has all of a hit; its cracks
// take from the frame's units while it runs. What they cost more than was granted for is owed, and paid before the next
// frame's steps. Cuts of the game are paid in the frame that makes them, and so are births that are known before the
// pass. A foreseen break beside a full frame of another hit was the worst of scene vase. A task gets at least one step
// a frame, but for brief ones behind the oldest, so that none can starve.
void grant_units(Serial, WorldRows& rows, DamageLedger ledger) {
    static constexpr uint32_t kMostTasks = 1024;
    struct Work {
        uint32_t order[kMostTasks];
        int64_t ends[kMostTasks];  // what was paid for the ends of rows.tasks
    };
    const Scratch<Work> work(rows.scratch);
    auto& [order, ends] = *work;
    uint32_t count = 0;
    const uint64_t for_frame_loops = std::min(ledger.models.units_wanted(rows), ledger.settings.units_a_frame / 2);
    int64_t budget = static_cast<int64_t>(ledger.settings.units_a_frame - for_frame_loops);
    for (uint32_t t = 0; t < rows.tasks.size() && count < kMostTasks; ++t) {
        const auto task_state = static_cast<TaskState>(rows.tasks.state[t]);
        if (task_state == TaskState::Whole) {  // a cut, which is made already
            budget -= static_cast<int64_t>(rows.tasks.units_owed[t]);
            rows.tasks.units_owed[t] = 0;
        }
        if (is_due(rows.tasks, t)) budget -= units_of_due_birth(rows, t, budget);
        if (task_state != TaskState::Running) continue;
        order[count++] = t;
    }
    std::sort(order, order + count, [&](uint32_t a, uint32_t b) {
        if (rows.tasks.opened_frame[a] != rows.tasks.opened_frame[b])
            return rows.tasks.opened_frame[a] < rows.tasks.opened_frame[b];
        return rows.tasks.body[a].index < rows.tasks.body[b].index;
    });
    for (uint32_t i = 0; i < count; ++i) rows.tasks.steps_granted[order[i]] = 0;
    const Granting granting{rows, ledger.models, static_cast<int64_t>(ledger.settings.units_a_frame)};
    pay_owed(granting, {order, count}, budget);
    grant_small(granting, {order, count}, budget);
    std::fill_n(ends, count, int64_t{0});
    bool is_first_round = true, goes_on = count > 0, has_brief = false;
    while (goes_on) {
        goes_on = false;
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t t = order[i];
            const Cost cost = granting.cost_of(t);
            const uint32_t left = steps_left(rows, t), most = std::min(kStepsARound, left);
            // Also where rounding leaves none: the step itself tells that the time is up.
            uint32_t steps = is_first_round ? first_step(granting, t, cost, budget, i == 0, !has_brief) : 0;
            const int64_t own = granting.most_units(t) - rows.tasks.steps_granted[t] * cost.step;
            if (!is_first_round && rows.tasks.steps_granted[t] > 0)
                steps = affordable(std::min(budget, own), cost, most, most == left);
            has_brief = has_brief || granting.loop_of(t).is_brief();
            rows.tasks.steps_granted[t] += steps;
            budget -= steps * cost.step;
            if (steps > 0 && steps >= left) ends[i] = std::clamp<int64_t>(budget, 0, cost.end);
            budget -= steps > 0 && steps >= left ? ends[i] : 0;
            goes_on = goes_on || steps > 0;
        }
        goes_on = goes_on && budget > 0;
        is_first_round = false;
    }
    grant_cuts(granting, {order, count}, {ends, count}, budget);
    const uint64_t frame_budget = for_frame_loops + static_cast<uint64_t>(std::max<int64_t>(budget, 0));
    const uint64_t frame_used = ledger.models.grant_frame(rows, frame_budget, ledger.counts.slow_soft_frames);
    ledger.counts.units_left = frame_budget - std::min(frame_used, frame_budget);
    // More than there were by the first steps, where these alone are too many.
    ledger.counts.units_used =
        static_cast<uint64_t>(static_cast<int64_t>(ledger.settings.units_a_frame - for_frame_loops) - budget) +
        frame_used;
}

}  // namespace cullet
