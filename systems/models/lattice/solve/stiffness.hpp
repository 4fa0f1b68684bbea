// The stiffness of a piece: for each element, over the solid that the piece's cells have in it.
#pragma once
#include <cstdint>
#include <span>

#include "systems/models/lattice/cook/solid_elements.hpp"
#include "systems/models/lattice/solve/factor.hpp"

namespace cullet {

struct ElasticSolid {
    double young = 70e9;  // E, Pa
    double poisson = 0.2;
    double shear() const { return young / (2 * (1 + poisson)); }                                 // mu
    double first_lame() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }  // lambda
};

/// By element: what the cells together have in it. An element without solid in it is none of the piece.
void sum_moments(const SolidElements& solid, std::span<const uint32_t> cells, std::span<Moments> sums);

/// Adds elements [first, end) to the matrix, and their nodes to those in use.
void add_stiffness(const SolidElements& solid, std::span<const Moments> sums, const ElasticSolid& elastic,
                   uint32_t first, uint32_t end, Factor& factor);

/// Sums of the solid's moments that hold the matrix regular where a piece has next to nothing, as a share of an
/// element that is full.
inline constexpr double kStiffnessFloor = 2e-5;

/// Six unknowns, three, two and one at three nodes far from each other: the piece cannot move as a whole, and where the
/// loads balance nothing pulls at them. Ranks, and a bit a component.
struct Pin {
    uint32_t rank = 0;
    uint8_t components = 0;
};
using Pins = std::array<Pin, 3>;
/// `weights`: by node, what solid the elements around it have. `centre`: of the piece. False: it has no three such
/// nodes.
bool choose_pins(const SolidElements& solid, const Factor& factor, std::span<const double> weights, Vec3d centre,
                 std::span<double> sorted, Pins& pins);
/// Adds up the solid of the elements in use at their nodes.
void weigh_nodes(const SolidElements& solid, std::span<const Moments> sums, std::span<double> weights);

/// Rows and columns of the pins leave the matrix.
void hold(const EliminationPlan& plan, const Pins& pins, Factor& factor);
/// Loads on pins are dropped.
void hold(const Pins& pins, std::span<double> loads);

}  // namespace cullet
