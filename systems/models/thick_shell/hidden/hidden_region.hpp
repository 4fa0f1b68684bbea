// Hidden runs of large bodies work on a cut-out round the hit. The rest of the body is rigid. It moves as one body that
// holds the two outermost rings of the cut-out's vertices, with the mass and inertia of all that does not move by
// itself. So the run keeps momentum as a whole one does.
//
// Nothing is cut near the border. What wants to crack there, or comes to a share of the stress that starts cracks,
// makes the run begin again on a cut-out of twice as many vertices, in the next frame. What would be more than half of
// the body is the whole of it. So a crack goes on as it would have, and what a hit costs goes with its reach. The share
// is a tenth before the first crack, and half after it: blows just hard enough to break a body do so anywhere in it,
// those that are harder break it where they hit.
#pragma once
#include "components/shell_groups.hpp"
#include "engine/events.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// Whether the task is a hidden run on a cut-out.
inline bool is_hidden_region(Tables<const HiddenRuns, const QuickRuns> state, uint32_t task) {
    return is_cut_out(state, task) && !is_quick_task(state, task);
}

/// Rows for a hidden task on a body that may be cut out: of at least `vertices` round its contacts, or of the whole
/// body where that is too wide (kNone: at once). False: no room, and `full` names the limit. Serial; fill_task follows
/// in the same step.
bool give_hidden_rows(RunRows& state, Row<Tasks> task, uint32_t vertices, const char** full);
/// Packs of a hidden task's working copy whose stiffness its body's shell does not have: all of a cut-out, all or none
/// of a copy of the whole.
uint32_t packs_to_assemble(RunKinds state, Row<Tasks> task);
/// A cut-out alone; false: it is too wide, or there is no room.
bool reserve_hidden_region(RunRows& state, Row<Tasks> task, uint32_t vertices, const char** full);

/// After fill_cut_out: which vertices the rest holds, which are too near to it for cracks, and what the rest is.
void find_rest(RunRows& state, Row<Tasks> task);
/// The rest has the body's motion at the touch, and its vertices in the cut-out the rest's.
void start_rest(RunRows& state, Row<Tasks> task);
/// After a step, which moved held vertices as if they were free: what the stiffness gave them goes to the rest, and
/// they go where it goes. `side`: of the probe that the step read.
void move_rest(PassedTables state, Row<Tasks> task, uint32_t side);
/// After the run's first crack: its border takes more stress before the region grows.
void bear_more(RunRows& state, Row<Tasks> task);
/// Kinetic energy of the rest less that of its vertices in the cut-out, which are counted as the cut-out's, J.
double rest_energy(const RunRows& state, Row<Tasks> task);
/// The rest's motion now: of what the cut-out does not have.
BodyMotion rest_motion(Tables<const RegionRests> state, Row<Tasks> task);

/// Whether a vertex of the task's shell is held or too near to what is held for a crack. False of whole bodies.
bool is_by_border(const RunRows& state, Row<Tasks> task, uint32_t vertex);

/// Empty, or what is wrong with the rows of a hidden region that came from a file.
std::string trouble_of_hidden_region(RunRows& state, uint32_t task);

}  // namespace cullet
