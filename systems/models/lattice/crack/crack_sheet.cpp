#include "systems/models/lattice/crack/crack_sheet.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr double kShieldEdges = 1.5;
constexpr uint32_t kNoPart = 0xffffffffu;

bool parts_sides(const BreakableSolid& body, const BreakRun& run, uint32_t bond, uint32_t piece) {
    const SolidBond& b = body.solid.bonds[bond];
    return run.piece[b.a] == piece && run.piece[b.b] == piece && run.side[b.a] != run.side[b.b];
}

// How many bonds the sheet has; none where no bond is between the sides.
uint32_t flood_sheet(const BreakableSolid& body, BreakRun& run, uint32_t start) {
    const uint32_t piece = run.piece[start];
    const Vec3d middle = body.solid.cells[start].centroid;
    uint32_t first = kNoPart;
    double nearest = 1e300;
    for (uint32_t b = 0; b < body.solid.bonds.size(); ++b) {
        run.is_sheet[b] = 0;
        if (!parts_sides(body, run, b, piece)) continue;
        const Vec3d from = body.solid.bonds[b].centroid - middle;
        if (dot(from, from) < nearest) nearest = dot(from, from), first = b;
    }
    if (first == kNoPart) return 0;
    uint32_t count = 0;
    run.sheet[count++] = first, run.is_sheet[first] = 1;
    for (uint32_t i = 0; i < count; ++i)
        for (const uint32_t edge : body.paths.edges[run.sheet[i]])
            for (const uint32_t b : body.paths.at_edge(edge)) {
                if (run.is_sheet[b] || !parts_sides(body, run, b, piece)) continue;
                run.is_sheet[b] = 1;
                run.sheet[count++] = b;
            }
    return count;
}

// Numbers the parts of the piece that hang together over bonds outside of the sheet.
uint32_t flood_parts_of_piece(const BreakableSolid& body, BreakRun& run, uint32_t piece) {
    for (uint32_t i = 0; i < run.cell_count; ++i) run.part[run.cells[i]] = kNoPart;
    uint32_t parts = 0;
    for (uint32_t i = 0; i < run.cell_count; ++i) {
        if (run.piece[run.cells[i]] != piece || run.part[run.cells[i]] != kNoPart) continue;
        uint32_t open = 0;
        run.open[open++] = run.cells[i];
        run.part[run.cells[i]] = parts;
        double volume = 0;
        while (open > 0) {
            const uint32_t c = run.open[--open];
            volume += body.solid.cells[c].volume;
            for (const uint32_t b : body.paths.of_cell(c)) {
                const SolidBond& bond = body.solid.bonds[b];
                const uint32_t other = bond.a == c ? bond.b : bond.a;
                if (run.is_sheet[b] || run.piece[other] != piece || run.part[other] != kNoPart) continue;
                run.part[other] = parts;
                run.open[open++] = other;
            }
        }
        run.part_volume[parts++] = volume;
    }
    return parts;
}

double mean_cell(const BreakableSolid& body) {
    return body.solid.volume / static_cast<double>(body.solid.cells.size());
}

// A part that is too small goes to the one that it shares most area with; one beside nobody stays what it is, and its
// volume is marked by its sign.
void join_small_parts(const BreakableSolid& body, BreakRun& run, uint32_t piece, uint32_t parts, double least) {
    for (uint32_t rounds = 0; rounds < parts; ++rounds) {
        uint32_t small = kNoPart;
        for (uint32_t p = 0; p < parts; ++p)
            if (run.part_volume[p] > 0 && run.part_volume[p] < least &&
                (small == kNoPart || run.part_volume[p] < run.part_volume[small]))
                small = p;
        if (small == kNoPart) return;
        std::fill(run.part_area.begin(), run.part_area.begin() + parts, 0.0);
        for (uint32_t i = 0; i < run.cell_count; ++i) {
            const uint32_t c = run.cells[i];
            if (run.piece[c] != piece || run.part[c] != small) continue;
            for (const uint32_t b : body.paths.of_cell(c)) {
                const SolidBond& bond = body.solid.bonds[b];
                const uint32_t other = bond.a == c ? bond.b : bond.a;
                if (run.piece[other] == piece && run.part[other] != small) run.part_area[run.part[other]] += bond.area;
            }
        }
        uint32_t into = 0;
        for (uint32_t p = 1; p < parts; ++p)
            if (run.part_area[p] > run.part_area[into]) into = p;
        if (!(run.part_area[into] > 0)) {
            run.part_volume[small] = -run.part_volume[small];
            continue;
        }
        for (uint32_t i = 0; i < run.cell_count; ++i)
            if (run.piece[run.cells[i]] == piece && run.part[run.cells[i]] == small) run.part[run.cells[i]] = into;
        run.part_volume[into] += run.part_volume[small];
        run.part_volume[small] = 0;
    }
}

// The piece is what hangs together without these bonds.
bool take_bonds(const BreakableSolid& body, BreakRun& run, uint32_t piece, uint32_t bonds, double least) {
    if (bonds == 0) return false;
    const uint32_t parts = flood_parts_of_piece(body, run, piece);
    uint32_t large = 0;
    for (uint32_t p = 0; p < parts; ++p) large += run.part_volume[p] >= least;
    if (large < 2) return false;
    join_small_parts(body, run, piece, parts, least);
    uint32_t keeps = 0;
    for (uint32_t p = 1; p < parts; ++p)
        if (run.part_volume[p] > run.part_volume[keeps]) keeps = p;
    for (uint32_t p = 0; p < parts; ++p) {
        if (run.part_volume[p] == 0) continue;
        run.part_piece[p] = p == keeps ? piece : run.piece_count++;
        run.volume[run.part_piece[p]] = std::fabs(run.part_volume[p]);
    }
    for (uint32_t i = 0; i < run.cell_count; ++i) {
        const uint32_t c = run.cells[i];
        if (run.piece[c] == piece) run.piece[c] = run.part_piece[run.part[c]];
    }
    // Bonds whose ends stay together after all are none of the crack.
    uint32_t kept = 0;
    for (uint32_t i = 0; i < bonds; ++i) {
        const SolidBond& bond = body.solid.bonds[run.sheet[i]];
        if (run.piece[bond.a] != run.piece[bond.b]) run.sheet[kept++] = run.sheet[i];
    }
    run.sheet_count = kept;
    return true;
}

}  // namespace

bool break_sheet(const BreakableSolid& body, BreakRun& run, uint32_t start) {
    return take_bonds(body, run, run.piece[start], flood_sheet(body, run, start),
                      run.rules.least_cells * mean_cell(body));
}

bool break_sides(const BreakableSolid& body, BreakRun& run, uint32_t piece, double least) {
    uint32_t count = 0;
    for (uint32_t b = 0; b < body.solid.bonds.size(); ++b) {
        run.is_sheet[b] = parts_sides(body, run, b, piece);
        if (run.is_sheet[b]) run.sheet[count++] = b;
    }
    return take_bonds(body, run, piece, count, least);
}

void shield(const BreakableSolid& body, BreakRun& run, uint32_t start) {
    const Vec3d middle = body.solid.cells[start].centroid;
    double reach = 0;
    for (uint32_t i = 0; i < run.sheet_count; ++i)
        reach = std::max(reach, length(body.solid.bonds[run.sheet[i]].centroid - middle));
    const double away = run.rules.shield * reach + kShieldEdges * body.solid.lattice.edge;
    for (uint32_t i = 0; i < run.cell_count; ++i) {
        const uint32_t c = run.cells[i];
        if (!may_start(body, run, c)) continue;
        for (uint32_t s = 0; s < run.sheet_count && !(run.marks[c] & kBanned); ++s) {
            const Vec3d from = body.solid.bonds[run.sheet[s]].centroid - body.solid.cells[c].centroid;
            if (dot(from, from) < away * away) run.marks[c] |= kBanned;
        }
    }
}

}  // namespace cullet
