// A ball that rolls over a flat panel feels no edge between its triangles, nor between the hulls that stand for them.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/systems/models/metal_shell/panels.hpp"

namespace cullet {
namespace {

struct Rolling {
    double low = 1e30, high = -1e30, way = 0, speed = 0;  // m, m/s at the end of a metre
    bool is_dented = false;
};

/// A steel ball of 0.1 m rolls along a clamped panel of 10 mm triangles, at `height` over its middle line.
Rolling roll(double z, float speed, double turn) {
    static const Model model = test::cook_metal(metal_sheet(1.8, 0.3, 180, 30));
    Settings settings = test::small_settings();
    settings.gravity = {0, -9.81f, 0};
    settings.threads = 1;
    Result<World> made = World::create(settings);
    EXPECT_TRUE(made.ok()) << made.error();
    World& world = *made;
    SpawnSettings spawn;
    const Box pins[] = {{{-1, -1, -1}, {-0.89f, 1, 1}},
                        {{0.89f, -1, -1}, {1, 1, 1}},
                        {{-1, -1, -1}, {1, -0.14f, 1}},
                        {{-1, 0.14f, -1}, {1, 1, 1}}};
    spawn.pins = pins, spawn.pin_count = 4;
    spawn.pose.position = {0, 1, 0};
    spawn.pose.orientation = {-0.70710678f, 0, 0, 0.70710678f};  // +z comes to +y
    const Result<BodyId> panel = world.spawn(*world.add_model(model), spawn);
    EXPECT_TRUE(panel.ok()) << panel.error();
    SphereSettings ball;
    ball.radius = 0.1f, ball.mass = 30;
    double sine = 0, cosine = 0;
    sine_cosine(turn, sine, cosine);
    const auto along = static_cast<float>(cosine), aside = static_cast<float>(sine);
    ball.pose.position = {-0.8f, 1.1f, static_cast<float>(z)};
    ball.motion.velocity = {speed * along, 0, speed * aside};
    ball.motion.angular_velocity = {10 * speed * aside, 0, -10 * speed * along};
    const Result<BodyId> id = world.add_sphere(ball);
    EXPECT_TRUE(id.ok()) << id.error();
    Rolling rolling;
    double first = 0;
    for (int frame = 0; frame < 400 && rolling.way < 1; ++frame) {
        world.step();
        const Vec3 at = world.pose(*id)->position;
        if (frame < 6) {  // until it has settled on the sheet
            first = double{at.x};
            continue;
        }
        rolling.way = (double{at.x} - first) / cosine;
        rolling.low = std::min(rolling.low, double{at.y}), rolling.high = std::max(rolling.high, double{at.y});
        rolling.speed = double{world.motion(*id)->velocity.x};
    }
    rolling.is_dented = test::deepest(world, *panel) > 0;
    return rolling;
}

TEST(RollingOnMetal, AMetreOverTenMillimetreTrianglesIsLevelToATenthOfAMillimetre) {
    for (const double z : {0.0, 0.013, -0.05})
        for (const float speed : {0.5f, 1.0f, 3.0f})
            for (const double turn : {0.0, 0.08}) {
                const Rolling rolling = roll(z, speed, turn);
                EXPECT_GE(rolling.way, 1) << z << ", " << speed;
                EXPECT_LT(rolling.high - rolling.low, 1e-4) << z << ", " << speed << ", turned " << turn;
                // What rolling friction of the ball itself takes: 0.0105 of its weight, over 1.4 times its mass.
                EXPECT_GT(rolling.speed, 0.98 * std::sqrt(double{speed} * double{speed} - 2 * 0.08))
                    << z << ", " << speed;
                EXPECT_FALSE(rolling.is_dented);
            }
}

}  // namespace
}  // namespace cullet
