// The published displacement: each sub-shell that is hit moves as a rigid body of its own, all others stay (metal
// shell note, section 6).
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"
#include "systems/models/metal_shell/shared/striker.hpp"

namespace cullet {

/// What a blow on a sub-shell moves it by.
struct CellMove {
    Vec3d way;   // m
    Vec3d turn;  // rad
};
/// tau J / m and tau I^-1 T: the impulse (N s), its moment about the centre (N m s), a time (s).
CellMove move_of_cell(double mass, const Sym3d& inertia, Vec3d impulse, Vec3d moment, double time);

/// Mass, centre and inertia about it, of one sub-shell at the start of the impact.
struct CellMass {
    double mass = 0;
    Vec3d centre;
    Sym3d inertia;
};
CellMass mass_of_cell(const MetalView& metal, uint32_t cell);

struct CellBlow {
    double depth = 0;    // m, that the most moved of them goes
    double reach = 0;    // m, the striker has gone on by: what it covers then is hit; 0: one sub-shell, at the touch
    double impulse = 0;  // N s
    double time = 0;     // tau, s; 0: such that the most moved goes by `depth`
    bool is_by_mass = true;    // false: all go by `depth`, none turns
    bool is_by_lowest = true;  // a vertex between sub-shells goes with the lowest that is hit; false: by its weights
};
/// Fills MetalVertices.place, and field with what lies along the push.
void move_hit_cells(const MetalView& metal, const Striker& striker, const CellBlow& blow);

}  // namespace cullet
