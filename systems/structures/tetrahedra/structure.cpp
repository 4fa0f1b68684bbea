#include "systems/structures/tetrahedra/structure.hpp"

#include "systems/structures/tetrahedra/draw_solid.hpp"
#include "systems/structures/tetrahedra/skin.hpp"

namespace cullet {
namespace {

Row<Structures> import(RunRows& rows, const RunRows& from, Row<Structures> structure, const char** full) {
    return import_solid(rows, from, structure, full);
}

void release(RunRows& rows, Row<Structures> structure) {
    release_solid(rows, structure);
}

float radius(RunRows& rows, Row<Structures> structure) {
    return radius_of_solid(rows, structure);
}

uint32_t points_at_birth(const RunRows& rows, Row<Structures> structure) {
    return skin_of(rows, structure).points.count;
}

uint32_t view_rows(RunRows& rows, Row<Structures> structure) {
    return view_rows_of_solid(rows, structure);
}

void measure(RunRows& rows, Row<Structures> structure) {
    measure_solid(rows, structure);
}

}  // namespace

const StructureCalls& tetrahedra_calls() {
    static const StructureCalls calls = [] {
        StructureCalls c;
        c.import = import;
        c.release = release;
        c.radius = radius;
        c.points_at_birth = points_at_birth;
        c.view_rows = view_rows;
        c.measure = measure;
        return c;
    }();
    return calls;
}

}  // namespace cullet
