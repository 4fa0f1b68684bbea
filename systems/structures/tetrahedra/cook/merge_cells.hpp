// Small cells join a neighbour, and what is left becomes cells, bonds, moments and patches (solid cooking
// note, 4.5, 4.6).
#pragma once
#include "systems/structures/tetrahedra/cook/cut_cells.hpp"

namespace cullet {

struct MergeSettings {
    double least_share = 0.25;  // of the reference volume: of a whole tetrahedron, at most twice the mean cell
};

/// Fills the cells, moments, bonds and patches of a solid. `merged` gets the cell of every raw one.
void merge_cells(const CutRequest& request, const Cut& cut, const CutCells& raw, const MergeSettings& settings,
                 Solid& solid, std::vector<uint32_t>& merged);

}  // namespace cullet
