// The blow of a task, from its contacts.
#pragma once
#include "components/blows.hpp"
#include "components/lattice.hpp"
#include "systems/models/lattice/crack/break_run.hpp"

namespace cullet::lattice {

/// Of the explosion, or else of the contact that brings most, into the task's row of LatticeRuns. False: there is no
/// explosion and no contact closes, and the row has no speed. Of a load that nothing bears the row has a push and no
/// speed: the solid is parted along the plane through its point, across the push.
bool gather_blow(LatticeRows rows, const Blows& blows, Row<Tasks> task);
inline bool is_load_that_parts(const LatticeRuns& runs, Row<Tasks> task) {
    const Vec3d push = runs.push[task];
    return !(runs.speed[task] > 0) && dot(push, push) > 0;
}

/// As the row has it.
SolidBlow blow_of(const LatticeRuns& runs, Row<Tasks> task);

}  // namespace cullet::lattice
