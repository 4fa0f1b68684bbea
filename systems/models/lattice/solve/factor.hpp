// L D L^T of a piece's matrix by the body's plan, panel by panel: it may stop after each and go on in a later frame.
// The order of all sums is the plan's, so the bits are the same on any number of threads.
#pragma once
#include <cstdint>
#include <span>

#include "engine/arena.hpp"
#include "systems/models/lattice/cook/elimination.hpp"

namespace cullet {

/// A panel of the plan, with what the piece has of it.
struct FactorPanel {
    uint64_t first_value = 0;
    uint32_t columns = 0, rows = 0;  // nodes
    uint32_t tall = 0;               // numbers of a column
    uint32_t done = 0;               // rows whose columns have had this panel's share
    uint32_t next = 0;               // of the panels that the same one waits for
};

struct Factor {
    // Of the matrix.
    std::span<double> entries;   // width * width for each of the plan's blocks, row after row
    std::span<uint8_t> is_used;  // by rank: nodes that the piece has
    // Of its factor.
    std::span<FactorPanel> panels;
    std::span<uint32_t> columns, rows;  // ranks in use: places as those of the plan's ranks and panel_rows
    std::span<double> values;
    // While it is made.
    std::span<uint32_t> place;    // by rank: row of the panel at work, in nodes
    std::span<uint32_t> waiting;  // by panel: the first that has a share for it
    std::span<double> update, scaled;
    uint32_t next_panel = 0;
    uint64_t next_value = 0;
    uint64_t work = 0;  // multiplications so far
    bool is_positive = true;
};

/// No span is empty if the arena had room.
Factor take_factor(Arena& arena, const EliminationPlan& plan);
uint64_t factor_bytes(const EliminationPlan& plan);

/// Forgets matrix, nodes in use and factor.
void clear_factor(Factor& factor);
/// The panel's last unknown is eliminated once this is true. Works on until `work` multiplications are done.
bool advance_factor(const EliminationPlan& plan, Factor& factor, uint64_t work);

/// x: by rank, `width` each; the right side, and then the solution. `gathered`: most_rows numbers.
void solve_with(const EliminationPlan& plan, const Factor& factor, std::span<double> x, std::span<double> gathered);

}  // namespace cullet
