// Points on the integer grid of exact predicates (solid cooking note, 4.1).
#pragma once
#include <span>

#include "engine/math.hpp"
#include "engine/room.hpp"
#include "systems/structures/tetrahedra/cook/exact.hpp"

namespace cullet {

/// Mesh points and lattice points on one grid, each shifted by a few units of its own: a millionth of the size, so that
/// hardly any point lies in a plane of others. What lies in one all the same is shifted anew.
struct GridPoints {
    GridPoints(std::span<const Vec3d> mesh_places, std::span<const Vec3d> lattice_places, Vec3d centre);

    List<GridPoint> mesh, lattice;
    void shift_mesh(uint32_t v) { shift(mesh[v], mesh_shifts_[v]++, v, kMeshShift); }
    void shift_lattice(uint32_t v) { shift(lattice[v], lattice_shifts_[v]++, v, kLatticeShift); }

    static constexpr int32_t kMeshShift = 3, kLatticeShift = 2;  // units, to either side

 private:
    static void shift(GridPoint& point, uint32_t before, uint32_t number, int32_t reach);
    List<uint32_t> mesh_shifts_, lattice_shifts_;
};

}  // namespace cullet
