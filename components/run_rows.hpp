// What runs of the thick shell work on: shells, their tasks and what a run keeps beside them.
#pragma once
#include "components/quick.hpp"
#include "components/regions.hpp"
#include "components/shell_rows.hpp"
#include "components/tasks.hpp"

namespace cullet {

/// The stiffness of a run's working copy, and its clock, as its steps read them.
struct RunStiffness {
    const Tasks& tasks;
    const HiddenRuns& runs;
    const Structures& structures;
    const Shells& shells;
    const StiffnessPacks& packs;
    const StiffnessBlocks& blocks;
    const StiffnessLinks& links;
};

/// The damage model that works on a task, that of the body that was hit: its place in the world's list.
inline uint8_t model_of(Tables<const Structures, const Tasks> rows, uint32_t task) {
    return rows.structures.damage_model[rows.tasks.source[task]];
}

struct TablesOfRuns {
    Limits limits;
    Tasks tasks{limits.tasks};
    TaskContacts task_contacts{limits.tasks * kMostContacts};
    PatchVertices patch_vertices{limits.tasks * kMostPatchVertices};
    HiddenRuns hidden_runs{limits.tasks};
    MarkedPacks marked_packs{limits.tasks * kMostMarkedPacks};
    QuickRuns quick_runs{limits.tasks};
    RegionRests region_rests{limits.tasks};
};
struct RunRows : ShellRows, TablesOfRuns {
    RunRows(const Limits& l, const MaterialRows& of_what);

    using Below = ShellRows;
    using Own = TablesOfRuns;

    uint8_t model_of(uint32_t task) const { return cullet::model_of(*this, task); }
};

/// Repetitions until the run's time is up, less those done and those that this frame has granted.
inline uint32_t steps_left(const RunRows& rows, uint32_t t, uint32_t granted) {
    const auto total = static_cast<uint32_t>(rows.hidden_runs.end_time[t] / rows.hidden_runs.time_step[t]) + 1;
    const uint32_t begun = rows.tasks.steps_done[t] + granted;
    return total > begun ? total - begun : 0;
}
inline uint32_t steps_left(const RunRows& rows, uint32_t t) {
    return steps_left(rows, t, rows.tasks.steps_granted[t]);
}

}  // namespace cullet
