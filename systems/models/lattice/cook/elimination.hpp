// How a matrix over nodes is factorised: which numbers there are, and in which panels of columns they stand. A piece of
// the body has a part of the same nodes: it goes by the body's plan and leaves out what it does not have.
#pragma once
#include <cstdint>
#include <vector>

#include "systems/models/lattice/cook/order_nodes.hpp"

namespace cullet {

/// Columns that follow each other and have the same rows below them.
struct EliminationPanel {
    uint32_t first_column = 0, columns = 0;  // ranks
    uint32_t first_row = 0, rows = 0;        // in panel_rows: ranks past the columns, ascending
};

struct EliminationPlan {
    uint32_t width = 1;          // unknowns of a node
    std::vector<uint32_t> rank;  // of each node: 0 is eliminated first
    std::vector<uint32_t> node;  // of each rank
    /// Blocks of the matrix's lower half, column by column: ranks of the rows, ascending, the diagonal first.
    std::vector<uint32_t> first_entry, entry_row;
    std::vector<EliminationPanel> panels;
    std::vector<uint32_t> panel_rows, panel_of;  // panel_of: each rank's
    /// The most that a factorisation by this plan holds.
    uint64_t factor_values = 0;
    uint32_t most_rows = 0, most_columns = 0;  // of a panel, in unknowns, rounded up to kPanelStep
    uint64_t most_update = 0;

    uint32_t count() const { return static_cast<uint32_t>(rank.size()); }
    /// Of the block (row, column), row >= column: its place in entry_row.
    uint32_t entry(uint32_t row, uint32_t column) const;
};

/// Numbers of a panel's column: lanes of the widest processors divide it.
inline constexpr uint32_t kPanelStep = 8;
constexpr uint32_t padded(uint32_t rows) {
    return (rows + kPanelStep - 1) / kPanelStep * kPanelStep;
}

EliminationPlan plan_elimination(const NodeGraph& graph, const std::vector<Vec3d>& places, uint32_t width);

}  // namespace cullet
