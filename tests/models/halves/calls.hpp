// What the rest of the program asks of it (model_calls.hpp).
#pragma once
#include "systems/model_calls.hpp"

namespace cullet::halves {

Result<ShellRoom> spawn_body(SoftRows& rows, Row<Bodies> body, const Spawning& spawning);
/// A copy of the whole, with room for what the cut adds.
WorkingCopy take_shell(BodyRows& rows, Row<Bodies> body);
void begin_run(BodyRows& rows, Row<Tasks> task);
ShellRoom room_of_hit(const BodyRows& rows, Row<Bodies> body);
bool may_find_room(const BodyRows& rows, Row<Bodies> body);
Result<void> check_halves(ShellRows& rows, Row<Structures> structure, Wear wear, const std::string& name,
                          const char* advice);

}  // namespace cullet::halves
