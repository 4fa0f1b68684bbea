// What the calls of a world do to its bodies, against formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "sample_game/meshes.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

constexpr float kDt = 1.0f / 60, kGravity = 9.81f;

void steps(World& world, int count) {
    for (int frame = 0; frame < count; ++frame) world.step();
}

Vec3 velocity_of(const World& world, BodyId body) {
    return world.motion(body).value().velocity;
}

struct BallOnFloor {
    World world;
    BodyId floor, ball;
};

// A ball of 1 kg and 10 cm that touches the floor, off the floor's diagonal.
BallOnFloor ball_on_floor(Vec3 velocity = {}, ContactSettings of_ball = {}, ContactSettings of_floor = {},
                          float mass = 1) {
    Settings settings = small_settings();
    settings.gravity = {0, -kGravity, 0};
    BallOnFloor b{make_world(settings), {}, {}};
    const Vec3 corners[] = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    b.floor = b.world.add_static({corners, 4, quad, 2}, of_floor).value();
    SphereSettings ball;
    ball.pose.position = {1, 0.1f, 5};
    ball.motion.velocity = velocity;
    ball.contact = of_ball;
    ball.mass = mass;
    ball.user_data = 7;
    b.ball = b.world.add_sphere(ball).value();
    return b;
}

// Steps until the ball sleeps; the events that said so.
std::vector<AsleepEvent> let_sleep(BallOnFloor& b) {
    std::vector<AsleepEvent> told;
    for (int frame = 0; frame < 600 && !b.world.is_asleep(b.ball).value(); ++frame) {
        b.world.step();
        for (const AsleepEvent& e : b.world.events().asleep) told.push_back(e);
    }
    EXPECT_TRUE(b.world.is_asleep(b.ball).value());
    return told;
}

TEST(WorldCalls, ABodyThatFallsAsleepIsToldOnceWithItsUserDataAndPlace) {
    BallOnFloor b = ball_on_floor();
    const std::vector<AsleepEvent> told = let_sleep(b);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].body, b.ball);
    EXPECT_EQ(told[0].body_user_data, 7u);
    EXPECT_NEAR(told[0].place.x, 1, 0.01);
    EXPECT_NEAR(told[0].place.y, 0.1, 0.002);
    b.world.step();
    EXPECT_EQ(b.world.events().asleep.count, 0u);
}

TEST(WorldCalls, WakeWakes) {
    BallOnFloor b = ball_on_floor();
    let_sleep(b);
    ASSERT_TRUE(b.world.wake(b.ball).ok());
    EXPECT_FALSE(b.world.is_asleep(b.ball).value());
    b.world.step();
    EXPECT_FALSE(b.world.is_asleep(b.ball).value());
    EXPECT_EQ(b.world.report().awake, 1u);
    EXPECT_EQ(let_sleep(b).size(), 1u);
}

TEST(WorldCalls, ANewGravityMovesWhatSlept) {
    BallOnFloor b = ball_on_floor();
    let_sleep(b);
    ASSERT_TRUE(b.world.set_gravity({0, 2, 0}).ok());
    EXPECT_FALSE(b.world.is_asleep(b.ball).value());
    steps(b.world, 10);  // slow bodies that touch lose speed: until it is off the floor
    const float height = b.world.pose(b.ball).value().position.y, speed = velocity_of(b.world, b.ball).y;
    EXPECT_GT(height, 0.105f);
    const int n = 20;
    steps(b.world, n);
    EXPECT_NEAR(velocity_of(b.world, b.ball).y - speed, 2 * kDt * n, 1e-3);
    // Semi-implicit: y = v n dt + g dt^2 n (n + 1) / 2.
    EXPECT_NEAR(b.world.pose(b.ball).value().position.y - height, speed * kDt * n + 2 * kDt * kDt * n * (n + 1) / 2,
                1e-3);
    EXPECT_FALSE(b.world.set_gravity({0, 1e6f, 0}).ok());
}

TEST(WorldCalls, AnImpulseGivesJByMAndTheInverseInertiaTimesItsMoment) {
    World world = make_world(small_settings());
    const ModelId model = world.add_model(small_vase()).value();
    SpawnSettings spawn;
    spawn.is_breakable = false;
    spawn.pose = {{1, 2, 3}, normalised(Quat{0.3f, -0.2f, 0.5f, 0.7f})};
    spawn.motion = {{0.5f, 0, -0.25f}, {0.1f, 0.2f, -0.3f}};
    const BodyId body = world.spawn(model, spawn).value();
    const Vec3 impulse{0.4f, -0.7f, 0.2f}, place{1.1f, 2.2f, 2.9f};
    ASSERT_TRUE(world.apply_impulse(body, impulse, place).ok());
    const Motion after = world.motion(body).value();
    const double mass = world.mass(body).value();
    const Vec3 dv = after.velocity - spawn.motion.velocity, dw = after.angular_velocity - spawn.motion.angular_velocity;
    EXPECT_LT(length(static_cast<float>(mass) * dv - impulse), 1e-5f);
    // I dw = r x J, in body axes.
    const Bodies& bodies = state_of(world).bodies;
    const Vec3 arm = place - to_world(spawn.pose, bodies.centre[body.index].to_float());
    const Quat back = conjugate(spawn.pose.orientation);
    const Vec3d turned = bodies.inertia[body.index] * Vec3d(rotate(back, dw));
    const Vec3 moment = rotate(back, cross(arm, impulse));
    EXPECT_LT(length(turned.to_float() - moment), 1e-4f * length(moment));
    const Vec3 centre = to_world(world.pose(body).value(), bodies.centre[body.index].to_float());
    world.step();
    EXPECT_LT(length(velocity_of(world, body) - after.velocity), 1e-4f);
    const Vec3 moved = to_world(world.pose(body).value(), bodies.centre[body.index].to_float()) - centre;
    EXPECT_LT(length(moved - kDt * after.velocity), 1e-4f);
}

TEST(WorldCalls, AnImpulseWakesAndMovesNothingThatIsStatic) {
    BallOnFloor b = ball_on_floor();
    let_sleep(b);
    EXPECT_TRUE(b.world.apply_impulse(b.floor, {0, 100, 0}, {}).ok());
    ASSERT_TRUE(b.world.apply_impulse(b.ball, {0, 2, 0}, b.world.pose(b.ball).value().position).ok());
    EXPECT_FALSE(b.world.is_asleep(b.ball).value());
    b.world.step();
    EXPECT_NEAR(velocity_of(b.world, b.ball).y, 2 - kGravity * kDt, 1e-3);
    EXPECT_EQ(b.world.pose(b.floor).value().position.y, 0);
}

TEST(WorldCalls, FrictionSlowsASlidingBallByMuGAndWithoutItNothingDoes) {
    const float speed = 3;
    ContactSettings rough, smooth;
    rough.friction = 0.6f, smooth.friction = 0;
    BallOnFloor sliding = ball_on_floor({speed, 0, 0}, smooth, rough);
    steps(sliding.world, 30);
    EXPECT_NEAR(velocity_of(sliding.world, sliding.ball).x, speed, 0.02);
    EXPECT_NEAR(sliding.world.motion(sliding.ball)->angular_velocity.z, 0, 0.1);

    // mu = sqrt(0.6 0.15) = 0.3: v = v0 - mu g t until it rolls, after 2 v0 / (7 mu g) = 0.29 s or more.
    ContactSettings waxed;
    waxed.friction = 0.15f;
    BallOnFloor rolling = ball_on_floor({speed, 0, 0}, waxed, rough);
    steps(rolling.world, 12);
    EXPECT_NEAR(velocity_of(rolling.world, rolling.ball).x, speed - 0.3f * kGravity * 12 * kDt, 0.06);
}

TEST(WorldCalls, ARollingBallSlowsByItsRollingFrictionWhateverItWeighsAndRollsOn) {
    for (const float mass : {0.1f, 1.0f, 30.0f, 1000.0f}) {
        ContactSettings rough;
        rough.rolling_friction = 0.135f;
        BallOnFloor b = ball_on_floor({1, 0, 0}, rough, {}, mass);
        ASSERT_TRUE(b.world.set_motion(b.ball, {{1, 0, 0}, {0, 0, -10}}).ok());
        steps(b.world, 20);
        const Motion motion = b.world.motion(b.ball).value();
        // A moment of 0.135 r N against a mass of 7/5 m: a = 0.135 g / 1.4.
        EXPECT_NEAR(motion.velocity.x, 1 - 0.135f * kGravity / 1.4f * 20 * kDt, 0.03) << mass << " kg";
        EXPECT_NEAR(-motion.angular_velocity.z * 0.1f, motion.velocity.x, 0.02) << mass << " kg";
    }
}

TEST(WorldCalls, RestitutionGivesBackItsShareOfTheSpeed) {
    for (const float share : {0.0f, 0.5f, 1.0f}) {
        ContactSettings floor, ball;
        floor.restitution = 1, ball.restitution = share;
        BallOnFloor b = ball_on_floor({}, ball, floor);
        ASSERT_TRUE(b.world.set_gravity({}).ok());
        ASSERT_TRUE(b.world.set_pose(b.ball, {{1, 0.5f, 5}, {}}).ok());
        ASSERT_TRUE(b.world.set_motion(b.ball, {{0, -4, 0}, {}}).ok());
        steps(b.world, 20);
        EXPECT_NEAR(velocity_of(b.world, b.ball).y, 4 * std::sqrt(1 * share), 0.08) << share;  // their geometric mean
    }
}

TEST(WorldCalls, AKinematicBoxPushesAndDoesNotYield) {
    World world = make_world(small_settings());
    KinematicSettings box;
    box.motion.velocity = {0.5f, 0, 0};
    box.half_extents = {0.1f, 0.3f, 0.3f};
    box.contact.restitution = 0;
    const BodyId pusher = world.add_kinematic_box(box).value();
    SphereSettings ball;
    ball.pose.position = {0.25f, 0, 0};  // 5 cm before the box: met after 0.1 s
    ball.mass = 50;
    ball.contact.restitution = 0;
    const BodyId pushed = world.add_sphere(ball).value();
    steps(world, 30);
    EXPECT_NEAR(velocity_of(world, pushed).x, 0.5, 0.01);
    EXPECT_EQ(velocity_of(world, pusher).x, 0.5f);
    EXPECT_NEAR(world.pose(pusher)->position.x, 0.25, 1e-3);
    EXPECT_NEAR(world.pose(pushed)->position.x, 0.25f + 0.2f, 0.005);  // 0.1 m of box, 0.1 m of ball
}

TEST(WorldCalls, DebrisIsToldWithItsParentAndNoMassIsLost) {
    Settings settings = small_settings();
    settings.debris_share = 0.05f;
    Breakage b = vase_and_ball(settings, 12);
    const double before = b.world.mass(b.body).value();
    double debris = 0, bodies = 0;
    uint32_t count = 0;
    for (int frame = 0; frame < 20; ++frame) {
        b.world.step();
        for (const DebrisEvent& e : b.world.events().debris) {
            ++count;
            debris += e.mass;
            EXPECT_LT(e.mass, 0.05 * before);
            EXPECT_EQ(e.body_user_data, 42u);
            EXPECT_TRUE(b.world.is_alive(e.parent));
            EXPECT_LT(length(e.place - Vec3{0, 0.15f, 0}), 0.6f);
            EXPECT_LT(length(e.velocity), 24);  // twice the ball's at most
        }
    }
    for (const BodyId body : shells_of(b.world)) bodies += b.world.mass(body).value();
    EXPECT_GT(count, 0u);
    EXPECT_EQ(b.world.report().debris, count);
    EXPECT_NEAR(bodies + debris, before, 1e-6 * before);
}

TEST(WorldCalls, ABodySpawnedBetweenStepsHasAllOfItsMeshDirtyUntilTheNextStepIsOver) {
    World world = make_world(small_settings());
    const ModelId model = world.add_model(small_pane()).value();
    steps(world, 5);
    const BodyId body = world.spawn(model).value();
    const auto expect_dirty = [&](bool is_dirty) {
        const BodyView view = world.view(body).value();
        ASSERT_GT(view.vertex_count, 0u);
        EXPECT_EQ(view.dirty_vertices.first, 0u);
        EXPECT_EQ(view.dirty_indices.first, 0u);
        EXPECT_EQ(view.dirty_vertices.count, is_dirty ? view.vertex_count : 0u);
        EXPECT_EQ(view.dirty_indices.count, is_dirty ? view.index_count : 0u);
    };
    expect_dirty(true);
    world.step();
    expect_dirty(true);
    world.step();
    expect_dirty(false);
}

TEST(WorldCalls, WhatBreaksHasItsMeshDirtyForOneStep) {
    Breakage b = vase_and_ball(small_settings());
    ASSERT_GT(step_until_born(b.world, 10), 0u);
    for (const BodyId body : shells_of(b.world)) {
        const BodyView view = b.world.view(body).value();
        EXPECT_GT(view.dirty_vertices.count, 0u);
        EXPECT_LE(view.dirty_vertices.first + view.dirty_vertices.count, view.vertex_count);
        EXPECT_EQ(view.dirty_indices.count, view.dirty_vertices.count);
    }
    // Each stamp goes with its dirty range.
    for (int frame = 0; frame < 20; ++frame) {
        std::vector<std::pair<BodyId, uint32_t>> stamps;
        for (const BodyId body : shells_of(b.world)) stamps.emplace_back(body, b.world.view(body)->stamp);
        b.world.step();
        for (const auto& [body, stamp] : stamps) {
            const Result<BodyView> view = b.world.view(body);
            if (view) {
                EXPECT_EQ(view->dirty_vertices.count > 0, view->stamp != stamp);
            }
        }
    }
}

TEST(WorldCalls, CookingsProgressRisesToOne) {
    const Mesh mesh = make_pane(0.3f, 0.05f);
    for (const bool measures : {true, false}) {
        std::vector<float> shares;
        CookSettings settings;
        settings.material = "glass";
        settings.thickness = 0.004f;
        settings.thick_shell.measures_threshold = measures;
        settings.progress_user = &shares;
        settings.progress = [](void* user, float share) { static_cast<std::vector<float>*>(user)->push_back(share); };
        ASSERT_TRUE(cook(view_of_mesh(mesh), settings).ok());
        ASSERT_GE(shares.size(), 3u);
        EXPECT_GT(shares.front(), 0);
        for (size_t i = 1; i < shares.size(); ++i) EXPECT_GE(shares[i], shares[i - 1]);
        EXPECT_FLOAT_EQ(shares.back(), 1);
    }
}

}  // namespace
}  // namespace cullet::test
