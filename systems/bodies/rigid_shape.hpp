// A structure's cells as the rigid world takes them, whatever kind it is of.
#pragma once
#include "components/body_rows.hpp"
#include "engine/arena.hpp"
#include "engine/rigid_world.hpp"

namespace cullet {

/// The one shape of the structure, named 0, or hulls of all cells that have points, named kMostCellParts * cell + part;
/// the spans live in the arena. With `broken_body`, the one that came apart in this step, Cells.same_cell tells which
/// of its hulls have the same points, and Cells.shape which were made ahead.
std::span<const ConvexPiece> convex_pieces(const StructureRows& state, Row<Structures> structure, Arena& arena,
                                           RigidId broken_body = kNoRigid);
/// The same of what is left of a body in this step, the cells that changed alone; `gone` are the names of the hulls
/// that they may have had.
std::span<const ConvexPiece> changed_pieces(const StructureRows& state, Row<Structures> structure, Arena& arena,
                                            std::span<const uint32_t>& gone);
/// All that the rigid world needs for a body that has a structure, from its row.
RigidDescription describe_rigid(const Bodies& bodies, const Structures& structures, Row<Bodies> body,
                                std::span<const ConvexPiece> pieces);
/// Writes mass, centre and inertia of the body's row from its structure, and how far it reaches from that centre.
void take_mass_properties(Bodies& bodies, const Structures& structures, Row<Bodies> body, float radius);
/// The same of what is left of a body when pieces came off: nobody looks how far it reaches, the radius is an upper
/// bound.
void take_rest_properties(Bodies& bodies, const Structures& structures, Row<Bodies> body);

}  // namespace cullet
