#include "systems/models/lattice/crack/begin_pieces.hpp"

#include <algorithm>

namespace cullet {

void begin_pieces(const BreakableSolid& body, std::span<const uint8_t> own, BreakRun& run) {
    run.crack_count = run.solve_count = run.plane_count = 0;
    run.piece_count = body.part_count + !own.empty();
    std::fill(run.volume.begin(), run.volume.begin() + run.piece_count, 0.0);
    double sum = 0;
    for (uint32_t c = 0; c < run.piece.size(); ++c) {
        run.piece[c] = own.empty() || own[c] ? body.part[c] : body.part_count;
        if (run.piece[c] == body.part_count) continue;
        run.volume[body.part[c]] += body.solid.cells[c].volume;
        sum += body.solid.cells[c].volume;
    }
    run.volume_before = own.empty() ? body.solid.volume : sum;
}

}  // namespace cullet
