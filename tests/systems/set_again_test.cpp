// A game may say the same each frame: what is set already wakes nobody, and a mode of the host's own changes no answer.
#include <gtest/gtest.h>

#include <xmmintrin.h>

#include "cullet/query.hpp"
#include "tests/support/small_worlds.hpp"

// Designated initializers name what they set.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

namespace cullet::test {
namespace {

struct Sleepers {
    World world;
    BodyId ball, vase, door;

    bool sleep() const { return world.is_asleep(ball).value() && world.is_asleep(vase).value(); }
};

/// A ball and a vase that lie on a floor, asleep, the vase against a door.
Sleepers make_sleepers() {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    Sleepers s{make_world(settings), {}, {}, {}};
    add_floor(s.world);
    s.ball = s.world.add_sphere({.pose = {{1, 0.1f, 0}, {}}}).value();
    s.vase = s.world.spawn(s.world.add_model(small_vase()).value(), {.pose = {{0, 0.001f, 0}, {}}}).value();
    s.door = s.world.add_kinematic_box({.pose = {{-0.4f, 0.2f, 0}, {}}, .half_extents = {0.05f, 0.2f, 0.3f}}).value();
    for (int frame = 0; frame < 600 && !s.sleep(); ++frame) s.world.step();
    EXPECT_TRUE(s.sleep());
    return s;
}

/// Says it before each step of two seconds; whether all still sleep.
template <class Say>
bool sleep_through(Say say) {
    Sleepers s = make_sleepers();
    for (int frame = 0; frame < 120; ++frame) {
        say(s);
        s.world.step();
        if (!s.sleep()) return false;
    }
    return true;
}

TEST(SetAgain, TheSameGravityWakesNobody) {
    EXPECT_TRUE(sleep_through([](Sleepers& s) { EXPECT_TRUE(s.world.set_gravity({0, -9.81f, 0}).ok()); }));
    EXPECT_FALSE(sleep_through([](Sleepers& s) { EXPECT_TRUE(s.world.set_gravity({0, -9.8f, 0}).ok()); }));
}

TEST(SetAgain, WhatIsSetFromTheStartMaySleep) {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    World world = make_world(settings);
    add_floor(world);
    const BodyId ball = world.add_sphere({.pose = {{0, 0.1f, 0}, {}}}).value();
    for (int frame = 0; frame < 600; ++frame) {
        EXPECT_TRUE(world.set_gravity({0, -9.81f, 0}).ok());
        if (frame > 60) {
            EXPECT_TRUE(world.set_motion(ball, {}).ok());
        }
        world.step();
    }
    EXPECT_TRUE(world.is_asleep(ball).value());
}

TEST(SetAgain, TheSamePlaceWakesNobody) {
    EXPECT_TRUE(sleep_through([](Sleepers& s) {
        for (const BodyId body : {s.ball, s.vase, s.door})
            EXPECT_TRUE(s.world.set_pose(body, s.world.pose(body).value()).ok());
    }));
    // The other quaternion of the same rotation, as a game's own product of turns may be.
    EXPECT_TRUE(sleep_through([](Sleepers& s) {
        for (const BodyId body : {s.ball, s.vase, s.door}) {
            Pose pose = s.world.pose(body).value();
            const Quat q = pose.orientation;
            pose.orientation = {-q.x, -q.y, -q.z, -q.w};
            EXPECT_TRUE(s.world.set_pose(body, pose).ok());
        }
    }));
    EXPECT_FALSE(sleep_through([](Sleepers& s) {
        Pose pose = s.world.pose(s.ball).value();
        pose.position.y += 0.05f;
        EXPECT_TRUE(s.world.set_pose(s.ball, pose).ok());
    }));
}

TEST(SetAgain, TheSameMotionAndNoneWakeNobody) {
    EXPECT_TRUE(sleep_through([](Sleepers& s) {
        for (const BodyId body : {s.ball, s.vase, s.door}) {
            EXPECT_TRUE(s.world.set_motion(body, s.world.motion(body).value()).ok());
            EXPECT_TRUE(s.world.set_motion(body, {}).ok());
        }
    }));
    EXPECT_FALSE(sleep_through([](Sleepers& s) {
        EXPECT_TRUE(s.world.set_motion(s.ball, {.velocity = {0.5f, 0, 0}}).ok());
    }));
}

TEST(SetAgain, NoImpulseWakesNobody) {
    EXPECT_TRUE(sleep_through([](Sleepers& s) {
        for (const BodyId body : {s.ball, s.vase}) EXPECT_TRUE(s.world.apply_impulse(body, {}, {0, 0.1f, 0}).ok());
    }));
    EXPECT_FALSE(sleep_through([](Sleepers& s) {
        EXPECT_TRUE(s.world.apply_impulse(s.ball, {0.5f, 0, 0}, {1, 0.1f, 0}).ok());
    }));
}

TEST(SetAgain, ADoorThatIsToldItsMotionGoesOn) {
    Sleepers s = make_sleepers();
    for (int frame = 0; frame < 60; ++frame) {
        EXPECT_TRUE(s.world.set_motion(s.door, {.velocity = {0, 0.1f, 0}}).ok());
        s.world.step();
    }
    EXPECT_NEAR(s.world.pose(s.door).value().position.y, 0.3f, 1e-4f);
}

/// While one of these lives the thread is in a mode of a host's own: it rounds up, keeps denormals, or flushes them.
class HostMode {
 public:
    explicit HostMode(unsigned mode) : before_(_mm_getcsr()) { _mm_setcsr(mode); }
    ~HostMode() { _mm_setcsr(before_); }
    HostMode(const HostMode&) = delete;
    HostMode& operator=(const HostMode&) = delete;

 private:
    unsigned before_;
};

/// All that a call says of numbers at the edges, and what a world of the accepted ones becomes.
std::string answers_in(unsigned mode) {
    const float denormal = 1e-40f;
    const auto say = [](const auto& result) { return result.ok() ? std::string("accepted\n") : result.error() + "\n"; };
    Sleepers s = make_sleepers();
    std::string all;
    {
        const HostMode host(mode);
        all += say(s.world.add_sphere({.radius = denormal}));
        all += say(s.world.add_sphere({.mass = denormal}));
        all += say(s.world.add_kinematic_box({.half_extents = {denormal, 1, 1}}));
        all += say(s.world.set_gravity({denormal, -9.81f, 0}));
        all += say(s.world.set_gravity({0, -1e4f, 0}));
        all += say(s.world.set_pose(s.ball, {{1e6f, 0, 0}, {0, 0, 0, 1.0004998f}}));
        all += say(s.world.set_motion(s.ball, {.velocity = {denormal, 0, 0}}));
        all += say(s.world.set_motion(s.ball, {.velocity = {100000, 0, 0}}));
        all += say(s.world.push_impact(s.vase, {.approach_speed = denormal}));
        all += say(s.world.push_impact(s.vase, {.normal = {0, -1.0009995f, 0}}));
        all += say(s.world.explode({.impulse = denormal}));
        all += say(s.world.explode({.pressure = denormal, .seconds = 1}));
        all += say(s.world.cut(s.vase, {.normal = {0, 1.0009995f, 0}}));
        all += say(s.world.shift_origin({denormal, 0, 0}));
        all += say(s.world.retire({.least_seconds = denormal}));
        all += say(World::create({.step_seconds = denormal}));
        CookSettings cook_settings;
        cook_settings.thickness = denormal;
        const Vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const uint32_t faces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
        all += say(cook({points, 4, faces, 4}, cook_settings));
        const SurfaceHit hit = ray(s.world, {1, 1, 0}, {0, -denormal, 0}, 5);
        all += hit ? "hit\n" : "missed\n";
        BodyId found[8];
        all += std::to_string(overlap(s.world, {0, 0, 0}, denormal, found, 8)) + "\n";
        for (int frame = 0; frame < 10; ++frame) s.world.step();
    }
    return all + std::to_string(s.world.hash());
}

TEST(SetAgain, AHostsFloatingPointModeChangesNoAnswer) {
    const std::string usual = answers_in(0x1f80);  // to the nearest, denormals kept
    for (const unsigned mode : {0x9fc0u, 0x3f80u, 0x5f80u, 0x7f80u, 0x1fc0u, 0xffc0u})
        EXPECT_EQ(answers_in(mode), usual) << std::hex << mode;
}

}  // namespace
}  // namespace cullet::test
