#include "systems/structures/shell/cell_hulls.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include "systems/structures/shell/make_piece.hpp"
#include "systems/structures/shell/prism.hpp"
#include "tests/support/hull_gap.hpp"
#include "tests/support/sample_shells.hpp"

namespace cullet {
namespace {

std::vector<HullFaces> hulls_of(const ShellView& shell) {
    const ShellRows& state = shell.state;
    const Range cells = state.structures.cells[shell.structure];
    std::vector<HullFaces> hulls;
    for (uint32_t c = cells.first; c < cells.first + cells.count; ++c) {
        uint32_t from = state.structures.points[shell.structure].first + state.cells.first_point[c];
        for (const uint8_t count : state.cells.part_points[c]) {
            std::vector<Vec3d> points;
            for (uint32_t i = 0; i < count; ++i) points.push_back(Vec3d(state.hull_points.point[from++]));
            if (!points.empty()) hulls.push_back(hull_faces(points));
        }
    }
    return hulls;
}

double volume_of(const HullFaces& hull, double margin) {
    double volume = 0;
    for (size_t f = 0; f < hull.triangles.size(); ++f) {
        const auto& [a, b, c] = hull.triangles[f];
        volume += dot(a - hull.triangles[0][0], cross(b - a, c - a)) / 6 *
                  (dot(cross(b - a, c - a), hull.normal[f]) > 0 ? 1 : -1);
        volume += margin * length(cross(b - a, c - a)) / 2;
    }
    return volume;
}

/// Sum of the hulls, grown by the margin (to first order: volume + margin * area), over the elements' volume.
double hull_over_solid(const ShellView& shell) {
    double hulls = 0, solid = 0;
    for (const HullFaces& hull : hulls_of(shell)) hulls += volume_of(hull, static_cast<double>(hull_margin(shell)));
    for (uint32_t e = 0; e < shell.element_count(); ++e) solid += prism_volume(load_prism(shell, e));
    return hulls / solid;
}

struct Fit {
    double left_out = 0, burial = 0;   // m, the worst
    uint32_t corners = 0, buried = 0;  // how many there are, and how many of them deeper than a millimetre
    void add(const Fit& other) {
        left_out = std::max(left_out, other.left_out);
        burial = std::max(burial, other.burial);
        corners += other.corners, buried += other.buried;
    }
};

/// How far the corners of the solid lie outside of the nearest hull grown by the margin, and how far below the surface
/// of a hull, along the shell's normal there.
Fit measure_fit(const ShellView& shell) {
    const std::vector<HullFaces> hulls = hulls_of(shell);
    const double margin = static_cast<double>(hull_margin(shell));
    Fit fit;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        if (shell.state.vertices.element[row] == kNone) continue;
        const Vec3d in = Vec3d(shell.state.vertices.inward[row]);
        for (const bool is_inner : {false, true}) {
            const Vec3d p = is_inner ? inner_twin(shell.state, row) : Vec3d(shell.state.vertices.rest[row]);
            const Vec3d out = is_inner ? in : -in;
            double gap = 1e30, burial = 0;
            for (const HullFaces& hull : hulls) {
                gap = std::min(gap, hull_gap(hull, p) - margin);
                if (plane_gap(hull, p) > margin) continue;
                double way = 1e30;
                for (size_t f = 0; f < hull.normal.size(); ++f)
                    if (const double rise = dot(hull.normal[f], out); rise > 1e-6)
                        way = std::min(way, (hull.height[f] + margin - dot(hull.normal[f], p)) / rise);
                burial = std::max(burial, way);
            }
            fit.add({gap, burial, 1, burial > 0.001});
        }
    }
    return fit;
}

Fit fit_of_pieces(State& state, Row<Structures> whole, int pieces, uint64_t seed) {
    const Row<Structures> shell = cut_by_label(state, whole, nearest_seed(ShellView(state, whole), pieces, seed));
    std::vector<FragmentPart> parts(200);
    parts.resize(group_fragments(ShellView(state, shell), parts));
    Fit fit;
    for (const FragmentPart& part : parts) fit.add(measure_fit(ShellView(state, make_piece(state, shell, part, 1))));
    std::printf("%zu pieces: %.2f mm left out, buried by %.2f mm, more than 1 mm %u of %u corners\n", parts.size(),
                1e3 * fit.left_out, 1e3 * fit.burial, fit.buried, fit.corners);
    return fit;
}

// Slabs of a broken wall, 0.1 m thick with cells of 0.5 m: a corner that their hulls lack goes that deep into the
// floor.
TEST(CellHulls, NoCornerOfABrokenWallsSlabsLiesAMillimetreOutsideOfTheirHulls) {
    State state;
    const auto built = build_shell(state, sample_grid(2.4, 1.8, 31, 23, 0.1, 0.5).source(), sample_material(state));
    for (const uint64_t seed : {1, 2, 3}) {
        const Fit fit = fit_of_pieces(state, built.value(), 12, seed);
        // A corner is pulled in along two or three ways at once: (sqrt 3 - 1) margins.
        EXPECT_LT(fit.left_out, 0.001);
        EXPECT_LT(fit.burial, 0.001);  // what is flat has no hollows
    }
}

// A hull spans the hollow of what is bent: what lies in it hovers. That is not bounded here.
TEST(CellHulls, NoCornerOfAVasesShardsLiesAMillimetreOutsideOfTheirHulls) {
    State state;
    const auto built = build_shell(state, sample_vase(0.3, 0.005, 60, 50).source(), sample_material(state));
    for (const uint64_t seed : {1, 2, 3}) EXPECT_LT(fit_of_pieces(state, built.value(), 40, seed).left_out, 0.001);
}

TEST(CellHulls, PointsOfASphereLieInsideOfItsWallByTheMargin) {
    State state;
    const auto built = build_shell(state, sample_sphere(0.2, 0.006, 4).source(), sample_material(state));
    const ShellView shell(state, built.value());
    const double margin = static_cast<double>(hull_margin(shell));
    EXPECT_NEAR(margin, 0.001, 1e-9);
    const Range points = state.structures.points[shell.structure];
    for (uint32_t i = points.first; i < points.first + points.count; ++i) {
        const double r = length(Vec3d(state.hull_points.point[i]));
        EXPECT_LE(r, 0.2 - margin + 1e-6);
        EXPECT_GE(r, 0.2 - 0.006 + margin - 1e-6);
    }
}

TEST(CellHulls, AFlatSheetsHullsAreHardlyLargerThanTheSheet) {
    State state;
    const auto built = build_shell(state, sample_grid(0.5, 0.5, 40, 40, 0.004, 0.3).source(), sample_material(state));
    const double ratio = hull_over_solid(ShellView(state, built.value()));
    std::printf("sheet: hull / solid %.2f\n", ratio);
    EXPECT_LT(ratio, 1.4);
}

TEST(CellHulls, HullsOfAVaseAndItsShardsAreTight) {
    State state;
    const auto built = build_shell(state, sample_vase(0.3, 0.005, 60, 50).source(), sample_material(state));
    const double whole = hull_over_solid(ShellView(state, built.value()));
    const Row<Structures> shell =
        cut_by_label(state, built.value(), nearest_seed(ShellView(state, built.value()), 15, 1));
    std::vector<FragmentPart> parts(100);
    parts.resize(group_fragments(ShellView(state, shell), parts));
    double worst = 0, sum = 0, mass = 0;
    for (const FragmentPart& part : parts) {
        const Row<Structures> piece = make_piece(state, shell, part, 1);
        const double ratio = hull_over_solid(ShellView(state, piece));
        if (part.element_count >= 12) worst = std::max(worst, ratio);
        sum += part.mass * ratio;
        mass += part.mass;
    }
    std::printf("vase: hull / solid %.2f whole, shards %.2f by mass, worst of 12 elements and more %.2f\n", whole,
                sum / mass, worst);
    EXPECT_LT(whole, 2.5);
    EXPECT_LT(sum / mass, 2.6);  // the note saw 2.1
}

}  // namespace
}  // namespace cullet
