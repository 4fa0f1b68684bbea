// The inner loop of a soft body: its springs, and what they meet.
#pragma once
#include "components/body_rows.hpp"
#include "systems/models/thick_shell/springs/spring_loop.hpp"

namespace cullet {

/// A loop's `body` is a row of SoftBodies.
struct SoftWorld {
    SoftRows& state;

    template <class T>
    auto& table() {
        return table_in<T>(state);
    }
    template <class Set>
    Set& set() {
        return state;
    }
    Row<ShellSprings> springs_of(uint32_t soft) const;
    template <class T>
    Row<T> row_of(uint32_t soft) const {
        if constexpr (std::is_same_v<T, ShellSprings>)
            return springs_of(soft);
        else
            return Row<SoftBodies>(soft);
    }
    template <class T>
    Range rows_of(uint32_t soft) const {
        const Row<ShellSprings> row = springs_of(soft);
        if constexpr (std::is_same_v<T, SpringPacks>) return SpringWorld{state}.rows_of<SpringPacks>(row);
        if constexpr (std::is_same_v<T, Springs>) return state.shell_springs.springs[row];
    }
};

using SoftInnerLoop = InnerLoop<SoftWorld>;
/// A substep: the springs' own, then contacts; each fourth time plastic flow and tears, and the bending of sheets.
SoftInnerLoop make_soft_loop(SpringLayout layout);
inline constexpr uint32_t kSubstepsAFlow = 4;
/// With fewer vertices a substep of 4 microseconds is not worth sharing.
inline constexpr uint32_t kSoftTeamVertices = 256;

}  // namespace cullet
