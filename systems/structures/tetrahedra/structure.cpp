#include "systems/structures/tetrahedra/structure.hpp"

#include <algorithm>

#include "systems/structures/tetrahedra/check_solid.hpp"
#include "systems/structures/tetrahedra/draw_solid.hpp"
#include "systems/structures/tetrahedra/fragment_calls.hpp"
#include "systems/structures/tetrahedra/load_calls.hpp"
#include "systems/structures/tetrahedra/skin.hpp"
#include "systems/structures/tetrahedra/surface_calls.hpp"
#include "systems/structures/tetrahedra/systems.hpp"

namespace cullet {
namespace {

Row<Structures> import(WorldRows& rows, const Workbench& from, Row<Structures> structure, const char** full) {
    return import_solid(rows, from, structure, full);
}

void release(WorldRows& rows, Row<Structures> structure) {
    release_solid(rows, structure);
}

float radius(WorldRows& rows, Row<Structures> structure) {
    return radius_of_solid(rows, structure);
}

uint32_t view_rows(WorldRows& rows, Row<Structures> structure) {
    return view_rows_of_solid(rows, structure);
}

void measure(WorldRows& rows, Row<Structures> structure) {
    measure_solid(rows, structure);
}

void empty(WorldRows& rows, Row<Structures> structure) {
    for_each_solid_range(rows, structure, {}, [](Range& range, auto& table, uint32_t, const char*) {
        table.give_back(range);
        range = {};
    });
    rows.solids.is_whole[solid_of(rows.structures, structure)] = 0;
    rows.structures.live_elements[structure] = 0;
    rows.structures.shape_points[structure] = 0;
}

}  // namespace

SlotList tetrahedra_structure() {
    SlotList structure("tetrahedra");
    structure.at(Slot::Fill).then<fill_solids>();
    structure.at(Slot::Draw).then<draw_solids>();
    return structure;
}

const StructureCalls& tetrahedra_calls() {
    static const StructureCalls calls = [] {
        StructureCalls c;
        c.import = import;
        c.release = release;
        c.radius = radius;
        c.points_at_birth = call<points_at_birth>;
        c.view_rows = view_rows;
        c.measure = measure;
        c.empty = empty;
        c.trouble = call<trouble_of_solid>;
        add_solid_surface_calls(c);
        add_solid_fragment_calls(c);
        add_solid_load_calls(c);
        return c;
    }();
    return calls;
}

}  // namespace cullet
