// Inner loops as damage models register them: what the budget and the runner know of a loop, whatever its systems are.
#pragma once
#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "components/blows.hpp"
#include "components/world_rows.hpp"
#include "engine/runs.hpp"
#include "systems/narrow_call.hpp"

namespace cullet {

/// What the run of a task costs, in units.
struct RunCost {
    uint64_t step = 0;  // one repetition
    uint64_t end = 0;   // what follows the last one
};

/// What the budget and the runner ask of a loop about a task.
struct TaskCalls {
    bool (*works_on)(const WorldRows& rows, uint32_t task);  // the task is one of this loop's
    /// A pass over its rows is worth a barrier. Null: it never is.
    bool (*may_be_shared)(const WorldRows& rows, uint32_t task) = nullptr;
    /// Its runs have some ten steps: they may wait for the oldest of them, and are granted step by step.
    bool is_brief = false;
};

/// An inner loop that works off tasks.
class TaskLoop {
 public:
    /// A World is made of {rows, blows}. `Cost(rows, task)` is a RunCost.
    template <auto Cost, class World>
    static TaskLoop of(std::string title, InnerLoop<World> loop, const TaskCalls& calls) {
        TaskLoop made(std::move(title), calls);
        made.loop_ = std::make_shared<const InnerLoop<World>>(std::move(loop));
        made.cost_ = [](const WorldRows& rows, uint32_t task) { return Cost(rows, task); };
        made.describe_ = [](const void* own) { return loop_of<World>(own).describe(); };
        made.run_ = [](const void* own, WorldRows& rows, const Blows& blows, const Plan& plan) {
            const Tasks& tasks = rows.tasks;
            const uint32_t t = plan.task;
            return LoopRun(loop_of<World>(own), World{rows, blows},
                           {t, tasks.steps_done[t], tasks.steps_granted[t], goes_on<World>}, plan.units,
                           plan.may_be_shared, plan.zone, left_over<Cost, World>);
        };
        return made;
    }

    const std::string& title() const { return title_; }
    std::string describe() const { return describe_(loop_.get()); }
    bool works_on(const WorldRows& rows, uint32_t task) const { return calls_.works_on(rows, task); }
    bool may_be_shared(const WorldRows& rows, uint32_t task) const {
        return calls_.may_be_shared && calls_.may_be_shared(rows, task);
    }
    bool is_brief() const { return calls_.is_brief; }
    RunCost cost(const WorldRows& rows, uint32_t task) const { return cost_(rows, task); }
    /// The steps that the task was granted. The loop must outlive it.
    LoopRun run(WorldRows& rows, const Blows& blows, uint32_t task, uint32_t zone) const {
        // More is granted than there are steps left: for cuts.
        const uint32_t left = std::max(1u, steps_left(rows, task, 0));
        const uint64_t steps = std::min(rows.tasks.steps_granted[task], left);
        return run_(loop_.get(), rows, blows, {task, zone, steps * cost(rows, task).step, may_be_shared(rows, task)});
    }

 private:
    struct Plan {
        uint32_t task, zone;
        uint64_t units;
        bool may_be_shared;
    };
    TaskLoop(std::string title, const TaskCalls& calls) : title_(std::move(title)), calls_(calls) {}
    template <class World>
    static const InnerLoop<World>& loop_of(const void* own) {
        return *static_cast<const InnerLoop<World>*>(own);
    }
    template <class World>
    static bool goes_on(World& world, uint32_t task) {
        return task_goes_on(world.template table<Tasks>(), task);
    }
    // Granted for cuts that did not come. What a run that has ended brings with it in this frame is paid before.
    template <auto Cost, class World>
    static uint64_t left_over(World& world, uint32_t task) {
        const Tasks& tasks = world.template table<Tasks>();
        const RunCost cost = Cost(world.tables(), task);
        const bool has_ended = static_cast<TaskState>(tasks.state[task]) != TaskState::Running;
        const uint64_t left = tasks.steps_granted[task] * cost.step;
        return left - std::min(left, has_ended ? cost.end : 0);
    }

    std::string title_;
    TaskCalls calls_;
    std::shared_ptr<const void> loop_;
    RunCost (*cost_)(const WorldRows&, uint32_t) = nullptr;
    std::string (*describe_)(const void*) = nullptr;
    LoopRun (*run_)(const void*, WorldRows&, const Blows&, const Plan&) = nullptr;
};

/// What the inner loop of a task may see: all rows, and the game's blows.
struct TaskWorld {
    WorldRows& rows;
    const Blows& blows;

    WorldRows& tables() const { return rows; }
    template <class T>
    auto& table() {
        if constexpr (std::is_same_v<T, Blows>)
            return blows;
        else
            return table_in<T>(rows);
    }
    template <class Set>
    Set& set() {
        return rows;
    }
    template <class T>
    Row<T> row_of(uint32_t task) const {
        return Row<T>(task);
    }
};

/// The run of one row in this frame.
struct FrameRun {
    uint32_t first = 0, repetitions = 0;  // as InnerLoop::Run
    uint64_t units = 0;
    bool may_be_shared = false;
};

/// What the runner asks of a loop about rows that it runs in each frame, without a task.
struct FrameCalls {
    uint32_t (*row_count)(const WorldRows& rows);
    std::optional<FrameRun> (*run_of)(const WorldRows& rows, uint32_t row);  // none: at rest, or another loop's
};

/// An inner loop of what moves on the world's clock.
class FrameLoop {
 public:
    /// A World is made of {rows}.
    template <class World>
    FrameLoop(std::string title, InnerLoop<World> loop, const FrameCalls& calls)
        : title_(std::move(title)),
          calls_(calls),
          loop_(std::make_shared<const InnerLoop<World>>(std::move(loop))),
          describe_([](const void* own) { return static_cast<const InnerLoop<World>*>(own)->describe(); }),
          run_([](const void* own, WorldRows& rows, uint32_t row, const FrameRun& run, uint32_t zone) {
              return LoopRun(*static_cast<const InnerLoop<World>*>(own), World{rows},
                             {row, run.first, run.repetitions, nullptr}, run.units, run.may_be_shared, zone);
          }) {}

    const std::string& title() const { return title_; }
    std::string describe() const { return describe_(loop_.get()); }
    /// Those of this frame. The loop must outlive them.
    void list_runs(WorldRows& rows, uint32_t zone, Runs& runs) const {
        for (uint32_t row = 0; row < calls_.row_count(rows); ++row)
            if (const std::optional<FrameRun> run = calls_.run_of(rows, row))
                runs.add(run_(loop_.get(), rows, row, *run, zone));
    }

 private:
    std::string title_;
    FrameCalls calls_;
    std::shared_ptr<const void> loop_;
    std::string (*describe_)(const void*);
    LoopRun (*run_)(const void*, WorldRows&, uint32_t row, const FrameRun&, uint32_t zone);
};

}  // namespace cullet
