// What the model does when bodies are spawned, tasks open, and files are read.
#pragma once
#include "systems/model_calls.hpp"

namespace cullet::lattice {

Result<ShellRoom> spawn_body(SoftRows& rows, Row<Bodies> body, const Spawning& spawning);
const char* why_not_cut(const BodyRows& rows, Row<Bodies> body);

WorkingCopy take_copy(BodyRows& rows, Row<Bodies> body);
void begin_task(BodyRows& rows, Row<Tasks> task);
ShellRoom room_of_hit(const BodyRows& rows, Row<Bodies> body);
bool may_find_room(const BodyRows& rows, Row<Bodies> body);

void restore_run(RunRows& rows, Row<Tasks> task);
/// The same steps of its task again.
void restore_body(BodyRows& rows, Row<Bodies> body);
std::string trouble_of_run(const RunRows& rows, uint32_t task);
Result<void> check_rows(const SoftRows& rows, uint8_t own, const std::string& name, const char* advice);

}  // namespace cullet::lattice
