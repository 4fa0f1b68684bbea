// The stiffness of a shell follows what cracks do to it.
#pragma once
#include "systems/structures/shell/touched.hpp"

namespace cullet {

/// What the cutter calls while it cuts a thick shell.
extern const CutRepair kStiffnessRepair;

/// Limits the stiffness of what touches the weighed vertices, then rebuilds the rows, and those of each vertex of an
/// element or hinge whose limit changed. Empties the lists. A shell without stiffness (no packs) is left alone. False:
/// the shell has no spare slots left for some row, and must not be stepped on.
bool refresh_stiffness(ShellView shell, Touched& touched);

}  // namespace cullet
