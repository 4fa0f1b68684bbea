#include "systems/models/lattice/crack/break_run.hpp"

#include <algorithm>

namespace cullet {
namespace {

/// Sizes of all arrays, told to whoever takes them or counts their bytes.
template <class Take>
void for_each_array(const BreakableSolid& body, BreakRun& run, Take take) {
    const size_t cells = body.solid.cells.size(), bonds = body.solid.bonds.size(), ranks = body.elements.places.size();
    const size_t rows = std::max(body.elements.plan.most_rows, body.field.plan.most_rows);
    take(run.piece, cells), take(run.marks, cells), take(run.side, cells), take(run.stress, cells),
        take(run.first, cells);
    take(run.trust, cells), take(run.direction, cells), take(run.cells, cells), take(run.part, cells),
        take(run.open, cells);
    take(run.sheet, bonds), take(run.is_sheet, bonds), take(run.is_held, body.solid.patches.size());
    take(run.volume, cells + 1), take(run.part_volume, cells + 1), take(run.part_area, cells + 1),
        take(run.part_piece, cells + 1), take(run.queue, cells + 1);
    take(run.heap, 2 * bonds + 1), take(run.sums, body.elements.elements.size());
    take(run.gradients, body.elements.elements.size());
    take(run.loads, 3 * ranks), take(run.forces, 3 * ranks), take(run.weights, ranks), take(run.sorted, ranks);
    take(run.gathered, rows), take(run.level, size_t{body.field.plan.count()});
}

}  // namespace

uint64_t break_bytes(const BreakableSolid& body) {
    constexpr uint64_t kSlack = 64;  // what alignment may take
    uint64_t bytes = factor_bytes(body.elements.plan) + factor_bytes(body.field.plan);
    BreakRun none;
    for_each_array(body, none, [&](const auto& array, size_t count) { bytes += count * sizeof(array[0]) + kSlack; });
    return bytes;
}

BreakRun take_break(Arena& arena, const BreakableSolid& body) {
    BreakRun run;
    for_each_array(body, run, [&]<class T>(std::span<T>& array, size_t count) { array = arena.take<T>(count); });
    run.factor = take_factor(arena, body.elements.plan);
    run.field = take_factor(arena, body.field.plan);
    return run;
}

}  // namespace cullet
