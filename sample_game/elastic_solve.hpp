// One static solve of a solid, or of some of its cells: for truth and tests.
#pragma once
#include <algorithm>
#include <memory>
#include <vector>

#include "systems/models/lattice/solve/cell_stress.hpp"
#include "systems/models/lattice/solve/inertia.hpp"
#include "systems/models/lattice/solve/stiffness.hpp"

namespace cullet {

struct ElasticSolve {
    const SolidElements& solid;
    ElasticSolid elastic;
    std::vector<uint32_t> cells;
    std::vector<Moments> sums;
    std::unique_ptr<Arena> arena;
    Factor factor;
    Pins pins;
    std::vector<double> loads, displacements, gathered;
    std::vector<ElementGradient> gradients;

    /// All cells, if none are given. Assembles without pins.
    ElasticSolve(const SolidElements& elements, const ElasticSolid& material, std::vector<uint32_t> piece = {});
    /// Loads that balance: pins, factor, solution and gradients.
    void solve();
    /// u K u / 2 by the elements, without pins; J.
    double energy() const;
    /// K u - f at the pins, N: by the matrix as it was before the pins.
    double pin_reaction() const;
    CellStress stress(uint32_t cell) const { return largest_stress(solid, gradients, cell, elastic); }
    /// K x, by rank.
    std::vector<double> times(const std::vector<double>& x) const;

 private:
    std::vector<double> entries_;  // without pins
};

/// The face of a box at x = +-half.x carries `traction` (N/m2, by place): forces on a grid that is finer than any
/// polygon.
template <class Traction>
void pull_face(ElasticSolve& solve, Vec3d half, double side, Traction traction) {
    constexpr int kGrid = 60;
    for (int i = 0; i < kGrid; ++i)
        for (int k = 0; k < kGrid; ++k) {
            const Vec3d place{side * half.x, half.y * ((2 * i + 1.0) / kGrid - 1),
                              half.z * ((2 * k + 1.0) / kGrid - 1)};
            ElementPlace at;
            double inside = -1e300;
            for (uint32_t e = 0; e < solve.solid.elements.size(); ++e) {
                const SolidElement& element = solve.solid.elements[e];
                Barycentric l{};
                for (uint32_t c = 0; c < 4; ++c)
                    l[c] = dot(element.gradient[c], place - solve.solid.places[element.node[(c + 1) % 4]]);
                const double least = *std::min_element(l.begin(), l.end());
                if (volume_of(solve.sums[e]) > 0 && least > inside) inside = least, at = {e, l};
            }
            add_force(solve.solid, at, 4 * half.y * half.z / (kGrid * kGrid) * traction(place), solve.loads);
        }
}

}  // namespace cullet
