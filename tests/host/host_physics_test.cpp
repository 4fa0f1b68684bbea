// A host with its own physics breaks a vase. This program links cullet::core, in which there is no Bullet.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "tests/host/plain_physics.hpp"

namespace cullet::test {
namespace {

constexpr float kDt = 1.0f / 60;
constexpr Vec3 kGravity{0, -9.81f, 0};

const Model& vase() {
    static const Model model = [] {
        std::vector<Vec3> points{{0, 0, 0}};
        std::vector<std::array<uint32_t, 3>> faces;
        for (uint32_t i = 0; i < 30 * 40; ++i) {
            const float ring = static_cast<float>(i / 40), angle = 6.2831853f / 40 * static_cast<float>(i % 40);
            const float radius = ring < 3 ? 0.02f + 0.015f * ring : 0.06f + 0.025f * std::sin(0.22f * ring - 0.9f);
            points.push_back({radius * std::cos(angle), ring < 3 ? 0 : 0.01f * (ring - 2), radius * std::sin(angle)});
            const uint32_t a = i + 1, b = i % 40 == 39 ? a - 39 : a + 1;
            if (i < 40) faces.push_back({0, a, b});
            if (i >= 40) faces.insert(faces.end(), {{a - 40, a, b - 40}, {b - 40, a, b}});
        }
        CookSettings settings;
        settings.thickness = 0.004f;
        return cook({points.data(), points.size(), faces[0].data(), faces.size()}, settings).value();
    }();
    return model;
}

struct Scene {
    World world;
    plain::Physics physics;
    BodyId vase;
};

Scene drop(float height, const Settings& settings = {}, const Host& host = {}) {
    Scene s{std::move(World::create_hosted(settings, host)).value(), {}, {}};
    const Vec3 corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
    s.physics.floor = s.world.add_static({corners, 4, quad, 2}).value();
    SpawnSettings spawn;
    spawn.pose = {{0, height, 0}, {0.2f, 0, 0, std::sqrt(0.96f)}};
    spawn.user_data = 42;
    s.vase = s.world.spawn(s.world.add_model(vase()).value(), spawn).value();
    return s;
}

Settings roomy() {
    Settings settings;
    settings.units_a_frame = 50'000'000;
    settings.limits = {1024, 4, 1u << 18, 1u << 19, 8, 1u << 20, 2048};
    return settings;
}

double mass_of(Scene& s) {
    double mass = 0;
    for (auto& [index, t] : s.physics.things) mass += t.shape.mass;
    return mass;
}

float lowest_of(plain::Thing& t) {
    float lowest = 1e9f;
    for (const Eigen::Vector3f& corner : t.corners)
        lowest = std::min(lowest, t.shape.pose.position.y + (t.offset() + t.turn() * corner).y());
    return lowest - t.shape.margin;
}

// What the world says of its bodies and what the host holds of them are one and the same.
void expect_same_bodies(Scene& s) {
    for (auto& [index, t] : s.physics.things) {
        ASSERT_TRUE(s.world.is_alive(t.shape.body));
        EXPECT_NEAR(s.world.mass(t.shape.body).value(), t.shape.mass, 1e-9);  // compaction sums anew
    }
    EXPECT_EQ(s.world.bodies(nullptr, 0), s.physics.things.size() + 1);  // the floor is the host's own
}

TEST(HostPhysics, AVaseThatFallsOnAHostsFloorBreaksAndItsPiecesComeToRest) {
    Scene s = drop(1.2f, roomy());
    double mass = 0, debris = 0;
    uint32_t born = 0, held = 0;
    for (int frame = 0; frame < 360; ++frame) {
        ASSERT_TRUE(s.physics.step(s.world, kDt, kGravity).ok());
        expect_same_bodies(s);
        held += s.world.host_changes().held.count;
        born += s.world.events().fragments_born.count;
        for (const DebrisEvent& e : s.world.events().debris) debris += e.mass;
        if (frame == 0) mass = mass_of(s);
    }
    EXPECT_NEAR(mass, vase().report().mass, 1e-9);
    EXPECT_GT(born, 3u);
    EXPECT_GT(held, 0u);
    EXPECT_NEAR(mass_of(s) + debris, mass, 1e-6 * mass);
    for (auto& [index, t] : s.physics.things) {
        const float lowest = lowest_of(t);
        EXPECT_GT(lowest, -0.01f);
        EXPECT_LT(lowest, 0.01f);
        EXPECT_LT(plain::at(t.shape.motion.velocity).norm(), 0.3f);
    }
}

using Pairs = std::set<std::pair<uint32_t, uint32_t>>;

/// Of bodies that are to pass through each other in later steps too.
Pairs apart_later(const World& world) {
    Pairs pairs;
    for (const HostPair& p : world.host_changes().apart)
        if (p.seconds > 0) pairs.insert(std::minmax(p.a.index, p.b.index));
    return pairs;
}

TEST(HostPhysics, AWorldThatIsLoadedTellsTheHostAllItsBodies) {
    Scene s = drop(1.2f, roomy());
    while (s.physics.things.size() < 3) ASSERT_TRUE(s.physics.step(s.world, kDt, kGravity).ok());
    const auto bytes = s.world.snapshot();
    ASSERT_TRUE(bytes.ok()) << bytes.error();
    Scene t{std::move(World::create_hosted(roomy())).value(), {}, {}};
    t.physics.floor = s.physics.floor;
    const Result<void> loaded = t.world.restore(bytes->data(), bytes->size());
    ASSERT_TRUE(loaded.ok()) << loaded.error();
    EXPECT_EQ(t.world.hash(), s.world.hash());
    EXPECT_GT(apart_later(s.world).size(), 1u);
    EXPECT_EQ(apart_later(t.world), apart_later(s.world));
    t.physics.apply(t.world.host_changes());
    expect_same_bodies(t);
    EXPECT_NEAR(mass_of(t), mass_of(s), 1e-12);
    for (int frame = 0; frame < 240; ++frame) ASSERT_TRUE(t.physics.step(t.world, kDt, kGravity).ok());
    expect_same_bodies(t);
    for (auto& [index, thing] : t.physics.things) EXPECT_LT(plain::at(thing.shape.motion.velocity).norm(), 0.3f);
}

TEST(HostPhysics, AWorldThatIsLoadedTellsWhatTheGameDidToBallsAndBoxesBeforeTheSave) {
    Scene s = drop(1);
    const BodyId ball = s.world.add_sphere({}).value(), gone = s.world.add_sphere({}).value();
    const BodyId box = s.world.add_kinematic_box({}).value();
    ASSERT_TRUE(s.world.step({}).ok());
    ASSERT_TRUE(s.world.set_pose(ball, {{0, 7, 0}, {}}).ok());
    ASSERT_TRUE(s.world.set_motion(box, {{0, 2, 0}, {}}).ok());
    ASSERT_TRUE(s.world.remove(gone).ok());
    const auto bytes = s.world.snapshot();
    ASSERT_TRUE(bytes.ok()) << bytes.error();
    World loaded = std::move(World::create_hosted({})).value();
    ASSERT_TRUE(loaded.restore(bytes->data(), bytes->size()).ok());
    const HostChanges changes = loaded.host_changes();
    ASSERT_EQ(changes.born.count, 1u);
    EXPECT_EQ(changes.born[0].body, s.vase);
    ASSERT_EQ(changes.moved.count, 2u);
    EXPECT_EQ(changes.moved[0].body, ball);
    EXPECT_EQ(changes.moved[0].pose.position.y, 7);
    EXPECT_EQ(changes.moved[1].body, box);
    EXPECT_EQ(changes.moved[1].motion.velocity.y, 2);
    ASSERT_EQ(changes.removed.count, 1u);
    EXPECT_EQ(changes.removed[0], gone);
    ASSERT_TRUE(loaded.step({}).ok());
    EXPECT_EQ(loaded.host_changes().moved.count + loaded.host_changes().removed.count, 0u);
    ASSERT_TRUE(s.world.step({}).ok());
    EXPECT_EQ(s.world.host_changes().removed.count, 1u) << "the one that saved still tells";
    EXPECT_EQ(loaded.hash(), s.world.hash());
}

TEST(HostPhysics, AGentleTouchBreaksNothing) {
    Scene s = drop(0.06f, roomy());
    for (int frame = 0; frame < 60; ++frame) {
        ASSERT_TRUE(s.physics.step(s.world, kDt, kGravity).ok());
        ASSERT_EQ(s.world.events().fragments_born.count, 0u);
    }
    EXPECT_EQ(s.physics.things.size(), 1u);
}

TEST(HostPhysics, TheSameRowsGiveTheSameBytesWhateverTheOrderOfContactsAndTheThreads) {
    uint64_t hash[2];
    for (uint32_t run : {0u, 1u}) {
        Settings settings = roomy();
        settings.threads = 1 + run;
        Scene s = drop(1.0f, settings);
        for (int frame = 0; frame < 30; ++frame) {
            std::vector<HostBody> bodies;
            std::vector<HostContact> contacts;
            const float y = 0.3f - 0.02f * static_cast<float>(frame);
            bodies.push_back({s.vase, {{0, y, 0}, {}}, {{0, -4.5f, 0}, {}}});
            for (int k = 0; k < 12; ++k)
                contacts.push_back({s.vase,
                                    s.physics.floor,
                                    {0.02f * std::sin(2.1f * static_cast<float>(k)), 0, 0.03f},
                                    {0, 1, 0},
                                    y});
            if (y > 0.02f) contacts.clear();
            if (run == 1) std::reverse(contacts.begin(), contacts.end());
            ASSERT_TRUE(s.world.step({bodies.data(), 1, contacts.data(), static_cast<uint32_t>(contacts.size())}).ok());
        }
        EXPECT_GT(s.world.bodies(nullptr, 0), 2u);
        hash[run] = s.world.hash();
    }
    EXPECT_EQ(hash[0], hash[1]);
}

TEST(HostPhysics, ASpawnComesBackAsABirthWithItsPieces) {
    Scene s = drop(1);
    ASSERT_TRUE(s.world.step({}).ok());
    const HostChanges changes = s.world.host_changes();
    ASSERT_EQ(changes.born.count, 1u);
    const HostShape& shape = changes.born[0];
    EXPECT_EQ(shape.body, s.vase);
    EXPECT_FALSE(shape.is_static);
    EXPECT_EQ(shape.pose.position.y, 1);
    EXPECT_GT(shape.piece_count, 5u);
    for (uint32_t p = 0; p < shape.piece_count; ++p) {
        EXPECT_GE(shape.pieces[p].point_count, 1u);
        EXPECT_LE(shape.pieces[p].point_count, 32u);
    }
    EXPECT_EQ(changes.removed.count + changes.reshaped.count + changes.moved.count, 0u);
    ASSERT_TRUE(s.world.step({}).ok());
    EXPECT_EQ(s.world.host_changes().born.count, 0u);
}

TEST(HostPhysics, WhatTheGameAsksBetweenStepsIsToldWithTheNextStep) {
    Scene s = drop(1);
    const BodyId ball = s.world.add_sphere({}).value();
    ASSERT_TRUE(s.world.step({}).ok());
    EXPECT_EQ(s.world.host_changes().born.count, 1u) << "the ball is the host's own";
    ASSERT_TRUE(s.world.apply_impulse(ball, {0, 0, 2}, {}).ok());
    ASSERT_TRUE(s.world.set_pose(s.vase, {{0, 3, 0}, {}}).ok());
    ASSERT_TRUE(s.world.step({}).ok());
    HostChanges changes = s.world.host_changes();
    ASSERT_EQ(changes.moved.count, 2u);
    for (const HostMotion& m : changes.moved) {
        EXPECT_EQ(m.motion.velocity.z, m.body == ball ? 2 : 0);
        EXPECT_EQ(m.pose.position.y, m.body == s.vase ? 3 : 0);
    }
    ASSERT_TRUE(s.world.remove(s.vase).ok());
    ASSERT_TRUE(s.world.step({}).ok());
    changes = s.world.host_changes();
    ASSERT_EQ(changes.removed.count, 1u);
    EXPECT_EQ(changes.removed[0], s.vase);
    const BodyId brief = s.world.spawn(s.world.add_model(vase()).value()).value();
    ASSERT_TRUE(s.world.remove(brief).ok());
    ASSERT_TRUE(s.world.step({}).ok());
    changes = s.world.host_changes();
    EXPECT_EQ(changes.removed.count + changes.born.count, 0u) << "the host never heard of it";
}

TEST(HostPhysics, TheHostsPosesAreTheWorldsAndTheStepBeforeIsKeptForDrawing) {
    Scene s = drop(1);
    const HostBody first{s.vase, {{1, 2, 3}, {}}, {{4, 5, 6}, {}}}, second{s.vase, {{7, 8, 9}, {}}, {}};
    ASSERT_TRUE(s.world.step({&first, 1}).ok());
    EXPECT_EQ(s.world.motion(s.vase).value().velocity.y, 5);
    ASSERT_TRUE(s.world.step({&second, 1}).ok());
    const BodyView view = s.world.view(s.vase).value();
    EXPECT_EQ(view.pose.position.x, 7);
    EXPECT_EQ(view.pose_before.position.x, 1);
}

TEST(HostPhysics, AHostThatSaysItSleepsIsHeard) {
    Scene s = drop(1);
    HostBody body{s.vase, {{0, 1, 0}, {}}, {}, true};
    ASSERT_TRUE(s.world.step({&body, 1}).ok());
    EXPECT_TRUE(s.world.is_asleep(s.vase).value());
    EXPECT_EQ(s.world.events().asleep.count, 1u);
    ASSERT_TRUE(s.world.wake(s.vase).ok());
    ASSERT_TRUE(s.world.step({}).ok());
    ASSERT_EQ(s.world.host_changes().woken.count, 1u);
    EXPECT_FALSE(s.world.is_asleep(s.vase).value());
}

TEST(HostPhysics, RowsThatAreNoNumbersAreRefusedAndBodiesThatAreGonePassedOver) {
    Scene s = drop(1);
    const uint64_t frame = s.world.report().frame;
    HostBody body{s.vase, {{0, std::numeric_limits<float>::quiet_NaN(), 0}, {}}, {}};
    EXPECT_NE(s.world.step({&body, 1}).error().find("HostFrame::bodies[0]"), std::string::npos);
    HostContact contact{s.vase, s.physics.floor, {}, {0, 2, 0}, 0};
    EXPECT_NE(s.world.step({nullptr, 0, &contact, 1}).error().find("HostFrame::contacts[0]"), std::string::npos);
    EXPECT_EQ(s.world.report().frame, frame);
    ASSERT_TRUE(s.world.remove(s.vase).ok());
    body = {s.vase, {{0, 1, 0}, {}}, {}};
    contact = {s.vase, {77, 1}, {}, {0, 1, 0}, 0};
    EXPECT_TRUE(s.world.step({&body, 1, &contact, 1}).ok());
    EXPECT_EQ(s.world.report().frame, frame + 1);
}

TEST(HostPhysics, AStepWithoutAFrameDoesNothingAndSaysSo) {
    std::string told;
    Host host;
    host.user = &told;
    host.log = [](void* user, LogLevel level, const char* sentence) {
        if (level == LogLevel::Error) *static_cast<std::string*>(user) = sentence;
    };
    Scene s = drop(1, {}, host);
    const uint64_t hash = s.world.hash();
    s.world.step();
    EXPECT_NE(told.find("HostFrame"), std::string::npos);
    EXPECT_EQ(s.world.report().frame, 0u);
    EXPECT_EQ(s.world.hash(), hash);
}

}  // namespace
}  // namespace cullet::test
