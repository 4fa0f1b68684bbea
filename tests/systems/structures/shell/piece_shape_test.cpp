#include "systems/structures/shell/piece_shape.hpp"
#include "components/state.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "engine/random.hpp"
#include "systems/hulls/fit_box.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/make_piece.hpp"
#include "systems/structures/shell/prism.hpp"
#include "tests/support/hull_gap.hpp"
#include "tests/support/sample_shells.hpp"

namespace cullet {
namespace {

Row<Structures> build(State& state, const SampleSurface& surface) {
    const auto built = build_shell(state, surface.source(), sample_material(state));
    EXPECT_TRUE(built.ok()) << built.error();
    return built.value();
}

void choose(const ShellView& shell) {
    choose_shape(shell, shell.points().first);
}

/// Pieces of the cut shell, with their shapes.
std::vector<Row<Structures>> pieces_of(State& state, Row<Structures> whole, const std::function<int(uint32_t)>& label) {
    const Row<Structures> cut = cut_by_label(state, whole, label);
    std::vector<FragmentPart> parts(200);
    parts.resize(group_fragments(ShellView(state, cut), parts));
    std::vector<Row<Structures>> pieces;
    for (const FragmentPart& part : parts) {
        pieces.push_back(make_piece(state, cut, part, 1));
        choose(ShellView(state, pieces.back()));
    }
    return pieces;
}

HullFaces core_of(const ShellView& shell) {
    std::vector<Vec3d> points;
    const uint32_t first = shell.points().first;
    for (uint32_t k = 0; k < shell.structures().shape_points[shell.structure]; ++k)
        points.push_back(Vec3d(shell.state.hull_points.point[first + k]));
    return hull_faces(points);
}

/// How far the drawn points lie outside of the one shape, grown by the margin, at most.
double left_out(const ShellView& shell) {
    const HullFaces core = core_of(shell);
    double most = -1e30;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        if (shell.state.vertices.element[row] == kNone) continue;
        for (const Vec3d p : {Vec3d(smoothed_place(shell.state, row)), smoothed_twin(shell.state, row)})
            most = std::max(most, hull_gap(core, p) - static_cast<double>(hull_margin(shell)));
    }
    return most;
}

float box_ratio(const ShellView& shell) {
    return shell.structures().box_ratio[shell.structure];
}
float hull_ratio(const ShellView& shell) {
    return shell.structures().hull_ratio[shell.structure];
}

TEST(PieceShape, ASlabGetsABoxOfItsOwnVolume) {
    State state;
    const ShellView slab(state, build(state, sample_grid(0.3, 0.2, 12, 8, 0.05)));
    choose(slab);
    EXPECT_EQ(shape_of(slab), ShapeKind::Box);
    EXPECT_EQ(state.structures.shape_points[slab.structure], 8);
    EXPECT_NEAR(box_ratio(slab), 1, 1e-4);
    EXPECT_NEAR(hull_ratio(slab), 1, 1e-4);
    EXPECT_FLOAT_EQ(hull_margin(slab), 0.001f);
    EXPECT_LT(left_out(slab), (std::sqrt(3.0) - 1) * 0.001 + 1e-6);
}

TEST(PieceShape, TheMarginIsAFifthOfTheLeastWidthAndAtMostAMillimetre) {
    EXPECT_FLOAT_EQ(margin_for(1), 0.001f);
    EXPECT_FLOAT_EQ(margin_for(0.003), 0.0006f);
    State state;
    const ShellView strip(state, build(state, sample_grid(0.05, 0.002, 25, 1, 0.004)));
    choose(strip);
    EXPECT_EQ(shape_of(strip), ShapeKind::Box);
    EXPECT_NEAR(hull_margin(strip), 0.0004, 1e-7);  // narrower than thick
}

TEST(PieceShape, AWedgeGetsAHull) {
    State state;
    SampleSurface surface = sample_grid(0.3, 0.2, 12, 8, 0.05);
    for (size_t v = 0; v < surface.depth.size(); ++v) surface.depth[v] = 0.005 + 0.15 * (surface.position[v].x + 0.15);
    const ShellView wedge(state, build(state, surface));
    choose(wedge);
    EXPECT_EQ(shape_of(wedge), ShapeKind::Hull);
    EXPECT_GT(box_ratio(wedge), 1.5f);
    EXPECT_NEAR(hull_ratio(wedge), 1, 1e-3);
    EXPECT_LT(left_out(wedge), static_cast<double>(hull_margin(wedge)));
}

TEST(PieceShape, ACurvedShardOfAVaseKeepsGroupsOfItsCells) {
    State state;
    const Row<Structures> vase = build(state, sample_vase(0.3, 0.005, 60, 50));
    uint32_t large = 0;
    for (const Row<Structures> row : pieces_of(state, vase, nearest_seed(ShellView(state, vase), 12, 1))) {
        const ShellView shard(state, row);
        if (shard.element_count() < 200) continue;
        ++large;
        EXPECT_EQ(shape_of(shard), ShapeKind::Cells) << hull_ratio(shard);
        EXPECT_GE(hull_ratio(shard), kMostHullRatio);
        EXPECT_GE(box_ratio(shard), hull_ratio(shard));
        EXPECT_EQ(state.structures.shape_points[row], 0);
    }
    EXPECT_GT(large, 4u);
}

TEST(PieceShape, APieceOfMoreElementsThanAreMeasuredKeepsItsCells) {
    State state;
    const ShellView sheet(state, build(state, sample_grid(0.5, 0.5, 33, 33, 0.01)));
    ASSERT_GT(sheet.element_count(), kMostWholeElements);
    choose(sheet);
    EXPECT_EQ(shape_of(sheet), ShapeKind::Cells);
    EXPECT_EQ(box_ratio(sheet), 0);
}

// Slabs of a wall and shards of a vase over several seeds: the rule holds, the ratio is the volume of the hull by brute
// force, and what is drawn lies outside of what collides by less than the margin.
TEST(PieceShape, WhatIsDrawnLiesWithinAMarginOfWhatCollides) {
    uint32_t counts[3] = {};
    double worst = 0;
    for (const uint64_t seed : {1, 2, 3, 4}) {
        State state;
        const Row<Structures> wall = build(state, sample_grid(2.4, 1.8, 31, 23, 0.1, 0.5)),
                              vase = build(state, sample_vase(0.3, 0.005, 60, 50));
        for (const Row<Structures> whole : {wall, vase})
            for (const Row<Structures> row : pieces_of(state, whole, nearest_seed(ShellView(state, whole), 60, seed))) {
                const ShellView piece(state, row);
                ++counts[state.structures.shape[row]];
                EXPECT_GE(box_ratio(piece), 0.999f * hull_ratio(piece));
                if (shape_of(piece) == ShapeKind::Cells) continue;
                EXPECT_LT(hull_ratio(piece), kMostHullRatio);
                EXPECT_EQ(shape_of(piece) == ShapeKind::Box, box_ratio(piece) < kMostBoxRatio);
                const double out = left_out(piece) / static_cast<double>(hull_margin(piece));
                EXPECT_LT(out, 1) << "of " << piece.element_count() << " elements";
                worst = std::max(worst, out);
            }
    }
    std::printf("%u groups of cells, %u hulls, %u boxes; %.2f margins outside at most\n", counts[0], counts[1],
                counts[2], worst);
    EXPECT_GT(counts[0], 50u);
    EXPECT_GT(counts[1], 50u);
}

TEST(FitBox, ATurnedBoxOfPointsIsFoundAsItIs) {
    ScratchMemory scratch;
    const Random random{3};
    for (uint32_t round = 0; round < 50; ++round) {
        const auto in = [&](uint32_t k) { return static_cast<float>(random.uniform(round, k)); };
        const Quat turn = normalised(Quat{in(0) - 0.5f, in(1) - 0.5f, in(2) - 0.5f, in(3) - 0.5f});
        const Vec3 half{0.01f + in(4), 0.01f + in(5), 0.01f + in(6)};
        std::vector<Vec3> points;
        for (int k = 0; k < 8; ++k)
            points.push_back(Vec3{5, -2, 1} + rotate(turn, {(k & 1 ? 1 : -1) * half.x, (k & 2 ? 1 : -1) * half.y,
                                                            (k & 4 ? 1 : -1) * half.z}));
        for (uint32_t k = 8; k < 60; ++k)
            points.push_back(Vec3{5, -2, 1} +
                             rotate(turn, {(2 * in(3 * k) - 1) * half.x, (2 * in(3 * k + 1) - 1) * half.y,
                                           (2 * in(3 * k + 2) - 1) * half.z}));
        ExtremePoints hull;
        choose_extremes(scratch, points, kMostHullPoints, 1e-5f, hull);
        const double volume = 8 * double{half.x} * double{half.y} * double{half.z};
        EXPECT_NEAR(hull_volume(points, hull), volume, 2e-3 * volume);
        EXPECT_NEAR(fit_box(points, hull).volume(), volume, 2e-3 * volume);
        EXPECT_NEAR(fit_box(points, hull).least_width(), 2 * std::min({half.x, half.y, half.z}), 1e-4);
    }
}

TEST(FitBox, HoldsAllPointsAndIsNoLessThanTheirHull) {
    ScratchMemory scratch;
    const Random random{7};
    for (uint32_t round = 0; round < 50; ++round) {
        std::vector<Vec3> points;
        for (uint32_t k = 0; k < 200; ++k)
            points.push_back({static_cast<float>(random.uniform(round, 3 * k)),
                              0.3f * static_cast<float>(random.uniform(round, 3 * k + 1)),
                              0.1f * static_cast<float>(random.uniform(round, 3 * k + 2))});
        ExtremePoints hull;
        choose_extremes(scratch, points, kMostHullPoints, 1e-4f, hull);
        const FittedBox box = fit_box(points, hull);
        EXPECT_GE(box.volume(), hull_volume(points, hull));
        for (const Vec3 p : points) {
            const Vec3d from = Vec3d(p) - box.centre;
            EXPECT_LE(std::fabs(dot(from, box.axis[0])), box.half.x + 1e-12);
            EXPECT_LE(std::fabs(dot(from, box.axis[1])), box.half.y + 1e-12);
            EXPECT_LE(std::fabs(dot(from, box.axis[2])), box.half.z + 1e-12);
        }
    }
}

TEST(FitBox, PointsInAPlaneHaveNoVolume) {
    ScratchMemory scratch;
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
    ExtremePoints hull;
    choose_extremes(scratch, points, kMostHullPoints, 1e-4f, hull);
    EXPECT_EQ(hull.face_count, 0u);
    EXPECT_EQ(hull_volume(points, hull), 0);
    EXPECT_EQ(fit_box(points, hull).volume(), 0);
}

}  // namespace
}  // namespace cullet
