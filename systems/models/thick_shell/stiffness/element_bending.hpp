// Bending of a triangle whose material has a grain: its three hinges are coupled.
#pragma once
#include <algorithm>
#include <utility>

#include "systems/models/thick_shell/stiffness/element_stiffness.hpp"

namespace cullet {

/// Energy 1/2 sum_kl H_kl theta_k theta_l over the hinges of a triangle's edges. The curvature is that of the stress
/// check, kappa = sum_k theta_k L_k / (2A) p_k p_k^T, and the energy A h^3/12 kappa.C kappa / 2. Hinges by themselves
/// (k_h = D L^2/(A1+A2)), which are this without the products of different hinges, hold for one D in all directions. On
/// an equilateral mesh they make wood five times too stiff across the grain, with any choice of D by the edge's
/// direction.
struct BendingTerms {
    double h[3][3] = {};  // N m, 0 where an edge has no hinge
    uint32_t hinge[3];    // of the shell, or kNone

    BendingTerms(const ShellView& shell, const PlaneStress& stress, uint32_t element) {
        const ShellRows& state = shell.state;
        const uint32_t row = shell.element(element);
        const TriangleTerms terms(state.triangle_springs, row, stress);
        const double thickness = state.triangle_springs.thickness[row];
        double b[3][3], scale = 1;
        for (size_t k = 0; k < 3; ++k) {
            hinge[k] = state.elements.hinge[row][k];
            // The corner opposite edge k has the gradient 1/altitude along the edge's normal: L / (2A) = 1/altitude.
            const auto& g = terms.g[(k + 2) % 3];
            const double size = std::sqrt(g[0] * g[0] + g[1] * g[1]), over = size > 0 ? 1 / size : 0;
            b[k][0] = g[0] * g[0] * over, b[k][1] = g[1] * g[1] * over, b[k][2] = 2 * g[0] * g[1] * over;
            if (hinge[k] != kNone) scale = std::min(scale, double{state.hinges.scale[shell.hinge(hinge[k])]});
        }
        const double factor = scale * terms.volume * thickness * thickness / 12;
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l)
                if (hinge[k] != kNone && hinge[l] != kNone) h[k][l] = factor * terms.full.product(b[k], b[l]);
    }
};

/// The vertices that a triangle's hinges hold, each once: its corners, then those across its edges. Two edges that meet
/// at an inner vertex of three triangles have the same vertex across, all three edges of a tetrahedron's face have.
struct BendingVertices {
    uint32_t count = 3;
    uint32_t vertex[6];
    uint8_t edges[6] = {7, 7, 7};  // bit k: the hinge of edge k holds the vertex; of a corner all do

    BendingVertices(const ShellView& shell, uint32_t element) {
        const uint32_t row = shell.element(element);
        const auto& corner = shell.state.elements.corner[row];
        std::copy(corner.begin(), corner.end(), vertex);
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t hinge = shell.state.elements.hinge[row][k];
            if (hinge == kNone) continue;
            for (const uint32_t v : shell.state.hinges.vertex[shell.hinge(hinge)]) {
                const uint32_t at = index_of(v);
                if (at < 3) continue;
                if (at == count) vertex[count] = v, edges[count++] = 0;
                edges[at] = static_cast<uint8_t>(edges[at] | 1u << k);
            }
        }
    }
    /// `count` where there is none.
    uint32_t index_of(uint32_t v) const { return static_cast<uint32_t>(std::find(vertex, vertex + count, v) - vertex); }
    bool is_held_once(uint32_t i) const { return i >= 3 && (edges[i] & (edges[i] - 1)) == 0; }
    /// Whether the element, or one across an edge of it, has both as corners. Where that is not so, or neither is a
    /// corner of the element, one of the two is held by one hinge alone: any two edges share all corners among them,
    /// and no edge has two vertices across.
    bool are_neighbours(uint32_t i, uint32_t j) const {
        if (i > j) std::swap(i, j);
        if (j < 3) return true;
        return i < 3 && (edges[j] & (1u << i | 1u << (i + 2) % 3)) != 0;  // edges i and i + 2 end at corner i
    }
};

}  // namespace cullet
