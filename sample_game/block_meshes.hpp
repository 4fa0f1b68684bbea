// Solids of blocks: cells of a grid that are full or empty, and the closed surface between them. Edges and flat faces
// stay as sharp and as flat as they are drawn, unlike those of an implicit function.
#pragma once
#include <array>
#include <functional>

#include "sample_game/mesh_tools.hpp"

namespace cullet {

using GridNode = std::array<int, 3>;

struct Blocks {
    std::array<int, 3> low{}, high{};  // nodes; cell (i, j, k) lies between nodes i and i + 1, and so on
    std::function<bool(int i, int j, int k)> is_full;
    std::function<Vec3d(const GridNode&)> place;  // of a node, m; right-handed as the nodes are
};

/// The surface between full and empty cells, each of its squares cut along the shorter diagonal, outside
/// counter-clockwise. It is a manifold where no two full cells meet in an edge or a corner alone.
MeshDraft surface_of(const Blocks& blocks);

/// Moves points inside of flat faces about by up to 0.18 of their shortest edge, so that cracks meet no pattern. Never
/// folds a triangle; points on creases stay.
void shake_flat_faces(MeshDraft& surface, uint64_t seed);

}  // namespace cullet
