// The inner loop of springs: repeated for one shell that has them (ductile, quick mode).
#pragma once
#include "components/shell_groups.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// One layer in one fused pass. It adds up force, area energy where the row has any, and damping from the length kept
/// in the slot. Then it steps by semi-implicit Euler, and notes each vertex's largest elongation.
void integrate_springs(Rows<SpringPacks> packs, Of<ShellSprings> springs, Turn turn, InChunks<SteppedTables> rows);
/// The same for both layers and what ties them.
void integrate_layers(Rows<SpringPacks> packs, Of<ShellSprings> springs, Turn turn, InChunks<SteppedTables> rows);
/// The sides of the positions change places.
void end_spring_step(Of<ShellSprings> springs, ShellSprings& own);

}  // namespace cullet
