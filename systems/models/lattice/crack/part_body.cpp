#include "systems/models/lattice/crack/part_body.hpp"

#include <algorithm>

#include "systems/models/lattice/crack/begin_pieces.hpp"
#include "systems/models/lattice/crack/crack_sheet.hpp"
#include "systems/models/lattice/crack/solve_piece.hpp"

namespace cullet {
namespace {

// Of a piece: what is smaller goes with its neighbour, unless nothing else parts the piece.
constexpr double kLeastShare = 0.1;
// What has fewer is parted no further than it has to be: halves of it would be debris.
constexpr uint32_t kFewCells = 12;
constexpr uint32_t kNothing = 0xffffffffu;

struct Plane {
    Vec3d place, normal;
};

bool part_piece(const BreakableSolid& body, uint32_t piece, const Plane& plane, double least, BreakRun& run) {
    for (const uint32_t c : run.cells.first(run.cell_count))
        run.side[c] = dot(plane.normal, body.solid.cells[c].centroid - plane.place) >= 0;
    return break_sides(body, run, piece, least);
}

Vec3d middle_of(const BreakableSolid& body, const BreakRun& run) {
    Vec3d sum;
    double volume = 0;
    for (const uint32_t c : run.cells.first(run.cell_count)) {
        sum += body.solid.cells[c].volume * body.solid.cells[c].centroid;
        volume += body.solid.cells[c].volume;
    }
    return (1 / volume) * sum;
}

Vec3d to_farthest(const BreakableSolid& body, const BreakRun& run, Vec3d from) {
    Vec3d farthest;
    for (const uint32_t c : run.cells.first(run.cell_count)) {
        const Vec3d way = body.solid.cells[c].centroid - from;
        if (dot(way, way) > dot(farthest, farthest)) farthest = way;
    }
    return farthest;
}

bool part_in_the_middle(const BreakableSolid& body, uint32_t piece, double least, BreakRun& run) {
    const Vec3d middle = middle_of(body, run);
    return part_piece(body, piece, {middle, to_farthest(body, run, middle)}, least, run);
}

uint32_t largest_piece(const BreakRun& run, uint32_t foreign) {
    uint32_t largest = foreign;
    for (uint32_t p = 0; p < run.piece_count; ++p)
        if (p != foreign && (largest == foreign || run.volume[p] > run.volume[largest])) largest = p;
    return largest;
}

}  // namespace

void part_body(const BreakableSolid& body, const Parting& parting, std::span<const uint8_t> own, BreakRun& run) {
    begin_pieces(body, own, run);
    const auto take = [&](uint32_t piece) {
        run.at_piece = piece;
        list_cells(run);
        return run.cell_count;
    };
    const Plane plane{parting.place, parting.normal};
    for (uint32_t piece = 0; piece < body.part_count; ++piece)
        if (take(piece) > 1) run.crack_count += part_piece(body, piece, plane, kLeastShare * run.volume[piece], run);
    const uint32_t foreign = own.empty() ? kNothing : body.part_count;
    for (uint32_t round = 1; round < parting.parts; ++round) {
        const uint32_t piece = largest_piece(run, foreign);
        if (take(piece) < kFewCells || !part_in_the_middle(body, piece, kLeastShare * run.volume[piece], run)) break;
        ++run.crack_count;
    }
    for (uint32_t piece = 0; piece < body.part_count && run.crack_count == 0; ++piece)
        if (take(piece) > 1) run.crack_count += part_in_the_middle(body, piece, 0, run);
}

}  // namespace cullet
