// What stands around each point of a solid's lattice.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "systems/structures/tetrahedra/cook/solid.hpp"

namespace cullet {

struct LatticePoints {
    std::vector<uint32_t> first, tetrahedra;  // of each point, ascending; and the end
    std::vector<float> shortest;              // m: of each point's edges
    std::vector<uint8_t> is_rim;              // a face of the point has no tetrahedron beyond
    std::span<const uint32_t> of(uint32_t point) const {
        return {tetrahedra.data() + first[point], first[point + 1] - first[point]};
    }
};

LatticePoints find_lattice_points(const CoverLattice& lattice);

double volume_of(const CoverLattice& lattice, std::span<const Vec3d> places, uint32_t tetrahedron);

}  // namespace cullet
