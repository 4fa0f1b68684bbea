// Finite elements of a solid: displacements are quadratic on whole coarse tetrahedra, and integrals run over the solid
// in them (solid cooking note, section 5). Thin walls need no fine lattice, and nothing is fitted to the surface.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "systems/models/lattice/cook/elimination.hpp"
#include "systems/structures/tetrahedra/cook/solid.hpp"

namespace cullet {

using Barycentric = std::array<double, 4>;

/// Nodes as in TenNodes, numbered anew. Where a coarse tetrahedron holds parts that do not hang together in it, each is
/// an element.
struct SolidElement {
    TenNodes node{};
    std::array<Vec3d, 4> gradient{};  // of the four barycentric coordinates, 1/m
    double volume = 0;                // of the whole tetrahedron, m3
};
/// What a cell has in an element.
struct SolidPart {
    uint32_t element = 0;
    Moments moments{};
};
/// A place in the solid, as an element sees it.
struct ElementPlace {
    uint32_t element = 0;
    Barycentric at{};
};

/// Places of a table of lower halves: 00, 10, 11, 20, ...
inline constexpr uint32_t kNodePairs = 55;
constexpr uint32_t pair_of(uint32_t row, uint32_t column) {
    return row * (row + 1) / 2 + column;
}

struct SolidElements {
    std::vector<Vec3d> places;  // of nodes, m
    std::vector<SolidElement> elements;
    std::vector<std::array<uint32_t, kNodePairs>> entries;  // of each element: of the plan, for pairs of its nodes
    std::vector<uint32_t> first_part;                       // of each cell, and the end
    std::vector<SolidPart> parts;
    std::vector<uint32_t> first_probe;  // of each cell, and the end
    std::vector<ElementPlace> probes;   // where its stress is taken: its centroid, the largest of its surface
    std::vector<ElementPlace> patches;  // of each row of the surface
    EliminationPlan plan;               // three unknowns a node
};

SolidElements make_elements(const Solid& solid);

/// Of a corner: its own edge and the middles to others; the two corners of a middle.
inline constexpr uint32_t kMiddleEnds[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
/// Of a symmetric table in the order of Moments.
inline constexpr uint32_t kMomentPlace[4][4] = {{0, 1, 2, 3}, {1, 4, 5, 6}, {2, 5, 7, 8}, {3, 6, 8, 9}};

/// Volume and centroid of what moments are of: sums of l, and where they lie.
double volume_of(const Moments& moments);
Vec3d centroid_of(const Moments& moments, const SolidElements& solid, const SolidElement& element);
/// Integral of each node's shape over the solid, m3.
std::array<double, 10> shape_integrals(const Moments& moments);
/// Values of the ten shapes at a place.
std::array<double, 10> shapes_at(const Barycentric& at);

}  // namespace cullet
