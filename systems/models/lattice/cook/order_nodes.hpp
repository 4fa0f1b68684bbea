// In which order the unknowns of a system of equations are eliminated, so that few new numbers come up: nested
// dissection. What a piece of the body has of the order is as good for the piece.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/math.hpp"

namespace cullet {

/// Neighbours of node n: to[first[n]] up to to[first[n + 1]], ascending, without n itself.
struct NodeGraph {
    std::vector<uint32_t> first, to;
    uint32_t count() const { return static_cast<uint32_t>(first.size()) - 1; }
    std::span<const uint32_t> of(uint32_t node) const {
        return {to.data() + first[node], first[node + 1] - first[node]};
    }
};
/// Nodes are neighbours when an element has both. `nodes`: of all elements, `per_element` each.
NodeGraph graph_of(uint32_t count, std::span<const uint32_t> nodes, uint32_t per_element);

/// All nodes, the first to be eliminated first.
std::vector<uint32_t> dissect(const NodeGraph& graph, std::span<const Vec3d> places);

}  // namespace cullet
