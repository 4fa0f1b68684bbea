// A blow speeds a piece up as a whole: what its own mass takes of the load, so that nothing is left for its pins.
#pragma once
#include <cstdint>
#include <span>

#include "systems/models/lattice/cook/solid_elements.hpp"

namespace cullet {

/// Each cell's part in each element counts as a point: elements take forces in the same way.
struct PieceMass {
    double mass = 0;  // kg
    Vec3d centre;
    Sym3d inertia;  // about the centre
};
PieceMass mass_of(const SolidElements& solid, std::span<const uint32_t> cells, double density);

/// `loads`: by rank, three each, N. Adds a force at a place.
void add_force(const SolidElements& solid, const ElementPlace& at, Vec3d force, std::span<double> loads);
/// Force and torque about `centre` of all loads.
struct TotalLoad {
    Vec3d force, torque;
};
TotalLoad total_of(const SolidElements& solid, std::span<const double> loads, Vec3d centre);

/// Takes from the loads what speeds the piece up, and what its spin (rad/s) needs: nothing is left to push it.
void relieve(const SolidElements& solid, std::span<const uint32_t> cells, double density, const PieceMass& mass,
             Vec3d spin, std::span<double> loads);

}  // namespace cullet
