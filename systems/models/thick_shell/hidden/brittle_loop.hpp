// The inner loop of a brittle thick shell, on tables alone: a frame's damage tasks and single hits (cooking, truth) run
// the same.
#pragma once
#include "components/blows.hpp"
#include "components/run_rows.hpp"
#include "engine/inner_loop.hpp"

namespace cullet {

struct LoopWorld {
    RunRows& state;
    const Blows& blows;  // a run that begins again is kicked again

    RunRows& tables() const { return state; }
    template <class T>
    auto& table() {
        if constexpr (std::is_same_v<T, Blows>)
            return blows;
        else
            return table_in<T>(state);
    }
    template <class Set>
    Set& set() {
        return state;
    }
    template <class T>
    Row<T> row_of(uint32_t task) const {
        static_assert(std::is_same_v<T, Tasks>);
        return Row<T>(task);
    }
    /// Rows of a table that belong to a task's working shell.
    template <class T>
    Range rows_of(uint32_t task) const {
        const Row<Structures> shell = state.tasks.working[task];
        if constexpr (std::is_same_v<T, Elements>) return state.shells.elements[state.shell_of(shell)];
        if constexpr (std::is_same_v<T, StiffnessPacks>) return state.shells.packs[state.shell_of(shell)];
        if constexpr (std::is_same_v<T, MarkedPacks>)
            return {task * kMostMarkedPacks, state.hidden_runs.pack_count[task], kMostMarkedPacks};
    }
};

using BrittleLoop = InnerLoop<LoopWorld>;
BrittleLoop make_brittle_loop();

/// The task runs and has steps left of those granted.
bool task_goes_on(LoopWorld& world, uint32_t task);

}  // namespace cullet
