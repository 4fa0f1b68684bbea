// The systems of shells, in slots of structures.
#pragma once
#include "components/shell_groups.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// Copies each piece into its rows, marks the old ones dead and chooses what shapes collide (piece_shape.hpp).
/// Meanwhile it settles the pieces' motions (settle_momenta).
void fill_births(Each<Birth> birth, const Events<Break>& breaks, MetalShellRows rows, Fragments& fragments,
                 Touches& touches, const Bodies& bodies);
/// Chooses the hull points of each cell that changed. Finds the faces of its hull, or of a piece's one shape, for the
/// rigid world.
void fill_hulls(Each<HullWanted> wanted, ShellRows& rows, Tables<const MetalOwners, const MetalShells> metal,
                const RigidWorld& rigid);
/// The drawn mesh of each shell that changed. Of what a hit left of a body, only the cells that it changed.
void draw_shells(Each<DrawnChanged> changed, Step step, BodyRows& rows, ViewBoxes& boxes);
/// What the vertices of a large body weigh, block by block, where a hit changed them: the next hit looks no farther.
void measure_blocks(Each<DrawnChanged> changed, const Bodies& bodies, MeasuredBlocks rows);
/// Shells that lost a quarter of their rows to pieces have the live ones moved together: in quiet frames, for units.
void compact_shells(Serial, BodyRows& rows, MetalTables metal, DamageCounts& counts, const Events<TaskEnded>& ended);

}  // namespace cullet
