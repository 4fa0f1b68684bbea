// What the spawning of bodies asks of the thick shell (model_calls.hpp).
#pragma once
#include "systems/model_calls.hpp"

namespace cullet {

/// One of its own where it has pins, moves by its springs, or is so large that hits cut out parts of it.
Result<Row<Structures>> spawn_shell(ShellRows& state, Row<Structures> source, const Spawning& spawning);
/// Brittle bodies may break, others get springs.
Result<ShellRoom> spawn_body(SoftRows& state, Row<Bodies> body, const Spawning& spawning);
/// Ductile and elastic bodies have springs, which nothing cuts.
const char* why_not_cut(const BodyRows& state, Row<Bodies> body);

}  // namespace cullet
