// Linear elements on the fine tetrahedra of a solid, for the scalar whose level is a curved crack (solid cooking note,
// 6.3). Each cell stands for the tetrahedron that has most of it.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "systems/models/lattice/cook/elimination.hpp"
#include "systems/structures/tetrahedra/cook/solid.hpp"

namespace cullet {

struct CrackFieldCell {
    std::array<uint32_t, 4> rank{};      // of its corners in the plan
    std::array<Vec3d, 4> gradient{};     // of the four barycentric coordinates, 1/m
    std::array<double, 4> centroid{};    // of the cell, in these
    std::array<uint32_t, 10> entries{};  // of the plan: pairs 00, 10, 11, 20, ...
};

struct CrackField {
    std::vector<CrackFieldCell> cells;
    EliminationPlan plan;  // one unknown a lattice point
};

CrackField make_crack_field(const Solid& solid);

}  // namespace cullet
