#include "systems/models/metal_shell/calls.hpp"

#include <algorithm>

#include "systems/models/metal_shell/cook/metal_rows.hpp"
#include "systems/models/metal_shell/loop.hpp"
#include "systems/structures/shell/cook/apply_pins.hpp"

namespace cullet::metal_shell {
namespace {

/// Rows to spare for what a tear puts on edges and splits: arms of a hole in fine sheets take some hundred.
constexpr uint32_t kLeastSpare = 256, kMostSpare = 2048, kSpringsAVertex = 16;
uint32_t spare_vertices(uint32_t vertices) {
    return (std::clamp(vertices / 8, kLeastSpare, kMostSpare) + kLanes - 1) / kLanes * kLanes;
}

/// With room to tear.
MetalRoom metal_room_of_hit(Read<MetalShellRows> rows, Row<Structures> structure, const ShellRoom& shell) {
    MetalRoom room = metal_room_of(rows, structure);
    room.springs += kSpringsAVertex * spare_vertices(room.vertices);
    room.vertices = shell.vertices, room.elements = shell.elements;
    return room;
}

/// A copy with rows of metal, filled; kNone and the limit's name when there is no room.
Row<Structures> copy_with_metal(MetalShellRows rows, Row<Structures> source, const char** full) {
    ShellRoom room = room_of(rows, source);
    room.blocks = room.links = 0;
    const Row<Structures> copy = copy_shell(rows, source, room, full);
    if (!copy.exists()) return copy;
    if (!make_metal(rows, copy, metal_room_of(rows, source), full).exists()) {
        release_shell(rows, copy);
        return {};
    }
    copy_metal_rows(rows, rows, source, copy);
    return copy;
}

}  // namespace

Result<Row<Structures>> spawn_shell(MetalShellRows rows, Row<Structures> source, const Spawning& spawning) {
    const SpawnSettings& settings = spawning.settings;
    if (settings.pin_count == 0) return source;
    const char* full = "";
    const Row<Structures> copy = copy_with_metal(rows, source, &full);
    if (!copy.exists()) return Error{std::string("no room for a pinned body; raise ") + full + "."};
    uint32_t pinned = 0;
    for (uint32_t i = 0; i < settings.pin_count; ++i)
        pinned += apply_pins(ShellView(rows, copy), settings.pins[i].low, settings.pins[i].high);
    if (pinned == 0) {
        release_metal_shell(rows, copy);
        return Error{"no vertex lies in any of the " + std::to_string(settings.pin_count) +
                     " pin boxes; they are in body coordinates, in metres."};
    }
    measure_pins(rows, copy);
    return copy;
}

Result<ShellRoom> spawn_body(MetalRows rows, Row<Bodies> body, const Spawning& spawning) {
    // What a crash gives back hangs on the metal: what yields is not springy, whatever it meets.
    if (!(spawning.settings.contact.restitution >= 0))
        rows.bodies.restitution[body] =
            rows.shell_rows.materials.restitution[rows.structures.material[rows.bodies.structure[body]]];
    rows.bodies.is_breakable[body] = spawning.is_breakable;
    if (body < rows.metal_impacts.size()) rows.metal_impacts.clear_rows(body, 1);
    if (body < rows.metal_presses.size()) rows.metal_presses.clear_rows(body, 1);
    if (!spawning.is_breakable) return ShellRoom{};
    return room_of_hit(rows, body);
}

bool note_press(MetalRows rows, Row<Bodies> body, const Press& press) {
    MetalPresses& presses = rows.metal_presses;
    presses.reach(body + 1);
    presses.is_on[body] = 1;
    presses.depth[body] = static_cast<float>(press.depth);
    presses.ahead[body] = static_cast<float>(press.ahead);
    presses.force[body] = static_cast<float>(press.force);
    return true;
}

float flat_width(Read<MetalRows> rows, Row<Bodies> body) {
    constexpr float kWalls = 6;
    return kWalls * rows.shell_rows.shells.thickness[rows.shell_rows.shell_of(rows.bodies.structure[body])];
}

const char* why_not_cut(Read<MetalRows> rows, Row<Bodies> body) {
    const bool is_metal = metal_of(rows, rows.bodies.structure[body]).exists();
    return is_metal ? "it is of sheet metal, which dents; cut one of a material that breaks" : nullptr;
}

// Its rows of metal come with those of its shell.
void inherit_nothing(MetalRows rows, Row<Bodies>, Row<Bodies> piece) {
    if (piece < rows.metal_impacts.size()) rows.metal_impacts.clear_rows(piece, 1);
    if (piece < rows.metal_presses.size()) rows.metal_presses.clear_rows(piece, 1);
}

WorkingCopy take_shell(MetalRows rows, Row<Bodies> body) {
    WorkingCopy made;
    const Row<Structures> source = rows.bodies.structure[body];
    const ShellRoom room = room_of_hit(rows, body);
    made.structure = make_shell_unclear(rows, room, &made.full);
    if (!made.structure.exists()) return made;
    if (make_metal(rows, made.structure, metal_room_of_hit(rows, source, room), &made.full).exists()) return made;
    release_shell(rows, made.structure);
    made.structure = {};
    return made;
}

void begin_run(MetalRows rows, Row<Tasks> task) {
    rows.metal_runs.reach(task + 1);
    rows.striker_fronts.reach((task + 1) * kFrontRows);
    rows.metal_runs.clear_rows(task, 1);
    rows.hidden_runs.time_step[task] = kStep;
    rows.hidden_runs.end_time[task] = rows.hidden_runs.quiet_time[task] = 0;
}

ShellRoom room_of_hit(Read<MetalRows> rows, Row<Bodies> body) {
    const Row<Structures> structure = rows.bodies.structure[body];
    const uint32_t vertices = rows.shell_rows.shells.vertices[rows.shell_rows.shell_of(structure)].count,
                   spare = spare_vertices(vertices);
    ShellRoom room = room_of(rows, structure);
    room.vertices = (vertices + kLanes - 1) / kLanes * kLanes + spare;
    room.elements += 2 * spare, room.hinges += 3 * spare;
    room.blocks = room.links = room.points = 0;
    return room;
}

bool may_find_room(Read<MetalRows> rows, Row<Bodies> body) {
    const ShellRoom room = room_of_hit(rows, body);
    const Row<Shells> own = rows.shell_rows.shell_of(rows.bodies.structure[body]);
    return uint64_t{rows.shell_rows.shells.vertices[own].capacity} + room.vertices <=
               rows.shell_rows.vertices.limit() &&
           uint64_t{rows.shell_rows.shells.elements[own].capacity} + room.elements <=
               rows.shell_rows.elements.limit() &&
           uint64_t{rows.shell_rows.shells.hinges[own].capacity} + room.hinges <= rows.shell_rows.hinges.limit();
}

}  // namespace cullet::metal_shell
