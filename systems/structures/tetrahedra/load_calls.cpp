#include "systems/structures/tetrahedra/load_calls.hpp"

#include <algorithm>

#include "systems/bodies/held_parts.hpp"
#include "systems/structures/tetrahedra/part_by_load.hpp"
#include "systems/structures/tetrahedra/skin.hpp"

namespace cullet {
namespace {

using SolidBodies = Read<All<SolidRows, Bodies, PinBoxes>>;

double wall(SolidBodies rows, Row<Bodies> body) {
    const Row<Structures> structure = rows.bodies.structure[body];
    const double volume = rows.bodies.mass[body] / rows.materials.density[rows.structures.material[structure]];
    return 2 * volume / std::max(double{rows.structures.area[structure]}, 1e-30);
}

void reach(SolidBodies rows, Row<Bodies> body, std::span<const Vec3d> ways, std::span<Reach> along) {
    const Vec3d centre = rows.bodies.centre[body];
    const Range points = skin_of(rows, rows.bodies.structure[body]).points;
    for (uint32_t p = points.first; p < points.first + points.count; ++p) {
        const Vec3d corner = Vec3d(rows.skin_points.place[p]) - centre;
        for (size_t i = 0; i < ways.size(); ++i) along[i].add(dot(ways[i], corner));
    }
}

// As far as the boxes go, wherever its mesh has points.
void add_held(SolidBodies rows, Row<Bodies> body, Vec3d axis, HeldParts& held) {
    const Range boxes = rows.bodies.pins[body];
    for (uint32_t p = boxes.first; p < boxes.first + boxes.count; ++p) held.add(held_by_box(rows.pin_boxes, p, axis));
}

uint32_t elements_of_run(Read<SolidRows> rows, Row<Structures> structure) {
    return rows.structures.live_elements[structure];
}

// It breaks along the cut, which takes a run of its own.
uint64_t no_units([[maybe_unused]] const WorldRows& rows, Row<Structures>, [[maybe_unused]] const Blows& blows,
                  uint32_t) {
    return 0;
}

}  // namespace

void add_solid_load_calls(StructureCalls& calls) {
    calls.bears_loads = calls.is_filled = true;
    calls.wall = call<wall>;
    calls.reach = call<reach>;
    calls.add_held = call<add_held>;
    calls.elements_of_run = call<elements_of_run>;
    calls.part_by_load = call<part_solid_by_load>;
    calls.units_of_cut = no_units;
}

}  // namespace cullet
