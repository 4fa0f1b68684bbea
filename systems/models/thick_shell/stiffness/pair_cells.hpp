// How the stiffness of a large shell is stored (thick shell note, section 10). Where all rows outgrow the caches a
// pair of vertices of one pair cell stands once, in the lane of one of its ends: the step adds what the pair does to
// the other end there, too. Pairs between cells stand in both lanes. Small shells have all pairs in both lanes.
//
// A pair cell is a fixed number of packs in a row, which one thread works off at once, so that the order of all sums
// follows from the layout alone.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

struct VertexRow;

inline constexpr uint32_t kPairCellPacks = kRowsPerChunk<StiffnessPacks>;
inline constexpr uint32_t kPairCellVertices = kPairCellPacks * kLanes;

/// Cells of the collision shape from which on a shell stores pairs once: about 48 vertices each, so 50,000 vertices.
/// The number of cells stays while the shell has stiffness, the number of vertices does not. A pair stored once costs
/// more work than two rows: 16.6 against 11 to 12 ns a vertex at 11,000 vertices, whose 5 MB of rows come from L3 where
/// it was measured. So it can pay only where rows outgrow L3 as well: 98,000 vertices, 28 against 45 MB. There the bare
/// kernel was 1.2 to 2.3 times faster with pairs once, on a machine so busy that this wants measuring again.
inline constexpr uint32_t kPairedCells = 1050;

/// For tests, which take small shells through a world this way: the bound in place of kPairedCells, while no shell has
/// stiffness that another bound laid (models cooked before, worlds that hold them).
void set_paired_cells(uint32_t cells);
uint32_t paired_cells();

inline bool stores_pairs_once(const Structures& structures, Row<Structures> shell) {
    return structures.cells[shell].count >= paired_cells();
}
inline bool are_in_one_pair_cell(uint32_t vertex, uint32_t other) {
    return vertex / kPairCellVertices == other / kPairCellVertices;
}

/// Of a shell that stores pairs once: places for all packs, wide enough for each lane's share of the pairs, and the
/// names of those inside its pair cell. False: the shell's ranges are too small.
bool lay_pair_cells(ShellView shell);

/// Takes from the vertex's row what another lane of its pair cell stores. Who stored a pair goes on to; a new pair is
/// stored by the end that asks first.
void drop_others_pairs(ShellView shell, uint32_t vertex, VertexRow& row);

}  // namespace cullet
