// The blow of a task, from its contacts.
#pragma once
#include "components/blows.hpp"
#include "components/lattice.hpp"
#include "systems/models/lattice/crack/break_run.hpp"

namespace cullet::lattice {

/// Of the explosion, or else of the contact that brings most, into the task's row of LatticeRuns. False: there is no
/// explosion and no contact closes, and the row has no speed.
bool gather_blow(LatticeRows rows, const Blows& blows, Row<Tasks> task);

/// As the row has it.
SolidBlow blow_of(const LatticeRuns& runs, Row<Tasks> task);

}  // namespace cullet::lattice
