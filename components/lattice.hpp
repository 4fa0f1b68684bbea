// Runs of the model that breaks solids. A run is given by its blow, its structure and how many steps are done. What it
// works on (BreakRun) stands in rooms of a fixed size beside the tables, in no file and no hash. Where it is missing it
// is made again by the same steps.
#pragma once
#include "components/bodies.hpp"
#include "components/solid_rows.hpp"
#include "components/tasks.hpp"

namespace cullet {

/// Row t is the blow that task t works off, body frame.
struct LatticeRuns : Table<LatticeRuns> {
    using Table::Table;
    CULLET_TABLE(lattice_runs);
    Column<Vec3d> point{*this, "point", "m"};
    Column<Vec3d> push{*this, "push"};                             // unit, into the body
    Column<double> speed{*this, "speed", "m/s"};                   // along the push
    Column<double> effective_mass{*this, "effective_mass", "kg"};  // of both at the point
    Column<double> radius{*this, "radius", "m"};                   // of both surfaces; 1e30: flat on flat
    Column<double> striker_young{*this, "striker_young", "Pa"};
    Column<double> striker_poisson{*this, "striker_poisson"};
    Column<Vec3d> spin{*this, "spin", "rad/s"};  // of the body
    // An explosion in place of it: its reach, 0 without one; what it has at its centre; what it gives the whole body.
    Column<Vec3d> blast_centre{*this, "blast_centre", "m"};
    Column<double> blast_radius{*this, "blast_radius", "m"};
    Column<double> blast_strength{*this, "blast_strength", "Pa s"};
    Column<Vec3d> blast_impulse{*this, "blast_impulse", "N s"};
    Column<uint8_t> is_grounded{*this, "is_grounded"};      // what stands on something is held there
    Column<std::array<double, 4>> ground{*this, "ground"};  // and what lies below this plane, normal and place
};

/// Row t is what task t broke its solid into, once its run is done: until its pieces are born.
struct LatticeResults : Table<LatticeResults> {
    using Table::Table;
    CULLET_TABLE(lattice_results);
    Column<uint32_t> pieces{*this, "pieces"};
    Column<uint32_t> cracks{*this, "cracks"};
    Column<double> gate{*this, "gate"};               // stress over strength before any crack; below 1 nothing broke
    Column<double> impulse{*this, "impulse", "N s"};  // that the striker passed on
};

struct TablesOfLattices {
    Limits limits;
    LatticeRuns lattice_runs{limits.tasks};
    LatticeResults lattice_results{limits.tasks};
};

/// A break of a solid: the solid, its working copy, the task, and who struck whom.
using LatticeRows = All<SolidRows, Tasks, HiddenRuns, const TaskContacts, const Bodies, const PinBoxes, LatticeRuns,
                        LatticeResults, ScratchMemory>;

}  // namespace cullet
