#include "systems/structures/tetrahedra/cook/cook_solid.hpp"

#include <cmath>
#include <cstdio>

#include "systems/structures/tetrahedra/cook/cover_lattice.hpp"
#include "systems/structures/tetrahedra/cook/crack_region.hpp"
#include "systems/structures/tetrahedra/cook/merge_cells.hpp"

namespace cullet {
namespace {

constexpr double kWidestCell = 4;  // thicknesses: quadratic elements bend as they must up to there

constexpr double kMostOver = 1.2;  // of the wanted cells

// A wall of few cells is cut into more of them than its volume has room for: measured on spheres, bowls, plates and
// ropes, within a tenth.
double cells_of(double volume, double thickness, double edge) {
    const double wide = edge / thickness;
    return 12 * volume / (edge * edge * edge) * (1 + 0.15 * wide + 0.055 * wide * wide);
}

// The edge that the volume asks for, and a larger one where that makes too many cells. Halved in shares of the first:
// the same for a mesh scaled by a power of two.
double edge_of(double volume, double thickness, double cells) {
    const double edge = edge_for(volume, cells);
    if (cells_of(volume, thickness, edge) <= kMostOver * cells) return edge;
    double low = 1, high = 4;
    for (int step = 0; step < 20; ++step) {
        const double middle = 0.5 * (low + high);
        (cells_of(volume, thickness, middle * edge) > kMostOver * cells ? low : high) = middle;
    }
    return high * edge;
}

std::string text_of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

}  // namespace

Result<CookedSolid> cook_solid(const Mesh& given, const SolidSettings& settings) {
    ClosingSettings closing;
    closing.weld_tolerance = settings.weld_tolerance;
    closing.largest_filled = settings.largest_filled;
    Result<ClosedMesh> closed = close_mesh(given, closing);
    if (!closed) return Error{closed.error()};
    const std::string name = given.name.empty() ? "mesh" : "\"" + given.name + "\"";
    CookedSolid cooked;
    cooked.mesh = std::move(closed).value();
    cooked.notes = describe(cooked.mesh);
    const ClosedMesh& mesh = cooked.mesh;
    Solid& solid = cooked.solid;
    solid.volume = mesh.volume, solid.area = mesh.area, solid.thickness = 2 * mesh.volume / mesh.area;

    const double widest = kWidestCell * solid.thickness;
    CoverSettings wanted;
    wanted.edge = edge_of(mesh.volume, solid.thickness, settings.cells);
    wanted.element_edges = settings.element_edges;
    wanted.jitter = settings.jitter;
    if (wanted.edge > widest) {
        const double needed = cells_of(mesh.volume, solid.thickness, widest);
        if (!(needed <= settings.most_cells))
            return Error{
                name + " is " + text_of(solid.thickness) + " m thick and " + text_of(length(mesh.high - mesh.low)) +
                " m long: a solid of it needs " + std::to_string(std::llround(needed)) + " cells, above the limit of " +
                std::to_string(std::llround(settings.most_cells)) + ". Use thick_shell, or raise lattice.most_cells."};
        wanted.edge = widest;
    }
    Result<CoverLattice> lattice = cover_lattice(mesh, wanted);
    if (!lattice) return Error{name + ": " + lattice.error() + "."};
    solid.lattice = std::move(lattice).value();
    cooked.faces = number_faces(solid.lattice);

    const CutRequest request{mesh, solid.lattice, cooked.faces};
    Result<Cut> cut = cut_mesh(request);
    if (!cut) return Error{name + ": " + cut.error() + "."};
    const CutCells raw = find_cells(request, *cut);
    MergeSettings merging;
    merging.least_share = settings.merge_below;
    std::vector<uint32_t> merged;
    merge_cells(request, *cut, raw, merging, solid, merged);
    for (uint32_t c = 0; c < raw.cells.size(); ++c) {
        const CutCell& part = raw.cells[c];
        const double volume = part.sums.volume > 0 ? part.sums.volume : 1;
        cooked.raw.push_back(
            {part.tetrahedron, merged[c], raw.middles[part.tetrahedron] + (1 / volume) * part.sums.first});
    }
    cooked.owner_of_empty = owners_of_empty(cooked);
    cooked.windings = std::move(cut->windings);
    cooked.tetrahedron_of = std::move(cut->tetrahedron_of);
    return cooked;
}

}  // namespace cullet
