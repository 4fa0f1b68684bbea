// One static solve of a solid, or of some of its cells, for tests.
#pragma once
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

}  // namespace cullet
