// Bending of a triangle whose material has a grain: its three hinges are coupled.
#pragma once
#include "systems/damage/element_stiffness.hpp"

namespace cullet {

/// Energy 1/2 sum_kl H_kl theta_k theta_l over the hinges of a triangle's edges. The curvature is that of the stress
/// check (note B3), kappa = sum_k theta_k L_k / (2A) p_k p_k^T, and the energy A h^3/12 kappa.C kappa / 2. Hinges by
/// themselves (k_h = D L^2/(A1+A2)), which are this without the products of different hinges, hold for one D in all
/// directions: on an equilateral mesh they make wood five times too stiff across the grain, with any choice of D by the
/// edge's direction.
struct BendingTerms {
    double h[3][3] = {};  // N m, 0 where an edge has no hinge
    uint32_t hinge[3];    // of the shell, or kNone

    BendingTerms(const ShellView& shell, const PlaneStress& stress, uint32_t element) {
        const State& state = shell.state;
        const uint32_t row = shell.element(element);
        const TriangleTerms terms(state.triangle_springs, row, stress);
        const double thickness = state.triangle_springs.thickness[row];
        double b[3][3], root[3];
        for (size_t k = 0; k < 3; ++k) {
            hinge[k] = state.elements.hinge[row][k];
            // The corner opposite edge k has the gradient 1/altitude along the edge's normal: L / (2A) = 1/altitude.
            const auto& g = terms.g[(k + 2) % 3];
            const double size = std::sqrt(g[0] * g[0] + g[1] * g[1]), over = size > 0 ? 1 / size : 0;
            b[k][0] = g[0] * g[0] * over, b[k][1] = g[1] * g[1] * over, b[k][2] = 2 * g[0] * g[1] * over;
            root[k] = hinge[k] == kNone ? 0 : std::sqrt(double{state.hinges.scale[shell.hinge(hinge[k])]});
        }
        const double factor = terms.volume * thickness * thickness / 12;
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l) h[k][l] = factor * root[k] * root[l] * terms.full.product(b[k], b[l]);
    }
};

}  // namespace cullet
