// What the rest of the program asks of metal shells (model_calls.hpp).
#pragma once
#include "systems/model_calls.hpp"

namespace cullet::metal_shell {

/// The cooked shell, which bodies share; with pins, one of the body's own.
Result<Row<Structures>> spawn_shell(MetalShellRows rows, Row<Structures> source, const Spawning& spawning);
Result<ShellRoom> spawn_body(MetalRows rows, Row<Bodies> body, const Spawning& spawning);
/// What presses on it slowly dents it: the task that is opened for it finds this.
bool note_press(MetalRows rows, Row<Bodies> body, const Press& press);
/// m: two walls, folded.
float flat_width(Read<MetalRows> rows, Row<Bodies> body);
const char* why_not_cut(Read<MetalRows> rows, Row<Bodies> body);
/// A new piece was struck by nothing yet.
void inherit_nothing(MetalRows rows, Row<Bodies> parent, Row<Bodies> piece);
/// A copy of the whole.
WorkingCopy take_shell(MetalRows rows, Row<Bodies> body);
void begin_run(MetalRows rows, Row<Tasks> task);
ShellRoom room_of_hit(Read<MetalRows> rows, Row<Bodies> body);
bool may_find_room(Read<MetalRows> rows, Row<Bodies> body);

}  // namespace cullet::metal_shell
