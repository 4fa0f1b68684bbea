// What must be true of every cooked solid: solid cooking note, section 10, T1 to T4.
#pragma once
#include <functional>
#include <ostream>

#include "systems/structures/tetrahedra/cook/cook_solid.hpp"

namespace cullet::test {

struct SolidReport {
    double volume_error = 0, area_error = 0, moment_error = 0;  // over the whole
    uint32_t open_cells = 0;                                    // tetrahedra whose polygons and faces do not close
    uint32_t open_triangles = 0;                                // whose polygons do not leave their sides alone
    uint32_t bad_windings = 0;  // points on the rim that are inside, and 1 for edges that disagree
    uint32_t rim_cells = 0;     // with a point on the rim
    uint32_t bad_rows = 0;      // numbers out of range, order, no area, no unit length
    uint32_t odd_edges = 0;     // of pieces, of all labellings
    double piece_error = 0;     // the largest difference of a piece's volume from its cells', over the whole
    bool is_sound() const;
};
std::ostream& operator<<(std::ostream& out, const SolidReport& report);

/// Cuts again and looks at everything.
SolidReport check_solid(const CookedSolid& cooked, double merge_below = SolidSettings().merge_below);

}  // namespace cullet::test
