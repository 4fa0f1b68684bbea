// What a grain meets on its way, and where it is put that begins in something.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

constexpr float kRadius = 0.005f;

/// Static, 27 flush boxes of 0.2 m about the origin.
std::unique_ptr<RigidWorld> block() {
    auto world = make_bullet_world(4);
    RigidDescription d;
    d.kind = RigidKind::Static;
    const float half = 0.1f - d.margin;
    std::vector<std::vector<Vec3>> points;
    for (int k = 0; k < 27; ++k)
        points.push_back(
            box_points({half, half, half}, 0.2f * Vec3{real(k % 3 - 1), real(k / 3 % 3 - 1), real(k / 9 - 1)}));
    std::vector<ConvexPiece> pieces;
    for (const auto& piece : points) pieces.push_back({piece, static_cast<uint32_t>(pieces.size())});
    d.pieces = pieces;
    world->add(0, d);
    return world;
}

TEST(FirstTouch, AGrainDeepInAStaticBodyComesOutOfItsNearestOuterFace) {
    const auto world = block();
    for (const float depth : {0.003f, 0.02f, 0.05f}) {
        RigidTouch touch;
        const Vec3 from{0.01f, 0.3f - depth, 0.02f};
        ASSERT_TRUE(world->first_touch(from, from - Vec3{0, 0.01f, 0}, kStep, kRadius, 4 * kRadius, touch)) << depth;
        EXPECT_NEAR(touch.place.x, from.x, 1e-4f) << depth;
        EXPECT_NEAR(touch.place.y, 0.3f + kRadius, 1e-3f) << depth;
        EXPECT_NEAR(touch.place.z, from.z, 1e-4f) << depth;
    }
}

// All faces of the piece in the middle are covered: it has no way out.
TEST(FirstTouch, AGrainInAPieceThatOthersCoverOnAllSidesIsNotThrown) {
    const auto world = block();
    RigidTouch touch;
    const Vec3 from{0.01f, 0.02f, 0.03f};
    const bool is_met = world->first_touch(from, from - Vec3{0, 0.01f, 0}, kStep, kRadius, 4 * kRadius, touch);
    EXPECT_TRUE(!is_met || length(touch.place - from) < 0.5f) << touch.place.x << " " << touch.place.y;
}

/// Static, a roof of two triangles each side whose ridge runs along z at y = 0; its sides fall by `slope`.
std::unique_ptr<RigidWorld> roof(float slope) {
    auto world = make_bullet_world(4);
    const Vec3 corners[] = {{-1, -slope, -1}, {-1, -slope, 1}, {0, 0, -1}, {0, 0, 1}, {1, -slope, -1}, {1, -slope, 1}};
    const std::array<uint32_t, 3> triangles[] = {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}};
    world->add_static_triangles(0, corners, triangles, 0.5f, 0.1f, 1, 1);
    return world;
}

// Each side is pushed out along its own normal: between them there is a gap that becomes narrower downwards.
TEST(FirstTouch, AGrainThatFallsOnARidgeStopsAboveIt) {
    std::mt19937 engine(1);
    const auto within = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(engine() >> 8) / 0x1000000;
    };
    const std::unique_ptr<RigidWorld> roofs[] = {roof(0.8f), roof(0.05f)};
    for (int k = 0; k < 10000; ++k) {
        const float slope = k % 2 ? 0.05f : 0.8f;
        const RigidWorld& world = *roofs[k % 2];
        Vec3 place{within(-0.01f, 0.01f), within(0.006f, 0.03f), within(-0.5f, 0.5f)};
        const Vec3 way{within(-0.02f, 0.02f), -within(0.02f, 0.05f), within(-0.01f, 0.01f)};
        RigidTouch touch;
        bool is_met = false;
        for (int step = 0; step < 40 && !is_met && place.y > -0.1f; ++step) {
            is_met = world.first_touch(place, place + way, kStep, kRadius, 4 * kRadius, touch);
            place = is_met ? touch.place : place + way;
        }
        ASSERT_TRUE(is_met) << k;
        ASSERT_GT(place.y, -slope * std::fabs(place.x)) << k;
    }
}

}  // namespace
}  // namespace cullet
