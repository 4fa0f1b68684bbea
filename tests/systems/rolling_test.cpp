// Balls on slopes and floors, against the formula of a solid ball: (sin - c cos) g / 1.4 down a slope, c g / 1.4 lost
// on the level, where c is ContactSettings::rolling_friction.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

constexpr float kGravity = 9.81f, kRight = 1.5707963f;

struct Slope {
    World world;
    BodyId ball;
    Vec3 start;  // of its middle
};

// A sheet of 400 m square, tilted about z by so many degrees: it falls towards +x. The ball touches it in the middle.
Slope ball_on_slope(float degrees, float radius, float mass, const ContactSettings& of_ball,
                    const ContactSettings& of_slope = {}, float gravity = kGravity) {
    Settings settings = small_settings();
    settings.gravity = {0, -gravity, 0};
    Slope out{make_world(settings), {}, {}};
    const float angle = degrees / 90 * kRight, x = 200 * std::cos(angle), y = 200 * std::sin(angle);
    const Vec3 corners[] = {{-x, y, -150}, {-x, y, 250}, {x, -y, 250}, {x, -y, -150}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    EXPECT_TRUE(out.world.add_static({corners, 4, quad, 2}, of_slope).ok());
    SphereSettings ball;
    ball.radius = radius, ball.mass = mass, ball.contact = of_ball;
    ball.pose.position = {radius * std::sin(angle), radius * std::cos(angle), 0};
    out.start = ball.pose.position;
    out.ball = out.world.add_sphere(ball).value();
    return out;
}

float way_of(const Slope& s) {
    const Vec3 way = s.world.pose(s.ball).value().position - s.start;
    return std::sqrt(way.x * way.x + way.y * way.y);
}

void steps(World& world, int count) {
    for (int frame = 0; frame < count; ++frame) world.step();
}

ContactSettings rolling(float share) {
    ContactSettings contact;
    contact.rolling_friction = share;
    return contact;
}

TEST(Rolling, ABallGoesDownASlopeAsTheFormulaSaysWhateverItsSizeAndMass) {
    for (const float degrees : {0.5f, 2.0f, 5.0f, 15.0f})
        for (const float share : {-1.0f, 0.0f, 0.002f, 0.03f})
            for (const float radius : {0.01f, 0.1f, 1.0f}) {
                const float mass = 4000 * radius * radius * radius, angle = degrees / 90 * kRight;
                Slope s = ball_on_slope(degrees, radius, mass, rolling(share));
                const float c = share < 0 ? 0.01f : share, seconds = 3;
                const float pull = std::sin(angle) - c * std::cos(angle);
                steps(s.world, static_cast<int>(60 * seconds));
                const float expected = std::max(pull, 0.0f) * kGravity / 1.4f * 0.5f * seconds * seconds;
                EXPECT_NEAR(way_of(s), expected, 0.04f * expected + 0.1f * radius)
                    << degrees << " degrees, " << share << ", radius " << radius;
                EXPECT_EQ(s.world.is_asleep(s.ball).value(), pull <= 0) << degrees << ", " << share << ", " << radius;
            }
}

TEST(Rolling, ABallInWeakGravityRollsToo) {
    for (const float gravity : {0.02f, 0.3f, 25.0f}) {
        Slope s = ball_on_slope(5, 0.1f, 4, {}, {}, gravity);
        const float angle = 5.0f / 90 * kRight, pull = std::sin(angle) - 0.01f * std::cos(angle);
        steps(s.world, 600);
        EXPECT_NEAR(way_of(s) / (pull * gravity / 1.4f * 50), 1, 0.04f) << gravity;
    }
}

TEST(Rolling, OnTheLevelABallSlowsBySettingTimesGAndSleeps) {
    for (const float share : {0.002f, 0.02f, 0.1f}) {
        Slope s = ball_on_slope(0, 0.1f, 4, rolling(share));
        ASSERT_TRUE(s.world.set_motion(s.ball, {{1, 0, 0}, {0, 0, -10}}).ok());
        steps(s.world, 30);
        EXPECT_NEAR(s.world.motion(s.ball)->velocity.x, 1 - 0.5f * share * kGravity / 1.4f, 0.02f) << share;
    }
    Slope s = ball_on_slope(0, 0.1f, 4, rolling(0.1f));
    ASSERT_TRUE(s.world.set_motion(s.ball, {{1, 0, 0}, {0, 0, -10}}).ok());
    steps(s.world, 240);
    EXPECT_NEAR(way_of(s), 1.4f / (2 * 0.1f * kGravity), 0.05f);
    EXPECT_TRUE(s.world.is_asleep(s.ball).value());
}

TEST(Rolling, OfTwoSettingsTheLargerOneCounts) {
    for (const auto& [ball, floor] : {std::pair(0.05f, 0.01f), std::pair(0.01f, 0.05f), std::pair(-1.0f, 0.05f)}) {
        Slope s = ball_on_slope(0, 0.1f, 4, rolling(ball), rolling(floor));
        ASSERT_TRUE(s.world.set_motion(s.ball, {{1, 0, 0}, {0, 0, -10}}).ok());
        steps(s.world, 60);
        EXPECT_NEAR(s.world.motion(s.ball)->velocity.x, 1 - 0.05f * kGravity / 1.4f, 0.02f) << ball << ", " << floor;
    }
}

TEST(Rolling, ASettingAboveOneIsRefusedByItsName) {
    World world = make_world(small_settings());
    SphereSettings ball;
    ball.contact.rolling_friction = 2;
    const Result<BodyId> refused = world.add_sphere(ball);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().find("contact.rolling_friction is 2"), std::string::npos) << refused.error();
}

}  // namespace
}  // namespace cullet::test
