// How high things of metal bounce, and that a shorter step changes no dent.
#include <gtest/gtest.h>

#include "tests/systems/models/metal_shell/panels.hpp"

namespace cullet {
namespace {

template <class T>
T value_of(Result<T> result) {
    if (!result) ADD_FAILURE() << result.error(), std::abort();
    return std::move(result).value();
}

Settings settings_of(float steps_a_second) {
    Settings settings = test::small_settings();
    settings.gravity = {};
    settings.step_seconds = 1 / steps_a_second;
    return settings;
}

struct Fall {
    double rebound = 0;  // m/s
    double deep = 0;     // m
};
/// A box falls flat onto a plate that gives back as much as it does.
Fall fall_of_box(const std::string& material, double restitution, float speed, float steps_a_second = 60) {
    const Model model = test::cook_metal(test::box_mesh({0.3, 0.3, 0.3}, 12), 1e-3f, material);
    World world = test::make_world(settings_of(steps_a_second));
    const Vec3 corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    ContactSettings plate;
    plate.restitution = static_cast<float>(restitution);
    EXPECT_TRUE(world.add_static({corners, 4, quad, 2}, plate).ok());
    SpawnSettings settings;
    settings.pose.position = {0, 0.05f, 0};
    settings.motion.velocity = {0, -speed, 0};
    const BodyId box = value_of(world.spawn(value_of(world.add_model(model)), settings));
    for (int n = 0; n < static_cast<int>(steps_a_second / 4); ++n) world.step();
    return {double{value_of(world.motion(box)).velocity.y}, test::deepest(world, box)};
}

double dent_of_ball(float steps_a_second) {
    static const Model model = test::cook_metal(metal_sheet(1.2, 0.8, 60, 40));
    constexpr float kX = 0.6f, kY = 0.4f, kRim = 0.01f, kOut = 1;
    const Box pins[] = {{{-kOut, -kOut, -kOut}, {-kX + kRim, kOut, kOut}},
                        {{kX - kRim, -kOut, -kOut}, {kOut, kOut, kOut}},
                        {{-kOut, -kOut, -kOut}, {kOut, -kY + kRim, kOut}},
                        {{-kOut, kY - kRim, -kOut}, {kOut, kOut, kOut}}};
    World world = test::make_world(settings_of(steps_a_second));
    SpawnSettings settings;
    settings.pose.position = {0, 1, 0};
    settings.pins = pins, settings.pin_count = 4;
    const BodyId sheet = value_of(world.spawn(value_of(world.add_model(model)), settings));
    EXPECT_TRUE(world.add_sphere(test::ball_at({0.1f, 1, 0}, 100, 5, 0.145f)).ok());
    for (int n = 0; n < static_cast<int>(steps_a_second / 2); ++n) world.step();
    return test::deepest(world, sheet);
}

// From H on a fixed plate a body comes back to e^2 H.
TEST(MetalBounce, SteelAluminiumAndCopperComeBackToTheSquareOfTheirRestitution) {
    for (const auto& [material, e] : {std::pair{"steel", 0.2}, {"aluminium", 0.15}, {"copper", 0.1}})
        for (const float speed : {8.0f, 14.0f}) {
            const Fall fall = fall_of_box(material, e, speed);
            EXPECT_GT(fall.deep, 0.001) << material << ", " << speed;
            const double share = fall.rebound * fall.rebound / (e * e * double{speed} * double{speed});
            EXPECT_NEAR(share, 1, 0.05) << material << ", " << speed << " m/s, " << fall.rebound;
        }
}

TEST(MetalBounce, HalfTheStepGivesTheSameDepth) {
    for (const float steps : {60.0f, 30.0f}) {
        const double ball = dent_of_ball(steps), box = fall_of_box("steel", 0.2, 12, steps).deep;
        EXPECT_GT(ball, 0.03);
        EXPECT_GT(box, 0.005);
        EXPECT_NEAR(dent_of_ball(2 * steps), ball, 0.05 * ball) << steps;
        EXPECT_NEAR(fall_of_box("steel", 0.2, 12, 2 * steps).deep, box, 0.05 * box) << steps;
    }
}

}  // namespace
}  // namespace cullet
