// What births ask of the thick shell (model_calls.hpp).
#pragma once
#include "systems/model_calls.hpp"

namespace cullet {

/// Of a body that was hit on a cut-out, which is back in it.
RestMotion motion_of_rest(const RunRows& state, Row<Tasks> task);

/// Its springs move it, and not the rigid world.
bool is_awake(const SoftRows& state, Row<Bodies> body);
/// Of an awake body: it is among those that tore.
void look_for_pieces(SoftRows& state, Row<Bodies> body);
/// The lowest soft row that tore since its pieces were looked for, each once.
Row<Bodies> take_torn(SoftRows& state);
/// The three calls about a soft body that tore; nothing of any other.
void hand_off_torn(const SoftRows& state, const Break& torn, Fragments& fragments);
void give_torn_pieces(SoftRows& state, const Break& torn, const Fragments& fragments);
void keep_torn_body(SoftRows& state, RigidWorld& rigid, Row<Bodies> body);

}  // namespace cullet
