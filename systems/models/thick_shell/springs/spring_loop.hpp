// The inner loop of springs: repeated 8 to 32 times a frame for one shell, by one thread or a team.
#pragma once
#include "components/shell_rows.hpp"
#include "engine/inner_loop.hpp"

namespace cullet {

/// A loop's `body` is a row of ShellSprings.
struct SpringWorld {
    ShellRows& state;

    template <class T>
    auto& table() {
        return table_in<T>(state);
    }
    template <class Set>
    Set& set() {
        return state;
    }
    template <class T>
    Row<T> row_of(uint32_t body) const {
        static_assert(std::is_same_v<T, ShellSprings>);
        return Row<T>(body);
    }
    /// Rows of a table that belong to the shell; all packs that hold vertices.
    template <class T>
    Range rows_of(uint32_t body) const {
        static_assert(std::is_same_v<T, SpringPacks>);
        Range packs = state.shell_springs.packs[body];
        const uint32_t vertices = state.shells.vertices[state.shell_of(state.shell_springs.structure[body])].count;
        packs.count = std::min(packs.count, (vertices + kLanes - 1) / kLanes);
        return packs;
    }
};

using SpringLoop = InnerLoop<SpringWorld>;
/// What a substep of these springs is: integrate_springs, or integrate_layers.
SpringLoop make_spring_loop(SpringLayout layout);

/// `steps` substeps of one shell on the calling thread.
void run_springs(ShellRows& state, Row<ShellSprings> row, uint32_t steps);

}  // namespace cullet
