#include "systems/structures/shell/load_calls.hpp"

#include "systems/bodies/held_parts.hpp"
#include "systems/bodies/pin_boxes.hpp"
#include "systems/structures/shell/cut_cost.hpp"
#include "systems/structures/shell/part_by_load.hpp"

namespace cullet {
namespace {

double wall(const BodyRows& rows, Row<Bodies> body) {
    return double{rows.shells.thickness[rows.shell_of(rows.bodies.structure[body])]};
}

// Both sides of the wall.
void reach(const BodyRows& rows, Row<Bodies> body, std::span<const Vec3d> ways, std::span<Reach> along) {
    const Vertices& vertices = rows.vertices;
    const Vec3d centre = rows.bodies.centre[body];
    const auto add = [&](Vec3d corner) {
        for (size_t i = 0; i < ways.size(); ++i) along[i].add(dot(ways[i], corner));
    };
    const Range range = rows.shells.vertices[rows.shell_of(rows.bodies.structure[body])];
    for (uint32_t v = range.first; v < range.first + range.count; ++v) {
        if (vertices.element[v] == kNone) continue;
        const Vec3d outer = Vec3d(vertices.rest[v]) - centre;
        add(outer);
        add(outer + double{vertices.depth[v]} * Vec3d(vertices.inward[v]));
    }
}

// A pinned vertex, and all of the boxes around it: what lies in a wall is held as far as the wall goes.
Held held_by(const BodyRows& rows, Row<Bodies> body, Vec3d axis, uint32_t vertex) {
    const Vec3 at = rows.vertices.rest[vertex];
    Held held{dot(axis, Vec3d(at)), dot(axis, Vec3d(at))};
    const Range boxes = rows.bodies.pins[body];
    for (uint32_t p = boxes.first; p < boxes.first + boxes.count; ++p) {
        if (!is_held(rows.pin_boxes, Range{p, 1, 1}, at)) continue;
        const Held box = held_by_box(rows.pin_boxes, p, axis);
        held = {std::min(held.low, box.low), std::max(held.high, box.high)};
    }
    return held;
}
void add_held(const BodyRows& rows, Row<Bodies> body, Vec3d axis, HeldParts& held) {
    const Range range = rows.shells.vertices[rows.shell_of(rows.bodies.structure[body])];
    for (uint32_t v = range.first; v < range.first + range.count; ++v)
        if (rows.vertices.element[v] != kNone && rows.vertices.is_pinned[v]) held.add(held_by(rows, body, axis, v));
}

uint32_t elements_of_run(const ShellRows& rows, Row<Structures> structure) {
    return rows.shells.elements[rows.shell_of(structure)].count;
}

uint64_t units_of_whole_cut(const ShellRows& rows, Row<Structures> structure, const Blows& blows, uint32_t row) {
    const Row<Shells> shell = rows.shell_of(structure);
    return rows.shells.vertices[shell].count * kUnitsOpen + units_of_cut(rows.shells, shell, blows, row);
}

}  // namespace

void add_load_calls(StructureCalls& calls) {
    calls.bears_loads = true;
    calls.wall = call<wall>;
    calls.reach = call<reach>;
    calls.add_held = call<add_held>;
    calls.elements_of_run = call<elements_of_run>;
    calls.part_by_load = call<part_shell_by_load>;
    calls.units_of_cut = call<units_of_whole_cut>;
}

}  // namespace cullet
