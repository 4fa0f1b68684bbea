#include "systems/models/lattice/calls.hpp"

#include "systems/models/lattice/break_rooms.hpp"
#include "systems/models/lattice/loop.hpp"
#include "systems/structures/tetrahedra/solid_pieces.hpp"
#include "systems/structures/tetrahedra/solid_rooms.hpp"

namespace cullet::lattice {

Result<ShellRoom> spawn_body(All<LatticeRows, Bodies> rows, Row<Bodies> body, const Spawning& spawning) {
    rows.bodies.is_breakable[body] = spawning.is_breakable;
    const uint32_t pins = spawning.settings.pin_count;
    if (spawning.is_breakable || pins > 0) prepare_rooms(rows, rows.bodies.structure[body]);
    if (pins > 0 && !is_pinned_anywhere(rows, body))
        return Error{"no part of the surface lies in any of the " + std::to_string(pins) +
                     " pin boxes; they are in body coordinates, in metres."};
    return room_of_hit(rows, body);
}

const char* why_not_cut([[maybe_unused]] Read<LatticeRows> rows, Row<Bodies>) {
    return "it is a solid of the model lattice, which is not cut yet; cut one of thick_shell";
}

bool is_full(Tables<const Structures, const Tasks> rows) {
    return taken_rooms(rows) >= kSolidRooms;
}

// It gets its rows when it is known what comes of it.
WorkingCopy take_copy(LatticeRows rows, Row<Bodies> body) {
    WorkingCopy made;
    if (is_full(rows)) {
        made.full = "limits.open_hits";
        return made;
    }
    const Row<Structures> source = rows.bodies.structure[body];
    made.structure = make_solid(rows, rows.solids.cooked[solid_of(rows.structures, source)], {}, &made.full);
    if (made.structure.exists()) copy_structure(rows.structures, source, made.structure);
    return made;
}

void begin_task(LatticeRows rows, Row<Tasks> task) {
    rows.lattice_runs.reach(task + 1);
    rows.lattice_results.reach(task + 1);
    rows.lattice_runs.clear_rows(task, 1);
    rows.lattice_results.clear_rows(task, 1);
    take_room(rows, task);
    rows.hidden_runs.time_step[task] = kStep;
    rows.hidden_runs.end_time[task] = kMostSteps * kStep;
    rows.hidden_runs.quiet_time[task] = 0;
}

// Its rows are not those of a shell.
ShellRoom room_of_hit([[maybe_unused]] Read<LatticeRows> rows, Row<Bodies>) {
    return {};
}

bool may_find_room([[maybe_unused]] Read<LatticeRows> rows, Row<Bodies>) {
    return true;
}

// Its body makes it again, and knows where its pins are.
void restore_run([[maybe_unused]] LatticeRows rows, Row<Tasks>) {}

void restore_body(LatticeRows rows, Row<Bodies> body) {
    const Row<Structures> structure = rows.bodies.structure[body];
    if (rows.bodies.is_breakable[body]) prepare_rooms(rows, structure);
    const Row<Tasks> task(rows.bodies.task[body]);
    if (!task.exists()) return;
    prepare_rooms(rows, rows.tasks.source[task]);
    if (!take_room(rows, task)) return;
    begin_run(rows, task);
    uint64_t units = 0;  // paid already
    for (uint32_t step = 0; step < rows.tasks.steps_done[task]; ++step)
        if (advance_run(rows, task, units)) return;
}

std::string trouble_of_run(Read<LatticeRows> rows, uint32_t task) {
    if (is_shell(rows.structures, rows.tasks.working[task]) || is_shell(rows.structures, rows.tasks.source[task]))
        return "is no solid";
    if (task >= rows.lattice_runs.size() || task >= rows.lattice_results.size()) return "has no blow";
    const Row<Solids> working = solid_of(rows.structures, rows.tasks.working[task]),
                      source = solid_of(rows.structures, rows.tasks.source[task]);
    if (rows.solids.cooked[working] != rows.solids.cooked[source]) return "was cooked of something else";
    return rows.tasks.steps_done[task] <= kMostSteps ? "" : "has more steps than there are";
}

Result<void> check_rows(Read<LatticeRows> rows, uint8_t own, const std::string& name, const char* advice) {
    uint32_t open = 0;
    for (uint32_t t = 0; t < rows.tasks.size(); ++t)
        open += static_cast<TaskState>(rows.tasks.state[t]) != TaskState::Free && model_of(rows, t) == own;
    if (open > kSolidRooms)
        return Error{name + ": " + std::to_string(open) + " solids break at a time, of " + std::to_string(kSolidRooms) +
                     ". " + advice};
    return {};
}

}  // namespace cullet::lattice
