// What a tetrahedron holds of the solid falls into connected parts (solid cooking note, 4.5).
#pragma once
#include "systems/structures/tetrahedra/cook/cut.hpp"

namespace cullet {

/// Integrals over a part of the solid, about a place.
struct VolumeSums {
    double volume = 0;  // m3
    Vec3d first;        // of x, m4
    Sym3d second;       // of x x^T, m5
};
inline void operator+=(VolumeSums& a, const VolumeSums& b) {
    a.volume += b.volume, a.first += b.first, a.second = a.second + b.second;
}
/// Adds what lies between a way round and the origin: positive where it runs counter-clockwise from outside. Places
/// count from that origin.
void add_fan(std::span<const Vec3d> places, Vec3d origin, double sign, VolumeSums& sums);

/// Area and place of a way round, seen along the sum of its area.
struct FlatSums {
    Vec3d area;   // m2, along its normal
    Vec3d first;  // of x over its size along that normal, m3
};
FlatSums flat_sums(std::span<const Vec3d> places, Vec3d normal);

struct CutCell {
    uint32_t tetrahedron = 0;
    VolumeSums sums;  // about the tetrahedron's middle
};

struct CutCells {
    List<CutCell> cells;                    // by tetrahedron
    List<Vec3d> middles;                    // of tetrahedra
    List<uint32_t> of_polygon;              // cell
    List<std::array<uint32_t, 2>> of_loop;  // in the first and the second tetrahedron of its face; kNone: rim
};

/// Legs that pass through one tetrahedron apart are cells of their own; what belongs to different parts of the mesh is
/// welded. A bubble or a tunnel belongs to the largest cell of its tetrahedron. All faces must have been wanted, or all
/// of the tetrahedra in the list.
CutCells find_cells(const CutRequest& request, const Cut& cut, std::span<const uint32_t> tetrahedra = {});

}  // namespace cullet
