// What the mesh makers share. Points are in double until the end, decisions have total orders, and nothing calls libm.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/math.hpp"
#include "engine/mesh.hpp"

namespace cullet {

using Triangle = std::array<uint32_t, 3>;

/// A mesh in the making, in double.
struct MeshDraft {
    std::vector<Vec3d> points;
    std::vector<Triangle> triangles;
};

Mesh to_mesh(const MeshDraft& surface, const std::string& name);

/// An edge length that a shape of this size can be made with: between a thousandth of the size (some million vertices)
/// and the size, and a fortieth when it is no number.
double usable_edge(double edge, double size);

/// A number in [-1, 1) that depends on nothing but its arguments.
double jitter(uint64_t seed, uint64_t row, uint64_t number, uint64_t channel);

/// Fills the band between two rows of points with triangles that use each step of both rows once, always the shorter
/// diagonal. With e1 from row a to row b and e2 along the rows, e1 x e2 is the outside. Closed rows run round and start
/// anywhere.
void stitch_rows(MeshDraft& surface, const std::vector<uint32_t>& a, const std::vector<uint32_t>& b, bool is_closed);

/// Flips edges until opposite angles sum to at most pi everywhere (the cotangent form of the Delaunay rule, intrinsic
/// and so good on curved surfaces). Leaves border edges, edges whose flip would double another edge, and edges whose
/// flip would fold the surface. The mesh must be manifold and consistently wound. Edges whose triangles' normals have a
/// cosine below `least_cosine` stay: with 0.99 all creases do.
void flip_to_delaunay(MeshDraft& surface, double least_cosine = -2);

/// Splits, collapses, flips and slides points until edges are near the wanted length and triangles near equilateral,
/// after M. Botsch and L. Kobbelt, "A remeshing approach to multiresolution modeling", 2004. Closed surfaces only.
/// `project` takes a point near the surface onto it.
void remesh(MeshDraft& surface, double edge, const std::function<Vec3d(Vec3d)>& project);
/// The remesher settles at a mean edge 7 % above what it was given.
inline constexpr double kTargetPerMean = 0.935;

/// Splits the longest edge, again and again, until there are so many vertices. Each split adds one vertex and, inside,
/// two triangles. `project` takes the middle onto the surface; without one it stays, and so does the surface.
void split_longest(MeshDraft& surface, size_t vertices, const std::function<Vec3d(Vec3d)>& project = {});

/// Gives the triangles on one side of a seam vertices of their own, as models with textures have: up to `vertices` in
/// all. Positions stay, so welding equal ones gives the surface back. `is_beyond` tells which side a middle lies on.
void open_seam(MeshDraft& surface, size_t vertices, const std::function<bool(Vec3d)>& is_beyond);

/// A closed triangle mesh of {f < 0} in the box, on a grid of that cell size, by marching tetrahedra (six a cell, so
/// that there are no ambiguous cells). f must be positive on the box's sides.
MeshDraft surface_of(const std::function<double(Vec3d)>& f, Vec3d low, Vec3d high, double cell);

}  // namespace cullet
