// The direction a crack tip chooses, against the formula tried at every angle.
#include "systems/models/thick_shell/hidden/heading.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/random.hpp"

namespace cullet {
namespace {

const Vec3 kX{1, 0, 0}, kY{0, 1, 0};

TEST(ChooseHeading, IsTheLargestWeightedTensionAmongAllTwentyFiveDirectionsAndBothFaces) {
    const Random random{3};
    for (const float power : {2.0f, 6.0f, 30.0f}) {
        const HeadingFan fan(power);
        for (uint32_t i = 0; i < 300; ++i) {
            const auto draw = [&](uint32_t k) { return static_cast<float>(2e8 * random.uniform(i, k) - 1e8); };
            const FaceStress face[2] = {{draw(0), draw(1), draw(2)}, {draw(3), draw(4), draw(5)}};
            double best = 0;
            for (int k = -12; k <= 12; ++k)
                for (const FaceStress& t : face) {
                    const double s = std::sin(k * M_PI / 36), c = std::cos(k * M_PI / 36);
                    best = std::max(best, (s * s * t.xx + c * c * t.yy - 2 * s * c * t.xy) * std::pow(c, power));
                }
            const ChosenHeading chosen = choose_heading(fan, kX, kY, face);
            EXPECT_NEAR(chosen.stress, best, 2e2);
            if (chosen.stress > 0) {
                EXPECT_NEAR(length(chosen.direction), 1, 1e-6);
            }
        }
    }
}

TEST(ChooseHeading, PureTensionAcrossGoesStraightOnWithItsFullValue) {
    const FaceStress face[2] = {{0, 1e6f, 0}, {0, 1e6f, 0}};
    const ChosenHeading chosen = choose_heading(HeadingFan(6), kX, kY, face);
    EXPECT_TRUE(chosen.direction == kX);
    EXPECT_EQ(chosen.stress, 1e6f);
}

TEST(ChooseHeading, CompressionOpensNothing) {
    const FaceStress face[2] = {{-1e6f, -1e6f, 0}, {-2e6f, -1e6f, 0}};
    EXPECT_EQ(choose_heading(HeadingFan(6), kX, kY, face).stress, 0);
}

TEST(ChooseHeading, AHigherPowerTurnsLess) {
    // Tension at 45 degrees to the heading.
    const FaceStress face[2] = {{5e5f, 5e5f, -5e5f}, {}};
    float last = 0;
    for (const float power : {0.0f, 2.0f, 6.0f, 30.0f}) {
        const float along = choose_heading(HeadingFan(power), kX, kY, face).direction.x;
        EXPECT_GE(along, last);
        last = along;
    }
    EXPECT_GT(last, 0.98f);
}

TEST(ChooseHeading, OfTwoEqualTurnsThePositiveOneWins) {
    const FaceStress face[2] = {{1e6f, 0, 0}, {1e6f, 0, 0}};
    EXPECT_GT(choose_heading(HeadingFan(0), kX, kY, face).direction.y, 0);
}

TEST(InAxes, TurningThereAndBackGivesTheTensorAgain) {
    VertexStress s;
    s.normal = {0, 0, 1}, s.axis_x = kX, s.axis_y = kY;
    s.xx = 3, s.yy = -1, s.xy = 2;
    const FaceStress turned = in_axes(s, kY, -kX);
    EXPECT_EQ(turned.xx, -1);
    EXPECT_EQ(turned.yy, 3);
    EXPECT_EQ(turned.xy, -2);
}

}  // namespace
}  // namespace cullet
