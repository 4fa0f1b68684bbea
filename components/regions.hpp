// What lies round the cut-outs that hidden runs of large bodies work on. It is empty, and out of the hash, until the
// first of them.
#pragma once
#include "components/shells.hpp"

namespace cullet {

/// Row t is the body of task t without what its cut-out moves by itself. It is one rigid body that holds the cut-out's
/// border. Body axes.
struct RegionRests : Table<RegionRests> {
    using Table::Table;
    CULLET_TABLE(region_rests);
    Column<uint32_t> most_vertices{*this, "most_vertices"};  // of the cut-out when it was made; 0: the task has none
    Column<uint8_t> wants_more{*this,
                               "wants_more"};  // cracks or stress came to its border: begins again on a larger one
    Column<double> inverse_mass{*this, "inverse_mass", "1/kg"};  // 0: pins hold it
    Column<Vec3d> centre{*this, "centre", "m"};                  // of its vertices' masses, at rest
    Column<Sym3d> inertia{*this, "inertia", "kg m2"};            // of its vertices' masses about that centre
    Column<Vec3d> body_centre{*this, "body_centre", "m"};        // of all vertices' masses
    Column<Vec3d> velocity{*this, "velocity", "m/s"};
    Column<Vec3d> spin{*this, "spin", "rad/s"};
    Column<Vec3d> travel{*this, "travel", "m"};  // since the touch, of the centre
    Column<Vec3d> turn{*this, "turn", "rad"};    // since the touch: so small that it is a vector
};

}  // namespace cullet
