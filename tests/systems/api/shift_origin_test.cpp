// Another origin: what is exact, what is nearly so, and what nobody may notice.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cullet/query.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

constexpr Vec3 kFarPlace{4000, 0, -4000};

Settings with_gravity() {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    return settings;
}

BodyId add_floor_at(World& world, Vec3 at) {
    const Vec3 corners[] = {at + Vec3{-5, 0, -5}, at + Vec3{-5, 0, 5}, at + Vec3{5, 0, 5}, at + Vec3{5, 0, -5}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    return world.add_static({corners, 4, quad, 2}).value();
}

World falling_vase(Vec3 at, float tilt = 0.2f) {
    World world = make_world(with_gravity());
    add_floor_at(world, at);
    SpawnSettings vase;
    vase.pose = {at + Vec3{0, 0.75f, 0}, normalised(Quat{tilt, 0, 0, 0.98f})};
    vase.motion.velocity = {0, -4, 0};
    (void)world.spawn(world.add_model(small_vase()).value(), vase).value();
    return world;
}

struct Outcome {
    uint32_t born = 0;
    double mass = 0;
    Vec3 middle;  // of all bodies but the floor
};

Outcome played(World& world, int frames) {
    Outcome outcome;
    for (int frame = 0; frame < frames; ++frame) {
        world.step();
        outcome.born += world.events().fragments_born.count;
    }
    const std::vector<BodyId> bodies = shells_of(world);
    for (const BodyId body : bodies)
        outcome.middle +=
            static_cast<float>(state_of(world).bodies.mass[body.index]) * world.pose(body).value().position;
    outcome.mass = matter_of(world).mass;
    outcome.middle = static_cast<float>(1 / outcome.mass) * outcome.middle;
    return outcome;
}

TEST(ShiftOrigin, AVaseShiftedBackFromFourKilometresBreaksLikeOneAtTheOrigin) {
    // Places of 4 km are rounded by a quarter of a millimetre, and where one shard rolls off the middle moves by 0.3 m:
    // what several vases do together tells.
    Outcome expected, found;
    for (const float tilt : {-0.3f, -0.1f, 0.2f, 0.4f}) {
        World here = falling_vase({}, tilt), there = falling_vase(kFarPlace, tilt);
        ASSERT_TRUE(there.shift_origin(kFarPlace).ok());
        const auto add = [](Outcome& sum, const Outcome& one) {
            EXPECT_GT(one.born, 3u);
            sum.born += one.born, sum.mass += one.mass;
            sum.middle += 0.25f * one.middle;
        };
        add(expected, played(here, 90)), add(found, played(there, 90));
    }
    std::printf("born %u and %u, middles %.3f m apart\n", expected.born, found.born,
                static_cast<double>(length(found.middle - expected.middle)));
    EXPECT_NEAR(found.born, expected.born, 0.5 * expected.born);
    EXPECT_NEAR(found.mass, expected.mass, 1e-9);
    EXPECT_LT(length(found.middle - expected.middle), 0.2);
}

TEST(ShiftOrigin, AShiftByNothingLeavesEveryBitOfARun) {
    World here = falling_vase({}), there = falling_vase({});
    for (int frame = 0; frame < 8; ++frame) here.step(), there.step();
    ASSERT_TRUE(there.shift_origin({}).ok());
    const Outcome expected = played(here, 60), found = played(there, 60);
    EXPECT_EQ(found.born, expected.born);
    EXPECT_EQ(there.hash(), here.hash());
}

TEST(ShiftOrigin, AShiftInFlightOrInDamageGoesOn) {
    for (const int frames : {2, 9}) {
        Settings settings = with_gravity();
        settings.units_a_frame = 5'000'000;
        World world = make_world(settings);
        add_floor_at(world, {});
        SpawnSettings vase;
        vase.pose.position = {0, 0.5f, 0};
        vase.motion.velocity = {0, -4, 0};
        const BodyId body = world.spawn(world.add_model(small_vase()).value(), vase).value();
        for (int frame = 0; frame < frames; ++frame) world.step();
        EXPECT_EQ(world.report().open_hits, frames == 9 ? 1u : 0u);
        const Vec3 before = world.pose(body).value().position;
        ASSERT_TRUE(world.shift_origin(kFarPlace).ok());
        const Vec3 after = world.pose(body).value().position;
        EXPECT_NEAR(after.x, before.x - kFarPlace.x, 0.0003);
        EXPECT_NEAR(after.y, before.y, 1e-6);
        const BodyView view = world.view(body).value();
        EXPECT_NEAR(view.pose_before.position.x, -kFarPlace.x, 0.01);
        const Outcome outcome = played(world, 90);
        EXPECT_GT(outcome.born, 3u);
        EXPECT_NEAR(outcome.mass, small_vase().report().mass, 1e-9);
        EXPECT_LT(length(outcome.middle + kFarPlace), 1);
        for (const BodyId piece : shells_of(world)) EXPECT_GT(world.pose(piece).value().position.y, -0.5f);
    }
}

TEST(ShiftOrigin, AHeapThatSleepsSleepsOnThereAndBack) {
    World world = make_world(with_gravity());
    add_floor_at(world, {});
    KinematicSettings table;
    table.pose.position = {0, 0.1f, 0};
    table.half_extents = {0.15f, 0.1f, 0.15f};
    (void)world.add_kinematic_box(table).value();
    const ModelId vase = world.add_model(small_vase()).value();
    for (int k = 0; k < 6; ++k) {
        SpawnSettings spawn;
        const float side = k % 2 ? 0.05f : -0.05f;
        spawn.pose = {{side, 0.25f + 0.15f * static_cast<float>(k), -side}, normalised(Quat{side, 0, 1, 1})};
        spawn.is_breakable = false;
        (void)world.spawn(vase, spawn).value();
    }
    for (int frame = 0; frame < 900 && world.report().awake > 0; ++frame) world.step();
    ASSERT_EQ(world.report().awake, 0u);
    for (const Vec3 by : {kFarPlace, -kFarPlace, Vec3{0, 4000, 0}, Vec3{0, -4000, 0}}) {
        ASSERT_TRUE(world.shift_origin(by).ok());
        for (int frame = 0; frame < 60; ++frame) {
            world.step();
            ASSERT_EQ(world.report().awake, 0u) << "frame " << frame << " after a shift by " << by.x << " " << by.y;
        }
    }
    // Woken, it finds its rest again: nothing was pushed into anything by more than rounding.
    for (const BodyId body : shells_of(world)) ASSERT_TRUE(world.wake(body).ok());
    for (int frame = 0; frame < 300 && world.report().awake > 0; ++frame) world.step();
    EXPECT_EQ(world.report().awake, 0u);
    EXPECT_EQ(world.events().fragments_born.count, 0u);
}

TEST(ShiftOrigin, QueriesEventsAndStaticTrianglesMoveWithIt) {
    World world = falling_vase({});
    while (world.events().impacts.count == 0) world.step();
    const Vec3 place = world.events().impacts[0].place;
    const SurfaceHit before = ray(world, {2, 1, 2}, {0, -1, 0}, 5);
    ASSERT_TRUE(before);
    const Vec3 by{64, -8, 32};
    ASSERT_TRUE(world.shift_origin(by).ok());
    EXPECT_NEAR(length(world.events().impacts[0].place - (place - by)), 0, 1e-5);
    const SurfaceHit after = ray(world, Vec3{2, 1, 2} - by, {0, -1, 0}, 5);
    EXPECT_EQ(after.body, before.body);
    EXPECT_NEAR(length(after.place - (before.place - by)), 0, 1e-5);
    EXPECT_EQ(after.triangle, before.triangle);
    // A ball that is thrown down there lands on the floor that has moved.
    SphereSettings ball;
    ball.pose.position = Vec3{2, 0.5f, 2} - by;
    const BodyId id = world.add_sphere(ball).value();
    for (int frame = 0; frame < 120; ++frame) world.step();
    EXPECT_NEAR(world.pose(id).value().position.y, 0.1f - by.y, 0.002);
}

/// A ball that falls for two seconds onto the floor that was shifted down.
void expect_landing(World& world, float floor) {
    SphereSettings ball;
    ball.pose.position = {2, floor + 0.5f, 2};
    const BodyId id = world.add_sphere(ball).value();
    for (int frame = 0; frame < 120; ++frame) world.step();
    EXPECT_NEAR(world.pose(id).value().position.y, floor + 0.1f, 0.002);
}

TEST(ShiftOrigin, StaticTrianglesMoveInAWorldThatWasSavedAndInOneThatLoads) {
    World saved = make_world(with_gravity());
    add_floor_at(saved, {});
    saved.step();
    const auto bytes = saved.snapshot();
    ASSERT_TRUE(bytes.ok()) << bytes.error();
    World loaded = make_world(with_gravity());
    const Result<void> restored = loaded.restore(bytes->data(), bytes->size());
    ASSERT_TRUE(restored.ok()) << restored.error();
    for (World* world : {&saved, &loaded}) {
        ASSERT_TRUE(world->shift_origin({0, 8, 0}).ok());
        expect_landing(*world, -8);
    }
}

TEST(ShiftOrigin, PlacesThatAreNoNumbersOrTooFarAreRefused) {
    World world = falling_vase({});
    const uint64_t before = world.hash();
    EXPECT_FALSE(world.shift_origin({0, std::numeric_limits<float>::quiet_NaN(), 0}).ok());
    EXPECT_NE(world.shift_origin({2e6f, 0, 0}).error().find("2000000"), std::string::npos);
    EXPECT_EQ(world.hash(), before);
}

}  // namespace
}  // namespace cullet::test
