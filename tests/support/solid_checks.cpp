#include "tests/support/solid_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "engine/random.hpp"
#include "engine/table.hpp"
#include "systems/structures/tetrahedra/cook/cut_work.hpp"
#include "systems/structures/tetrahedra/cook/merge_cells.hpp"

namespace cullet::test {
namespace {

/// Directed edges, each with how often it goes that way more than back.
class EdgeSums {
 public:
    void add(std::span<const CutKey> keys, bool is_reversed) {
        for (size_t k = 0; k < keys.size(); ++k) {
            const CutKey a = keys[k], b = keys[(k + 1) % keys.size()];
            list_.push_back(a < b ? Edge{a, b, is_reversed ? -1 : 1} : Edge{b, a, is_reversed ? 1 : -1});
        }
    }
    template <class Visit>
    void for_each_odd(Visit visit) {
        std::sort(list_.begin(), list_.end(),
                  [](const Edge& p, const Edge& q) { return p.a == q.a ? p.b < q.b : p.a < q.a; });
        for (size_t i = 0, end; i < list_.size(); i = end) {
            int32_t sum = 0;
            for (end = i; end < list_.size() && list_[end].a == list_[i].a && list_[end].b == list_[i].b; ++end)
                sum += list_[end].way;
            if (sum != 0) visit(list_[i].a, list_[i].b);
        }
        list_.clear();
    }
    uint32_t odd() {
        uint32_t count = 0;
        for_each_odd([&](CutKey, CutKey) { ++count; });
        return count;
    }

 private:
    struct Edge {
        CutKey a, b;
        int32_t way;
    };
    std::vector<Edge> list_;
};

struct Looked {
    const CookedSolid& cooked;
    const CutRequest& request;
    const Cut& cut;
    const CutCells& raw;
    const std::vector<uint32_t>& merged;
    std::span<const CutKey> keys(const CutPolygon& p) const { return {cut.keys.data() + p.first, p.count}; }
    std::span<const CutKey> keys(const CutLoop& l) const { return {cut.keys.data() + l.first, l.count}; }
    std::span<const Vec3d> places(uint32_t first, uint32_t count) const { return {cut.places.data() + first, count}; }
};

void check_tetrahedra(const Looked& look, SolidReport& report) {
    std::vector<EdgeSums> sums(look.cooked.solid.lattice.fine.size());
    for (const CutPolygon& p : look.cut.polygons) sums[p.tetrahedron].add(look.keys(p), false);
    for (const CutLoop& loop : look.cut.loops)
        for (uint32_t side = 0; side < 2; ++side)
            if (const uint32_t t = look.cooked.faces.faces[loop.face].tetrahedron[side]; t != kNone)
                sums[t].add(look.keys(loop), side == 1);
    for (EdgeSums& s : sums) report.open_cells += s.odd() != 0;
}

void check_triangles(const Looked& look, SolidReport& report) {
    const ClosedMesh& mesh = look.cooked.mesh;
    EdgeSums sums;
    for (size_t i = 0, end; i < look.cut.polygons.size(); i = end) {
        const uint32_t t = look.cut.polygons[i].triangle;
        for (end = i; end < look.cut.polygons.size() && look.cut.polygons[end].triangle == t; ++end)
            sums.add(look.keys(look.cut.polygons[end]), false);
        bool is_open = false;
        // What is left lies on a side: its ends are the side's, or points on it.
        sums.for_each_odd([&](CutKey a, CutKey b) {
            bool is_on_side = false;
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
                const auto is_on = [&](CutKey key) {
                    return (key.kind() == CutKeyKind::OnPair && key.a() == mesh.sides[t][k]) ||
                           (key.kind() == CutKeyKind::MeshVertex && (key.a() == from || key.a() == to));
                };
                is_on_side = is_on_side || (is_on(a) && is_on(b));
            }
            is_open = is_open || !is_on_side;
        });
        report.open_triangles += is_open;
    }
}

void check_rim(const Looked& look, SolidReport& report) {
    std::vector<uint8_t> is_rim(look.cooked.solid.lattice.points.size());
    for (const LatticeFace& face : look.cooked.faces.faces)
        if (face.tetrahedron[1] == kNone)
            for (const uint32_t p : face.corner) is_rim[p] = 1;
    for (uint32_t p = 0; p < is_rim.size(); ++p) report.bad_windings += is_rim[p] && !look.cut.windings.of(p).empty();
    report.bad_windings += !are_consistent(look.request, look.cut);
    for (const SolidCell& cell : look.cooked.solid.cells)
        for (const uint32_t p : look.cooked.solid.lattice.fine[cell.tetrahedron]) report.rim_cells += is_rim[p];
}

void check_rows(const Solid& solid, size_t triangle_count, SolidReport& report) {
    const auto is_number = [](Vec3d p) { return std::isfinite(p.x + p.y + p.z); };
    for (const SolidCell& cell : solid.cells)
        report.bad_rows +=
            !(cell.volume > 0) || !is_number(cell.centroid) || cell.tetrahedron >= solid.lattice.fine.size();
    for (size_t i = 0; i < solid.moments.size(); ++i) {
        const CellMoments& m = solid.moments[i];
        report.bad_rows += m.cell >= solid.cells.size() || m.coarse >= solid.lattice.coarse.size();
        if (i > 0) {
            const CellMoments& l = solid.moments[i - 1];
            report.bad_rows += std::pair(l.cell, l.coarse) >= std::pair(m.cell, m.coarse);
        }
    }
    for (size_t i = 0; i < solid.bonds.size(); ++i) {
        const SolidBond& b = solid.bonds[i];
        report.bad_rows += b.a >= b.b || b.b >= solid.cells.size() || !(b.area > 0) || !is_number(b.centroid) ||
                           std::fabs(length(b.normal) - 1) > 1e-12;
        if (i > 0) report.bad_rows += std::pair(solid.bonds[i - 1].a, solid.bonds[i - 1].b) > std::pair(b.a, b.b);
    }
    for (size_t i = 0; i < solid.patches.size(); ++i) {
        const SurfacePatch& p = solid.patches[i];
        report.bad_rows += p.triangle >= triangle_count || p.cell >= solid.cells.size() || !(p.area > 0);
        if (i > 0)
            report.bad_rows +=
                std::pair(solid.patches[i - 1].triangle, solid.patches[i - 1].cell) >= std::pair(p.triangle, p.cell);
    }
}

void check_sums(const Solid& solid, SolidReport& report) {
    double volume = 0, area = 0, moments = 0;
    for (const SolidCell& cell : solid.cells) volume += cell.volume;
    for (const SurfacePatch& patch : solid.patches) area += patch.area;
    for (const CellMoments& row : solid.moments) {
        const Moments& m = row.moments;
        moments += m[0] + m[4] + m[7] + m[9] + 2 * (m[1] + m[2] + m[3] + m[5] + m[6] + m[8]);
    }
    report.volume_error = std::fabs(volume / solid.volume - 1);
    report.area_error = std::fabs(area / solid.area - 1);
    report.moment_error = std::fabs(moments / solid.volume - 1);
}

// Pieces of any labelling: the triangles' polygons, and the faces between two labels from both sides.
void check_labels(const Looked& look, const std::vector<uint32_t>& label_of, SolidReport& report) {
    const auto label = [&](uint32_t raw) { return label_of[look.merged[raw]]; };
    std::map<uint32_t, EdgeSums> edges;
    std::map<uint32_t, VolumeSums> volumes;
    std::map<uint32_t, double> wanted;
    for (uint32_t i = 0; i < look.cut.polygons.size(); ++i) {
        const CutPolygon& p = look.cut.polygons[i];
        const uint32_t of = label(look.raw.of_polygon[i]);
        edges[of].add(look.keys(p), false);
        add_fan(look.places(p.first, p.count), look.cooked.mesh.low, 1, volumes[of]);
    }
    for (uint32_t i = 0; i < look.cut.loops.size(); ++i) {
        const CutLoop& loop = look.cut.loops[i];
        const uint32_t a = label(look.raw.of_loop[i][0]), b = label(look.raw.of_loop[i][1]);
        if (a == b) continue;
        edges[a].add(look.keys(loop), false);
        edges[b].add(look.keys(loop), true);
        add_fan(look.places(loop.first, loop.count), look.cooked.mesh.low, 1, volumes[a]);
        add_fan(look.places(loop.first, loop.count), look.cooked.mesh.low, -1, volumes[b]);
    }
    const Solid& solid = look.cooked.solid;
    for (uint32_t c = 0; c < solid.cells.size(); ++c) wanted[label_of[c]] += solid.cells[c].volume;
    for (auto& [of, sums] : edges) report.odd_edges += sums.odd();
    for (const auto& [of, volume] : wanted)
        report.piece_error = std::max(report.piece_error, std::fabs(volumes[of].volume - volume) / solid.volume);
}

void check_pieces(const Looked& look, SolidReport& report) {
    const std::vector<SolidCell>& cells = look.cooked.solid.cells;
    const Random random{5};
    std::vector<uint32_t> halves, voronoi, any;
    std::vector<Vec3d> seeds;
    for (uint32_t k = 0; k < 12; ++k) seeds.push_back(cells[random.bits(k) % cells.size()].centroid);
    const Vec3d middle = 0.5 * (look.cooked.mesh.low + look.cooked.mesh.high);
    for (uint32_t c = 0; c < cells.size(); ++c) {
        halves.push_back(cells[c].centroid.x > middle.x);
        uint32_t nearest = 0;
        for (uint32_t k = 1; k < seeds.size(); ++k)
            if (length(cells[c].centroid - seeds[k]) < length(cells[c].centroid - seeds[nearest])) nearest = k;
        voronoi.push_back(nearest);
        any.push_back(static_cast<uint32_t>(random.bits(1, c) % 12));
    }
    for (const auto& labels : {std::vector<uint32_t>(cells.size()), halves, voronoi, any})
        check_labels(look, labels, report);
}

}  // namespace

bool SolidReport::is_sound() const {
    return volume_error < 1e-5 && area_error < 1e-9 && moment_error < 1e-5 && open_cells == 0 && open_triangles == 0 &&
           bad_windings == 0 && rim_cells == 0 && bad_rows == 0 && odd_edges == 0 && piece_error < 1e-5;
}

std::ostream& operator<<(std::ostream& out, const SolidReport& r) {
    return out << "errors of volume " << r.volume_error << ", area " << r.area_error << ", moments " << r.moment_error
               << ", pieces " << r.piece_error << "; open cells " << r.open_cells << ", open triangles "
               << r.open_triangles << ", bad windings " << r.bad_windings << ", rim cells " << r.rim_cells
               << ", bad rows " << r.bad_rows << ", odd edges " << r.odd_edges;
}

SolidReport check_solid(const CookedSolid& cooked, double merge_below) {
    const CutRequest request{cooked.mesh, cooked.solid.lattice, cooked.faces};
    SolidReport report;
    const Result<Cut> cut = cut_mesh(request);
    if (!cut) {
        ADD_FAILURE() << cut.error();
        report.bad_rows = 1;
        return report;
    }
    const CutCells raw = find_cells(request, *cut);
    Solid again;
    MergeSettings merging;
    merging.least_share = merge_below;
    std::vector<uint32_t> merged;
    merge_cells(request, *cut, raw, merging, again, merged);
    EXPECT_EQ(again.cells.size(), cooked.solid.cells.size());
    const Looked look{cooked, request, *cut, raw, merged};
    check_tetrahedra(look, report);
    check_triangles(look, report);
    check_rim(look, report);
    check_rows(cooked.solid, cooked.mesh.triangles.size(), report);
    check_sums(cooked.solid, report);
    check_pieces(look, report);
    return report;
}

}  // namespace cullet::test
