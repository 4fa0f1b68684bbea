// What the model does when bodies are spawned, tasks open, and files are read.
#pragma once
#include "systems/model_calls.hpp"

namespace cullet::lattice {

Result<ShellRoom> spawn_body(All<LatticeRows, Bodies> rows, Row<Bodies> body, const Spawning& spawning);
const char* why_not_cut(Read<LatticeRows> rows, Row<Bodies> body);

/// So many solids break at a time; others wait.
bool is_full(Tables<const Structures, const Tasks> rows);
WorkingCopy take_copy(LatticeRows rows, Row<Bodies> body);
void begin_task(LatticeRows rows, Row<Tasks> task);
ShellRoom room_of_hit(Read<LatticeRows> rows, Row<Bodies> body);
bool may_find_room(Read<LatticeRows> rows, Row<Bodies> body);

void restore_run(LatticeRows rows, Row<Tasks> task);
/// The same steps of its task again.
void restore_body(LatticeRows rows, Row<Bodies> body);
std::string trouble_of_run(Read<LatticeRows> rows, uint32_t task);
Result<void> check_rows(Read<LatticeRows> rows, uint8_t own, const std::string& name, const char* advice);

}  // namespace cullet::lattice
