// Faces found ahead, copied or turned where they stand are as good as those that add() finds.
#include <gtest/gtest.h>

#include "engine/rigid_world.hpp"
#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

constexpr Vec3 kHalf{0.05f, 0.03f, 0.04f};

/// A box, dropped from a hand's height.
RigidDescription box(std::span<const ConvexPiece> pieces) {
    RigidDescription d;
    d.pieces = pieces;
    d.mass = 1;
    d.restitution = 0;
    const double x = kHalf.x * kHalf.x, y = kHalf.y * kHalf.y, z = kHalf.z * kHalf.z;
    d.inertia = {(y + z) / 3, (x + z) / 3, (x + y) / 3};
    d.pose = {{0, 0.1f, 0}, {}};
    return d;
}

/// Of a second box that falls on the first, which only the faces of both can bear.
float height_at_rest(RigidWorld& world) {
    for (int k = 0; k < 120; ++k) step(world);
    add_box(world, 2, {0.01f, 3.1f * kHalf.y, 0.01f}, kHalf, 1000);
    for (int k = 0; k < 120; ++k) step(world);
    return world.pose(2).position.y;
}

std::vector<Vec3> pulled_in() {
    const float m = RigidDescription{}.margin;
    return box_points(kHalf - Vec3{m, m, m}, {});
}

TEST(RigidShapes, OneMadeAheadBearsItsBodyAsTheOneThatAddMakes) {
    const std::vector<Vec3> points = pulled_in();
    ConvexPiece piece{points, 0};
    const auto plain = floor_world(4), ahead = floor_world(4);
    plain->add(1, box({&piece, 1}));
    ahead->reserve_shapes(2);
    ahead->make_shape(1, points);
    piece.shape = 1;
    ahead->add(1, box({&piece, 1}));
    const float expected = height_at_rest(*plain);
    EXPECT_NEAR(expected, 3 * kHalf.y, 0.001f);
    EXPECT_NEAR(height_at_rest(*ahead), expected, 1e-5f);
}

TEST(RigidShapes, PointsInsideOfAShapeMadeAheadAreLeftOut) {
    std::vector<Vec3> points = pulled_in();
    points.push_back({});
    ConvexPiece piece{points, 0};
    piece.shape = 0;
    const auto world = floor_world(4);
    world->reserve_shapes(1);
    world->make_shape(0, points);
    world->add(1, box({&piece, 1}));
    EXPECT_NEAR(height_at_rest(*world), 3 * kHalf.y, 0.001f);
}

TEST(RigidShapes, ABodyWhosePiecesStayWhenItsShapeChangesStillStandsOnThem) {
    const std::vector<Vec3> points = pulled_in();
    ConvexPiece piece{points, 0};
    const auto plain = floor_world(4), world = floor_world(4);
    const RigidDescription d = box({&piece, 1});
    plain->add(1, d);
    world->add(1, d);
    piece.same_body = 1;
    world->set_shape(1, d.mass, d.centre, d.inertia, {&piece, 1});
    EXPECT_NEAR(height_at_rest(*world), height_at_rest(*plain), 1e-5f);
}

TEST(RigidShapes, ShapesThatNoPieceTookAreForgotten) {
    const std::vector<Vec3> points = pulled_in();
    const auto world = floor_world(4);
    for (int k = 0; k < 1000; ++k) {
        world->reserve_shapes(64);
        world->make_shape(63, points);
    }
    ConvexPiece piece{points, 0};
    piece.shape = 64;  // never reserved: add() finds the faces
    world->add(1, box({&piece, 1}));
    EXPECT_NEAR(height_at_rest(*world), 3 * kHalf.y, 0.001f);
}

}  // namespace
}  // namespace cullet
