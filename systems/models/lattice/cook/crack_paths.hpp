// Which way cracks may run through a solid: bonds of a cell, and bonds that meet at an edge of the lattice.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "systems/structures/tetrahedra/cook/solid.hpp"

namespace cullet {

struct CrackPaths {
    std::vector<uint32_t> first_bond, bonds;             // of each cell, ascending; and the end
    std::vector<std::array<uint32_t, 3>> edges;          // of each bond: those of its face
    std::vector<uint32_t> first_at_edge, bonds_at_edge;  // of each edge that a bond has, ascending; and the end
    std::span<const uint32_t> of_cell(uint32_t cell) const {
        return {bonds.data() + first_bond[cell], first_bond[cell + 1] - first_bond[cell]};
    }
    std::span<const uint32_t> at_edge(uint32_t edge) const {
        return {bonds_at_edge.data() + first_at_edge[edge], first_at_edge[edge + 1] - first_at_edge[edge]};
    }
};

CrackPaths find_crack_paths(const Solid& solid);

}  // namespace cullet
