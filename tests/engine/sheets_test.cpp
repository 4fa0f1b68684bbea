// Nothing falls through one sheet of triangles, however it is wound. CULLET_SHEET_PIECES in the environment asks for
// another number of pieces a rate; 20000 take a minute or two in Release.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "tests/engine/rigid_scenes.hpp"
#include "tests/support/pieces_on_sheets.hpp"

namespace cullet {
namespace {

ThrownPieces thrown_at(uint32_t steps_a_second) {
    const char* wanted = std::getenv("CULLET_SHEET_PIECES");
    const ThrownPieces thrown =
        throw_pieces(31, wanted ? static_cast<uint32_t>(std::atoi(wanted)) : 1500, steps_a_second);
    std::printf("%u steps a second: %u of %u pieces went through, at most %.4f m\n", steps_a_second, thrown.behind,
                thrown.pieces, static_cast<double>(thrown.farthest));
    return thrown;
}

/// A square of 40 m in the plane y = 0 in two triangles, each wound upwards or downwards.
std::unique_ptr<RigidWorld> sheet_world(bool is_first_up, bool is_second_up, bool one_sided = false) {
    auto world = make_bullet_world(8);
    world->set_gravity({0, -9.81f, 0});
    const Vec3 corners[] = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}};
    std::array<uint32_t, 3> triangles[] = {{0, 1, 2}, {0, 2, 3}};
    if (!is_first_up) std::swap(triangles[0][1], triangles[0][2]);
    if (!is_second_up) std::swap(triangles[1][1], triangles[1][2]);
    world->add_static_triangles(0, corners, triangles, 0.5f, 0, 1, ~0u, one_sided);
    return world;
}

void add_ball(RigidWorld& world, RigidId id, Vec3 at, Vec3 velocity = {}) {
    RigidDescription d;
    d.radius = 0.1f;
    d.mass = 1;
    d.inertia = {0.004, 0.004, 0.004};
    d.pose.position = at;
    d.motion.velocity = velocity;
    world.add(id, d);
}

float height_after(RigidWorld& world, RigidId id, int steps) {
    for (int k = 0; k < steps; ++k) step(world);
    return world.pose(id).position.y;
}

TEST(Sheets, AFloorBearsHoweverItsTrianglesAreWound) {
    for (const bool first : {false, true})
        for (const bool second : {false, true})
            for (const Vec3 at : {Vec3{5, 1, -5}, Vec3{-5, 1, 5}, Vec3{0, 1, 0}}) {
                const auto world = sheet_world(first, second);
                add_ball(*world, 1, at);
                EXPECT_NEAR(height_after(*world, 1, 150), 0.1f, 0.005f) << first << second << " at " << at.x;
            }
}

TEST(Sheets, ACeilingHoldsWhatComesFromBelow) {
    const auto world = sheet_world(true, false);
    add_ball(*world, 1, {1, -1, 0}, {0, 20, 0});
    for (int k = 0; k < 60; ++k) EXPECT_LT(height_after(*world, 1, 1), -0.09f);
}

TEST(Sheets, AOneSidedSheetBearsOnItsFrontAndLetsThroughFromBehind) {
    const auto above = sheet_world(true, true, true), below = sheet_world(true, true, true),
               upside_down = sheet_world(false, false, true);
    add_ball(*above, 1, {0, 1, 0});
    EXPECT_NEAR(height_after(*above, 1, 150), 0.1f, 0.005f);
    add_ball(*below, 1, {0, -1, 0}, {0, 10, 0});
    EXPECT_GT(height_after(*below, 1, 20), 0.3f);
    add_ball(*upside_down, 1, {0, 1, 0});
    EXPECT_LT(height_after(*upside_down, 1, 150), -1);
}

/// A flat square of 10 cm, 2 mm thick.
RigidDescription plate(std::vector<Vec3>& points, ConvexPiece& piece, float height) {
    points = box_points({0.05f, 0.0008f, 0.05f}, {});
    piece = {points, 0};
    RigidDescription d;
    d.pieces = {&piece, 1};
    d.margin = 0.0002f;
    d.mass = 0.05;
    d.inertia = {4e-5, 8e-5, 4e-5};
    d.pose.position = {0, height, 0};
    return d;
}

TEST(Sheets, WhatIsBornBehindASheetComesBackToTheSideOfItsParent) {
    const auto world = sheet_world(true, false);
    std::vector<Vec3> points;
    ConvexPiece piece;
    world->add(1, plate(points, piece, 0.0005f));
    RigidDescription child = plate(points, piece, -0.004f);
    child.parent = 1;
    world->add(2, child);
    EXPECT_GT(world->pose(2).position.y, 0);
    EXPECT_GT(height_after(*world, 2, 60), 0);
    const auto alone = sheet_world(true, false);
    alone->add(2, plate(points, piece, -0.004f));
    EXPECT_EQ(alone->pose(2).position.y, -0.004f) << "nothing says that it belongs above";
}

/// Five cubes of 10 cm in a row upwards, the middle of the lowest one at `low`; or a bridge over x = 0.
RigidDescription column(std::vector<std::vector<Vec3>>& cells, std::vector<ConvexPiece>& pieces, float low,
                        bool is_bridge) {
    cells.clear(), pieces.clear();
    for (int k = 0; k < 5; ++k) {
        const Vec3 upright{0, low + 0.1f * real(k), 0};
        const Vec3 bridge{0.1f * real(k - 2), k == 0 || k == 4 ? -0.1f : 0.06f, 0};
        cells.push_back(box_points({0.049f, 0.049f, 0.049f}, is_bridge ? bridge : upright));
    }
    for (const auto& cell : cells) pieces.push_back({cell, static_cast<uint32_t>(pieces.size())});
    RigidDescription d;
    d.pieces = pieces;
    d.mass = 5;
    d.inertia = {0.1, 0.1, 0.1};
    d.centre = {0, is_bridge ? -0.004 : double{low} + 0.2, 0};
    return d;
}

TEST(Sheets, WhatIsPutDownHalfThroughASheetComesToTheSideOfItsMiddle) {
    const auto world = sheet_world(false, true);
    std::vector<std::vector<Vec3>> cells;
    std::vector<ConvexPiece> pieces;
    world->add(1, column(cells, pieces, -0.12f, false));
    EXPECT_GE(world->pose(1).position.y, 0.119f);
    EXPECT_GT(height_after(*world, 1, 60), 0.12f);
}

TEST(Sheets, WhatReachesAroundTheEdgeOfASheetStaysWhereItIsPut) {
    auto world = make_bullet_world(8);
    const Vec3 corners[] = {{0, -2, -2}, {0, 0, -2}, {0, 0, 2}, {0, -2, 2}};
    const std::array<uint32_t, 3> triangles[] = {{0, 1, 2}, {0, 3, 2}};
    world->add_static_triangles(0, corners, triangles, 0.5f, 0, 1, ~0u);
    std::vector<std::vector<Vec3>> cells;
    std::vector<ConvexPiece> pieces;
    world->add(1, column(cells, pieces, 0, true));
    const Vec3 at = world->pose(1).position;
    EXPECT_EQ(at.x, 0);
    EXPECT_EQ(at.y, 0);
    for (int k = 0; k < 30; ++k) step(*world);
    EXPECT_LT(length(world->pose(1).position), 0.001f);
}

/// A table whose boards and legs are cut into boxes, and a level of one ground and one fence.
struct LaidTable {
    Vec3 half;  // of the table
    uint32_t boxes_a_leg = 1;
    float sunk = 0, fence_height = 0, fence_at = 0, turn = 0;
};

RigidDescription table_of(const LaidTable& table, std::vector<std::vector<Vec3>>& cells,
                          std::vector<ConvexPiece>& pieces) {
    cells.clear(), pieces.clear();
    const float thin = 0.025f, gap = 0.003f, tall = 2 * table.half.y - 2 * thin, box = tall / real(table.boxes_a_leg);
    cells.push_back(box_points({table.half.x, thin - gap, table.half.z}, {0, 2 * table.half.y - thin, 0}));
    for (int leg = 0; leg < 4; ++leg)
        for (uint32_t k = 0; k < table.boxes_a_leg; ++k) {
            const Vec3 at{(leg & 1 ? 1.0f : -1.0f) * (table.half.x - thin), (real(k) + 0.5f) * box,
                          (leg & 2 ? 1.0f : -1.0f) * (table.half.z - thin)};
            cells.push_back(box_points({thin - gap, 0.5f * box - gap, thin - gap}, at));
        }
    for (const auto& cell : cells) pieces.push_back({cell, static_cast<uint32_t>(pieces.size())});
    RigidDescription d;
    d.pieces = pieces;
    d.margin = gap;
    d.mass = 20;
    d.inertia = {3, 3, 3};
    d.centre = {0, 1.4 * static_cast<double>(table.half.y), 0};
    d.pose = {{0, -table.sunk, 0}, {0, std::sin(0.5f * table.turn), 0, std::cos(0.5f * table.turn)}};
    return d;
}

void add_fenced_ground(RigidWorld& world, const LaidTable& table, bool is_joined, bool is_apart) {
    const float x = table.fence_at, high = table.fence_height;
    const auto turned = [&](Vec3 p) {
        return rotate({0, std::sin(0.5f * table.turn), 0, std::cos(0.5f * table.turn)}, p);
    };
    std::vector<Vec3> corners{{-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}};
    std::vector<std::array<uint32_t, 3>> ground{{0, 1, 2}, {0, 2, 3}}, fence{{4, 5, 6}, {4, 6, 7}};
    if (is_joined) ground = {{0, 1, 5}, {0, 5, 4}, {5, 2, 3}, {5, 3, 4}};  // the fence stands on edges of the ground
    corners.insert(corners.end(), {{x, 0, -3}, {x, 0, 3}, {x, high, 3}, {x, high, -3}});
    for (Vec3& corner : corners) corner = turned(corner);
    if (is_apart)
        world.add_static_triangles(1, corners, fence, 0.5f, 0, 1, ~0u);
    else
        ground.insert(ground.end(), fence.begin(), fence.end());
    world.add_static_triangles(0, corners, ground, 0.5f, 0, 1, ~0u);
}

TEST(Sheets, ATableThatIsPutDownTooDeepOverAFenceRisesAndDoesNotGoAside) {
    std::mt19937 random(5);
    const auto between = [&](float low, float high) { return low + (high - low) * real(random() % 10000) / 10000; };
    for (int k = 0; k < 300; ++k) {
        LaidTable table{{between(0.3f, 1), between(0.2f, 0.6f), between(0.3f, 1)}, 1 + k % 5 * 2u};
        table.sunk = between(0.01f, 0.6f) * table.half.y;
        table.fence_height = between(0.05f, 0.9f) * (2 * table.half.y - 0.05f - table.sunk);
        table.fence_at = between(-0.9f, 0.9f) * (table.half.x - 0.06f);
        table.turn = between(-3, 3);
        auto world = make_bullet_world(8);
        add_fenced_ground(*world, table, k % 3 == 0, k % 3 == 1);
        std::vector<std::vector<Vec3>> cells;
        std::vector<ConvexPiece> pieces;
        world->add(2, table_of(table, cells, pieces));
        const Vec3 at = world->pose(2).position;
        ASSERT_LT(std::hypot(at.x, at.z), 1e-5f) << k;
        ASSERT_GE(at.y, -table.sunk - 1e-6f) << k;
        ASSERT_LT(at.y, 0.001f) << k;
        const float first_middle = 0.5f * (2 * table.half.y - 0.05f) / real(table.boxes_a_leg);
        ASSERT_GE(at.y + first_middle, 0) << k;
    }
}

TEST(Sheets, TrianglesWithoutAreaAndRepeatedOnesAreCounted) {
    auto world = make_bullet_world(8);
    const Vec3 corners[] = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {0, 0, 0}};
    const std::array<uint32_t, 3> triangles[] = {{0, 1, 2}, {0, 4, 2}, {0, 2, 3}, {2, 1, 0}, {3, 3, 1}};
    world->add_static_triangles(0, corners, triangles, 0.5f, 0, 1, ~0u);
    EXPECT_EQ(world->left_out(0).count, 3u);
    EXPECT_EQ(world->left_out(0).first, 1u);
}

TEST(Sheets, NoPieceGoesThroughASheetAtSixtyStepsASecond) {
    EXPECT_EQ(thrown_at(60).behind, 0u);
}

TEST(Sheets, NoPieceGoesThroughASheetAtAHundredAndTwentyStepsASecond) {
    EXPECT_EQ(thrown_at(120).behind, 0u);
}

TEST(Sheets, NoPieceGoesThroughASheetAtThirtyStepsASecond) {
    EXPECT_EQ(thrown_at(30).behind, 0u);
}

TEST(Sheets, NoPieceGoesThroughASheetAtTwentyStepsASecond) {
    EXPECT_EQ(thrown_at(20).behind, 0u);
}

}  // namespace
}  // namespace cullet
