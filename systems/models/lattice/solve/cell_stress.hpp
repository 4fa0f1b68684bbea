// Stress of the cells of a piece: at their centroids, and on the surface where bending has its most.
#pragma once
#include <cstdint>
#include <span>

#include "systems/models/lattice/solve/stiffness.hpp"

namespace cullet {

/// Of one element: the displacement's gradient is the sum of l_k times these, by corners; rows are displacements.
struct ElementGradient {
    double at[4][3][3];
};
/// Of elements with solid in them.
void differentiate(const SolidElements& solid, std::span<const Moments> sums, std::span<const double> displacements,
                   std::span<ElementGradient> gradients);

Sym3d stress_at(const ElementGradient& gradient, const Barycentric& at, const ElasticSolid& elastic);

/// Of a cell's probes, the stress whose first principal value is largest, and that value.
struct CellStress {
    Sym3d stress;
    double first = 0;
};
CellStress largest_stress(const SolidElements& solid, std::span<const ElementGradient> gradients, uint32_t cell,
                          const ElasticSolid& elastic);

}  // namespace cullet
