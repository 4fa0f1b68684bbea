// What a grain meets on its way, and where it is put that begins in something.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace cullet
