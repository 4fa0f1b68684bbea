// Static triangles, sorted out: closed convex parts of at most 32 corners (floors, tables, walls made as boxes) become
// convex pieces, which push out on the nearest side and have no inner edges to stumble over; all other triangles stay
// triangles, in a tree of boxes. A triangle bears from both sides (see sides.hpp), unless it is asked for one.
#pragma once
#include <array>
#include <vector>

#include "engine/bullet/hull.hpp"

namespace cullet::bullet {

struct StaticTriangle {
    Vec3 corner[3];
    // Edge k runs from corner k to the next. A convex or open edge may push outwards; at the others only the face
    // pushes. What is convex seen from the front is hollow seen from behind.
    bool is_edge_sharp[3], is_edge_sharp_behind[3];
};

struct StaticMesh {
    bool one_sided = false;   // only the side that sees the corners counter-clockwise bears
    uint32_t left_out = 0;    // triangles without area, or the same as an earlier one
    uint32_t first_left = 0;  // the first of them, as they were given
    std::vector<std::vector<Vec3>> solids;
    std::vector<StaticTriangle> triangles;

    struct Node {
        Box box;
        uint32_t first, count;  // triangles of a leaf; count 0: children at `first` and `first` + 1
    };
    std::vector<Node> nodes;  // the root is node 0
};

StaticMesh sort_static_triangles(std::span<const Vec3> positions, std::span<const std::array<uint32_t, 3>> triangles,
                                 bool one_sided = false);

/// Calls visit(index) for every triangle whose box meets `box`, in the tree's own order.
template <class Visit>
void visit_triangles(const StaticMesh& mesh, const Box& box, Visit&& visit) {
    if (mesh.nodes.empty()) return;
    uint32_t stack[64];
    uint32_t height = 0;
    stack[height++] = 0;
    while (height > 0) {
        const StaticMesh::Node& node = mesh.nodes[stack[--height]];
        if (!overlap(node.box, box, 0)) continue;
        for (uint32_t t = node.first; t < node.first + node.count; ++t) visit(t);
        if (node.count == 0) {
            stack[height++] = node.first + 1;
            stack[height++] = node.first;
        }
    }
}

}  // namespace cullet::bullet
