// What loading, and the room that hits take, ask of the thick shell (model_calls.hpp).
#pragma once
#include "systems/model_calls.hpp"

namespace cullet {

/// The sums of a brittle body that hits may cut out a part of.
void restore_sums(BodyRows& state, Row<Bodies> body);
/// Of a working copy of the whole body.
ShellRoom room_of_hit(BodyRows& state, Row<Bodies> body);

}  // namespace cullet
