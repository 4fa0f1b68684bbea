#include "tests/models/halves/calls.hpp"

#include "systems/structures/shell/cook/check_shell_rows.hpp"
#include "tests/models/halves/loop.hpp"

namespace cullet::halves {
namespace {

constexpr uint32_t kSpare = 64;  // vertices, and half as many as there are

}  // namespace

Result<ShellRoom> spawn_body(SoftRows& rows, Row<Bodies> body, const Spawning& spawning) {
    if (spawning.settings.pin_count > 0) return Error{"what falls in halves has no pins; spawn it without."};
    rows.bodies.is_breakable[body] = spawning.is_breakable;
    return room_of_hit(rows, body);
}

WorkingCopy take_shell(BodyRows& rows, Row<Bodies> body) {
    WorkingCopy made;
    made.structure = make_shell_unclear(rows, room_of_hit(rows, body), &made.full);
    return made;
}

void begin_run(BodyRows& rows, Row<Tasks> task) {
    rows.hidden_runs.time_step[task] = kStep;
    rows.hidden_runs.end_time[task] = rows.hidden_runs.quiet_time[task] = kEnd;
}

ShellRoom room_of_hit(const BodyRows& rows, Row<Bodies> body) {
    const Shells& shells = rows.shells;
    const Row<Structures> structure = rows.bodies.structure[body];
    const Row<Shells> shell = rows.shell_of(structure);
    const uint32_t vertices = shells.vertices[shell].count,
                   spare = (kSpare + vertices / 2 + kLanes - 1) / kLanes * kLanes;
    ShellRoom room;
    room.vertices = (vertices + kLanes - 1) / kLanes * kLanes + spare;
    room.elements = shells.elements[shell].count + 2 * spare;
    room.hinges = shells.hinges[shell].count + 3 * spare;
    room.cells = rows.structures.cells[structure].count;
    return room;
}

bool may_find_room(const BodyRows& rows, Row<Bodies> body) {
    const ShellRoom room = room_of_hit(rows, body);
    const Row<Structures> own = rows.bodies.structure[body];
    return uint64_t{rows.shells.vertices[rows.shell_of(own)].capacity} + room.vertices <= rows.vertices.limit() &&
           uint64_t{rows.shells.elements[rows.shell_of(own)].capacity} + room.elements <= rows.elements.limit() &&
           uint64_t{rows.shells.hinges[rows.shell_of(own)].capacity} + room.hinges <= rows.hinges.limit();
}

Result<void> check_halves(ShellRows& rows, Row<Structures> structure, Wear wear, const std::string& name,
                          const char* advice) {
    return check_shell_rows(ShellView(rows, structure), wear, name, advice);
}

}  // namespace cullet::halves
