// What solids have beside the rows of a structure. A world without solids has no rows here.
//
// What was cooked does not change and is shared: a body's pieces, and theirs, name the same row of CookedSolids. A
// piece is a list of its cells, of lattice points that its crack faces moved, and a skin. Indices are relative to the
// ranges of the cooked solid.
#pragma once
#include <array>
#include <memory>

#include "components/structures.hpp"

namespace cullet {

struct SolidRooms;  // systems/structures/tetrahedra/solid_rooms.hpp

/// One row is one cooked mesh.
struct CookedSolids : RangeTable<CookedSolids> {
    using RangeTable::RangeTable;
    CULLET_TABLE(cooked_solids);
    Column<uint32_t> users{*this, "users"};  // rows of Solids that name it; 0: free
    /// Of what it holds: whatever is made of it and kept beside the tables is looked up by this.
    Column<uint64_t> content{*this, "content"};
    Column<double> edge{*this, "edge", "m"};  // a, of the cubes of fine tetrahedra
    Column<double> volume{*this, "volume", "m3"};
    Column<double> area{*this, "area", "m2"};
    Column<double> thickness{*this, "thickness", "m"};
    Column<Vec3d> low{*this, "low", "m"};  // box of the mesh
    Column<Vec3d> high{*this, "high", "m"};
    Column<uint32_t> parts{*this, "parts"};                     // of the mesh
    Column<Range> lattice_points{*this, "lattice_points"};      // LatticeNodes
    Column<Range> tetrahedra{*this, "tetrahedra"};              // Tetrahedra
    Column<Range> coarse{*this, "coarse"};                      // CoarseTetrahedra
    Column<Range> windings{*this, "windings"};                  // PointWindings
    Column<Range> cells{*this, "cells"};                        // SolidCells
    Column<Range> raw{*this, "raw"};                            // RawCellRows
    Column<Range> moments{*this, "moments"};                    // SolidMoments
    Column<Range> bonds{*this, "bonds"};                        // SolidBonds
    Column<Range> patches{*this, "patches"};                    // SolidPatches
    Column<Range> points{*this, "points"};                      // SkinPoints: of the mesh as it came
    Column<Range> triangles{*this, "triangles"};                // SkinTriangles
    Column<Range> mesh_triangles{*this, "mesh_triangles"};      // MeshTriangles, row for row of triangles
    Column<float> strength_modulus{*this, "strength_modulus"};  // Weibull's; 0: all cells are equally strong
    Column<uint64_t> strength_seed{*this, "strength_seed"};
};

/// One row is one point of a lattice of fine tetrahedra.
struct LatticeNodes : RangeTable<LatticeNodes> {
    using RangeTable::RangeTable;
    CULLET_TABLE(lattice_nodes);
    Column<Vec3d> place{*this, "place", "m"};                // as cooked
    Column<uint32_t> first_winding{*this, "first_winding"};  // of PointWindings
    Column<uint32_t> winding_count{*this, "winding_count"};
};
/// One row says how often one part of the mesh winds around a point.
struct PointWindings : RangeTable<PointWindings> {
    using RangeTable::RangeTable;
    CULLET_TABLE(point_windings);
    Column<uint32_t> part{*this, "part"};
    Column<uint32_t> count{*this, "count"};  // two's complement
};
struct Tetrahedra : RangeTable<Tetrahedra> {
    using RangeTable::RangeTable;
    CULLET_TABLE(tetrahedra);
    Column<std::array<uint32_t, 4>> corners{*this, "corners"};  // of positive volume; neighbours follow from them
    Column<uint32_t> coarse{*this, "coarse"};
};
struct CoarseTetrahedra : RangeTable<CoarseTetrahedra> {
    using RangeTable::RangeTable;
    CULLET_TABLE(coarse_tetrahedra);
    Column<std::array<uint32_t, 10>> nodes{*this, "nodes"};  // TenNodes
};
/// Cells of solids; those of structures are chunks of a collision shape.
struct SolidCellRows : RangeTable<SolidCellRows> {
    using RangeTable::RangeTable;
    CULLET_TABLE(solid_cells);
    Column<uint32_t> tetrahedron{*this, "tetrahedron"};
    Column<double> volume{*this, "volume", "m3"};
    Column<Vec3d> centroid{*this, "centroid", "m"};
};
/// By tetrahedron: what it held before small cells were merged.
struct RawCellRows : RangeTable<RawCellRows> {
    using RangeTable::RangeTable;
    CULLET_TABLE(raw_cells);
    Column<uint32_t> tetrahedron{*this, "tetrahedron"};
    Column<uint32_t> cell{*this, "cell"};
    Column<Vec3d> centroid{*this, "centroid", "m"};
};
/// By cell: what it has in one coarse tetrahedron.
struct SolidMoments : RangeTable<SolidMoments> {
    using RangeTable::RangeTable;
    CULLET_TABLE(solid_moments);
    Column<uint32_t> cell{*this, "cell"};
    Column<uint32_t> coarse{*this, "coarse"};
    Column<std::array<double, 10>> moments{*this, "moments", "m3"};
};
/// By (a, b): the inside part of a face between two cells.
struct SolidBondRows : RangeTable<SolidBondRows> {
    using RangeTable::RangeTable;
    CULLET_TABLE(solid_bonds);
    Column<uint32_t> a{*this, "a"};
    Column<uint32_t> b{*this, "b"};
    Column<uint32_t> tetrahedron{*this, "tetrahedron"};
    Column<uint32_t> face{*this, "face"};
    Column<double> area{*this, "area", "m2"};
    Column<Vec3d> centroid{*this, "centroid", "m"};
    Column<Vec3d> normal{*this, "normal"};
};
/// By triangle: the part of it that lies in one cell.
struct SolidPatches : RangeTable<SolidPatches> {
    using RangeTable::RangeTable;
    CULLET_TABLE(solid_patches);
    Column<uint32_t> triangle{*this, "triangle"};
    Column<uint32_t> cell{*this, "cell"};
    Column<double> area{*this, "area", "m2"};
    Column<Vec3d> centroid{*this, "centroid", "m"};
};
/// What a mesh that is cut again needs beyond its skin.
struct MeshTriangles : RangeTable<MeshTriangles> {
    using RangeTable::RangeTable;
    CULLET_TABLE(mesh_triangles);
    Column<std::array<uint32_t, 3>> sides{*this, "sides"};  // ClosedMesh::sides; the ends of pairs follow
    Column<uint32_t> part{*this, "part"};
};

/// One row is a corner of a closed surface, once each.
struct SkinPoints : RangeTable<SkinPoints> {
    using RangeTable::RangeTable;
    CULLET_TABLE(skin_points);
    Column<Vec3d> place{*this, "place", "m"};
    Column<uint32_t> tetrahedron{*this, "tetrahedron"};  // of the cooked mesh: where it lies; of pieces kNone
};
/// One row is one triangle of what is drawn and weighed: of the artist's mesh, of what closed it, or of a crack.
struct SkinTriangles : RangeTable<SkinTriangles> {
    using RangeTable::RangeTable;
    CULLET_TABLE(skin_triangles);
    Column<std::array<uint32_t, 3>> corners{*this, "corners"};  // counter-clockwise from outside
    Column<std::array<float, 9>> normals{*this, "normals"};     // unit, of each corner
    Column<std::array<float, 6>> uv{*this, "uv"};
    Column<uint16_t> drawn_material{*this, "drawn_material"};
    Column<uint8_t> is_inside{*this, "is_inside"};  // a crack's, or of a hole that was closed
};

/// One row is what one structure of this kind is: StructureKind::Tetrahedra.
struct Solids : RangeTable<Solids> {
    using RangeTable::RangeTable;
    CULLET_TABLE(solids);
    Column<Row<CookedSolids>> cooked{*this, "cooked"};
    Column<uint8_t> is_whole{*this, "is_whole"};  // all cells, nothing moved, the cooked skin: it has no ranges
    Column<double> volume{*this, "volume", "m3"};
    Column<Range> members{*this, "members"};      // SolidMembers
    Column<Range> moved{*this, "moved"};          // MovedNodes
    Column<Range> points{*this, "points"};        // SkinPoints
    Column<Range> triangles{*this, "triangles"};  // SkinTriangles
};
/// By cell: one that the structure has.
struct SolidMembers : RangeTable<SolidMembers> {
    using RangeTable::RangeTable;
    CULLET_TABLE(solid_members);
    Column<uint32_t> cell{*this, "cell"};
    Column<uint32_t> piece{*this, "piece"};  // what broke and found no room yet: cells of one number go together
};
/// By point: one that crack faces moved.
struct MovedNodes : RangeTable<MovedNodes> {
    using RangeTable::RangeTable;
    CULLET_TABLE(moved_nodes);
    Column<uint32_t> node{*this, "node"};
    Column<Vec3d> place{*this, "place", "m"};
};

}  // namespace cullet
