// A shell's cells as the rigid world takes them.
#pragma once
#include "components/body_rows.hpp"
#include "engine/arena.hpp"
#include "engine/rigid_world.hpp"

namespace cullet {

/// The one shape of the shell, named 0, or hulls of all cells that have points, named kMostCellParts * cell + part; the
/// spans live in the arena. With
/// `broken_body`, the one that came apart in this step, Cells.same_cell tells which of its hulls have the same points,
/// and Cells.shape which were made ahead.
std::span<const ConvexPiece> convex_pieces(const ShellRows& state, Row<Shells> shell, Arena& arena,
                                           RigidId broken_body = kNoRigid);
/// The same of what is left of a body in this step, the cells that changed alone; `gone` are the names of the hulls
/// that they may have had.
std::span<const ConvexPiece> changed_pieces(const ShellRows& state, Row<Shells> shell, Arena& arena,
                                            std::span<const uint32_t>& gone);
/// All that the rigid world needs for a body with a shell, from its row.
RigidDescription describe_rigid(const BodyRows& state, Row<Bodies> body, std::span<const ConvexPiece> pieces);
/// Writes mass, centre, inertia and radius of the body's row from its shell.
void take_mass_properties(BodyRows& state, Row<Bodies> body);
/// The same of what is left of a body when pieces came off: no look at its vertices, the radius is an upper bound.
void take_rest_properties(BodyRows& state, Row<Bodies> body);

}  // namespace cullet
