// What the systems of a thick shell that run on all threads are given, and their helpers: each reaches these tables and
// no others.
#pragma once
#include "components/run_rows.hpp"
#include "components/soft.hpp"

namespace cullet {

/// What the stress of elements follows from, and where it is written.
using StressTables = Tables<const Materials, const MaterialTraits, const Structures, const Shells, const Vertices,
                            Elements, const TriangleSprings>;
/// The same of the shell that a task works on.
using TaskStress = All<StressTables, const Tasks>;

/// What moves by a step of springs.
using SteppedTables = Tables<const Structures, const Shells, Vertices, const Elements, const ShellSprings,
                             const ElementSprings, SpringPacks, SpringSlots, LayerSlots, Twins>;
/// The same in the region of a quick run.
using SteppedRegion = All<SteppedTables, const MarkedPacks, const QuickRuns>;

/// Springs that get longer or shorter for good, and the lists in which a step finds them.
using FlowingTables = Tables<const Structures, const Shells, const Vertices, const ShellSprings, Springs, LayerSprings,
                             SpringSlots, LayerSlots, const Twins>;

/// What meets the strikers of a soft body.
using MeetingTables = Tables<const Structures, const Shells, Vertices, const ShellSprings, Twins>;

/// Contact patches of a hidden run, and what they push.
using PatchTables =
    Tables<const Structures, const Shells, Vertices, const Tasks, HiddenRuns, const TaskContacts, PatchVertices>;

/// What they give to both sides; and the rest of the body, where the run works on a part of it.
using PassedTables = Tables<const Structures, const Shells, Vertices, Tasks, const HiddenRuns, TaskContacts,
                            const PatchVertices, const MarkedPacks, const QuickRuns, RegionRests>;

/// Whether the stiffness of a run's working copy is there.
using RunKinds = Tables<const Structures, const Shells, const Tasks, const HiddenRuns, const QuickRuns>;

/// Cracks as they are drawn. Which elements stand in order of cells is remembered with the shell.
using SmoothedTables = Tables<const Structures, Shells, Vertices, const Elements, Cells>;

/// Sheets that bend by their hinges.
using BentTables = Tables<const Materials, const MaterialTraits, const Structures, const Shells, Vertices,
                          const Elements, const ShellSprings, const Springs, const ElementSprings, const Twins>;

/// What vertices weigh, block by block.
using MeasuredBlocks = Tables<const Structures, const Shells, const Vertices, VertexBlocks>;

}  // namespace cullet
