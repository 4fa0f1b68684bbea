#include "systems/models/lattice/solve/cell_stress.hpp"

#include "systems/models/lattice/solve/principal_stress.hpp"

namespace cullet {
namespace {

void add_outer(double (&to)[3][3], double s, Vec3d u, Vec3d g) {
    const double a[3] = {s * u.x, s * u.y, s * u.z}, b[3] = {g.x, g.y, g.z};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) to[i][k] += a[i] * b[k];
}

}  // namespace

void differentiate(const SolidElements& solid, std::span<const Moments> sums, std::span<const double> displacements,
                   std::span<ElementGradient> gradients) {
    for (size_t e = 0; e < solid.elements.size(); ++e) {
        if (!(volume_of(sums[e]) > 0)) continue;
        const SolidElement& element = solid.elements[e];
        ElementGradient& made = gradients[e];
        made = {};
        const auto u = [&](uint32_t n) {
            const double* d = displacements.data() + size_t{solid.plan.rank[element.node[n]]} * 3;
            return Vec3d{d[0], d[1], d[2]};
        };
        for (uint32_t i = 0; i < 4; ++i)
            for (uint32_t k = 0; k < 4; ++k) add_outer(made.at[k], i == k ? 3.0 : -1.0, u(i), element.gradient[i]);
        for (uint32_t m = 0; m < 6; ++m) {
            const uint32_t i = kMiddleEnds[m][0], j = kMiddleEnds[m][1];
            add_outer(made.at[i], 4, u(4 + m), element.gradient[j]);
            add_outer(made.at[j], 4, u(4 + m), element.gradient[i]);
        }
    }
}

Sym3d stress_at(const ElementGradient& gradient, const Barycentric& at, const ElasticSolid& elastic) {
    double g[3][3];
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            g[i][k] = at[0] * gradient.at[0][i][k] + at[1] * gradient.at[1][i][k] + at[2] * gradient.at[2][i][k] +
                      at[3] * gradient.at[3][i][k];
    const double mu = elastic.shear(), sum = elastic.first_lame() * (g[0][0] + g[1][1] + g[2][2]);
    return {sum + 2 * mu * g[0][0],   sum + 2 * mu * g[1][1],   sum + 2 * mu * g[2][2],
            mu * (g[0][1] + g[1][0]), mu * (g[0][2] + g[2][0]), mu * (g[1][2] + g[2][1])};
}

CellStress largest_stress(const SolidElements& solid, std::span<const ElementGradient> gradients, uint32_t cell,
                          const ElasticSolid& elastic) {
    CellStress most;
    for (uint32_t p = solid.first_probe[cell]; p < solid.first_probe[cell + 1]; ++p) {
        const Sym3d stress = stress_at(gradients[solid.probes[p].element], solid.probes[p].at, elastic);
        const double first = principal_stress(stress).first;
        if (p == solid.first_probe[cell] || first > most.first) most = {stress, first};
    }
    return most;
}

}  // namespace cullet
