// What births ask of the thick shell (models.hpp).
#pragma once
#include "systems/models.hpp"

namespace cullet {

/// Of a body that was hit on a cut-out, which is back in it.
std::optional<RestMotion> motion_of_rest(const RunRows& state, Row<Tasks> task);

/// The three calls about a soft body that tore; nothing of any other.
void hand_off_torn(const SoftRows& state, const TornPieces& torn, std::span<PartMotion> motions);
void give_torn_pieces(SoftRows& state, const TornPieces& torn);
void keep_torn_body(SoftRows& state, RigidWorld& rigid, Row<Bodies> body);

}  // namespace cullet
