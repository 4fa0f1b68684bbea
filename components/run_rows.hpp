// What damage runs work on: shells, their tasks and what a run keeps beside them.
#pragma once
#include "components/quick.hpp"
#include "components/regions.hpp"
#include "components/shell_rows.hpp"
#include "components/tasks.hpp"

namespace cullet {

/// The stiffness of a run's shell, as its steps read it.
struct RunStiffness {
    const Tasks& tasks;
    const Shells& shells;
    const StiffnessPacks& packs;
    const StiffnessBlocks& blocks;
    const StiffnessLinks& links;
};

struct RunRows : ShellRows {
    RunRows(const Limits& limits, const MaterialRows& of_what);

    Tasks tasks;
    TaskContacts task_contacts;
    PatchVertices patch_vertices;
    QuickRuns quick_runs;
    AwakePacks awake_packs;
    RegionRests region_rests;

    /// The damage model that works on a task, that of the body that was hit: its place in the world's list.
    uint8_t model_of(uint32_t task) const { return shells.damage_model[tasks.source[task]]; }

    using Below = ShellRows;
    static constexpr auto own_tables() {
        using R = RunRows;
        return std::tuple{&R::tasks,      &R::task_contacts, &R::patch_vertices,
                          &R::quick_runs, &R::awake_packs,   &R::region_rests};
    }
};

}  // namespace cullet
