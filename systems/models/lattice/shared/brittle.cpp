#include "systems/models/lattice/shared/brittle.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr double kBlowStrength = 2;    // of the strength under loads of seconds, as of thick shells
constexpr double kCrushOverPull = 10;  // brittle ones: of the tensile strength

}  // namespace

BrittleSolid brittle_of(const Materials& m, Row<Materials> material) {
    BrittleSolid brittle;
    brittle.elastic.young = double{m.young_modulus[material]};
    brittle.elastic.poisson = double{m.poisson_ratio[material]};
    brittle.density = double{m.density[material]};
    brittle.tensile_strength = kBlowStrength * double{m.tensile_strength[material]};
    brittle.compressive_strength =
        std::min(double{m.crush_strength[material]}, kCrushOverPull * brittle.tensile_strength);
    return brittle;
}

}  // namespace cullet
