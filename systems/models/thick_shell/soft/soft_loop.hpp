// Runs the springs of all awake bodies through a frame, on all workers.
#pragma once
#include <string>

#include "components/body_rows.hpp"
#include "engine/jobs.hpp"
#include "engine/profiler.hpp"
#include "engine/rigid_world.hpp"
#include "systems/models/thick_shell/springs/spring_loop.hpp"

namespace cullet {

/// A loop's `body` is a row of SoftBodies.
struct SoftWorld {
    SoftRows& state;

    template <class T>
    T& table() {
        return table_in<T>(state);
    }
    template <class Set>
    Set& set() {
        return state;
    }
    Row<ShellSprings> springs_of(uint32_t soft) const;
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
/// With fewer, a substep of 4 microseconds is not worth sharing.
inline constexpr uint32_t kSoftTeamVertices = 256;

struct SoftLoop {
    SoftLoop(JobSystem& jobs, Profiler& profiler);

    /// One frame of every awake body: whom it meets, its substeps, its shape and motion at the end. Bodies of more
    /// than kSoftTeamVertices are shared by all workers, one after another, unless there are as many of them as
    /// workers; the others go one job a body.
    void advance(SoftRows& rows, const RigidWorld& rigid, const Step& step);
    std::string describe() const;

 private:
    JobSystem& jobs_;
    Profiler& profiler_;
    SoftInnerLoop one_layer_, layers_;
    uint32_t zone_;
};

}  // namespace cullet
