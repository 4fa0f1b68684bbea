// The steps of a cut.
#pragma once
#include <string>

#include "systems/structures/tetrahedra/cook/cut.hpp"
#include "systems/structures/tetrahedra/cook/grid_points.hpp"

namespace cullet {

/// Where a triangle crosses a face: a piece of the way round the inside part of the face, as its loops have it.
struct FaceSegment {
    uint32_t face = 0, triangle = 0;
    CutKey from, to;
};

/// What lay in a plane and is to be shifted.
struct Undecided {
    List<uint32_t> mesh_points, lattice_points;
    List<uint32_t> flat_triangles;  // without area on the grid: their own points are at fault
    uint32_t triangle = 0;          // one of those that asked
    bool is_empty() const { return mesh_points.empty() && lattice_points.empty() && flat_triangles.empty(); }
};

/// 4.3: polygons, segments and piercings of the triangles that are cut already.
struct CutTriangles {
    List<CutPolygon> polygons;
    List<CutKey> keys;
    List<FaceSegment> segments;
    List<Piercing> piercings;  // by triangle
    List<uint32_t> tetrahedron_of;
    Undecided undecided;
    uint32_t uncovered = 0xffffffffu;  // a triangle that leaves the lattice
};

/// Sorts them by edge, then from the lower end on.
void sort_piercings(const CutRequest& request, const GridPoints& points, Cut& cut);

/// 4.4: how often the parts wind around every point, from those that are known, along edges. False: some wanted point
/// is not reached.
bool find_windings(const CutRequest& request, const List<uint8_t>& is_known, Cut& cut);
/// Whether all edges agree with them.
bool are_consistent(const CutRequest& request, const Cut& cut);

/// 4.4: loops of faces, behind the polygons' keys.
void find_loops(const CutRequest& request, const List<FaceSegment>& segments, Cut& cut);

/// Of every key.
void find_places(const CutRequest& request, const GridPoints& points, Cut& cut);

}  // namespace cullet
