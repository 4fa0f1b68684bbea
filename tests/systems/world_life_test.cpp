// Handles, limits, removal at any time, and that everything is given back.
#include <gtest/gtest.h>

#include <set>

#include "components/state.hpp"
#include "engine/random.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

uint64_t pools_hash(World& world) {
    uint64_t hash = 0;
    state_of(world).for_each_pool([&](const RangePool& pool) { hash = pool.hash(hash); });
    return hash;
}

void remove_everything(World& world, const std::vector<ModelId>& models) {
    for (const BodyId body : all_bodies(world)) EXPECT_TRUE(world.remove(body).ok());
    for (const ModelId model : models) EXPECT_TRUE(world.remove_model(model).ok());
}

TEST(WorldLife, TheLargestPieceKeepsTheHandleAndIsTheParentOfTheOthers) {
    Breakage b = vase_and_ball(small_settings());
    bool is_seen = false;
    for (int frame = 0; frame < 10 && !is_seen; ++frame) {
        b.world.step();
        std::set<uint32_t> rows;
        for (const FragmentBornEvent& e : b.world.events().fragments_born) {
            is_seen = true;
            EXPECT_EQ(e.parent, b.body);
            EXPECT_TRUE(b.world.is_alive(e.fragment));
            EXPECT_LE(e.mass, b.world.mass(b.body).value());
            EXPECT_EQ(e.body_user_data, 42u);
            EXPECT_EQ(b.world.user_data(e.fragment).value(), 42u);
            EXPECT_EQ(e.generation, 1u);
            EXPECT_TRUE(rows.insert(e.fragment.index).second);
            EXPECT_NEAR(b.world.mass(e.fragment).value(), e.mass, 1e-12);
        }
    }
    EXPECT_TRUE(is_seen);
    EXPECT_TRUE(b.world.is_alive(b.body));
}

TEST(WorldLife, AllIsGivenBackWhenAllIsRemovedAfterABreak) {
    World fresh = make_world(small_settings());
    Breakage b = vase_and_ball(small_settings());
    expect_valid_after_each_system(b.world);
    ASSERT_GT(step_until_born(b.world, 10), 0u);
    for (int frame = 0; frame < 20; ++frame) b.world.step();
    remove_everything(b.world, {ModelId{0, 1}});
    EXPECT_EQ(pools_hash(b.world), pools_hash(fresh));
    EXPECT_EQ(b.world.bodies(nullptr, 0), 0u);
    EXPECT_EQ(b.world.report().open_hits, 0u);
    b.world.step();
}

class WhileATaskIsOpen : public testing::TestWithParam<float> {};
INSTANTIATE_TEST_SUITE_P(HeldAndNot, WhileATaskIsOpen, testing::Values(0.1f, 0.0f),
                         [](const auto& p) { return p.param > 0 ? std::string("Held") : std::string("NotHeld"); });

Breakage open_hit(float hold_seconds) {
    Settings settings = small_settings();
    settings.hold_seconds = hold_seconds;
    settings.units_a_frame = 1'000'000;
    settings.gravity = {0, -9.81f, 0};
    Breakage b = vase_and_ball(settings);
    for (int frame = 0; frame < 20 && open_tasks(b.world) == 0; ++frame) b.world.step();
    EXPECT_EQ(open_tasks(b.world), 1u);
    EXPECT_EQ(b.world.report().held_bodies, hold_seconds > 0 ? 1u : 0u);
    return b;
}

TEST_P(WhileATaskIsOpen, TheBodyCanGo) {
    World fresh = make_world(small_settings());
    Breakage b = open_hit(GetParam());
    ASSERT_TRUE(b.world.remove(b.body).ok());
    EXPECT_EQ(open_tasks(b.world), 0u);
    EXPECT_EQ(state_of(b.world).bodies.hold_count[b.ball.index], 0);
    const Vec3 before = b.world.pose(b.ball).value().position;
    for (int frame = 0; frame < 20; ++frame) b.world.step();
    EXPECT_GT(length(b.world.pose(b.ball).value().position - before), 0.5f);  // it flies on
    remove_everything(b.world, {ModelId{0, 1}});
    EXPECT_EQ(pools_hash(b.world), pools_hash(fresh));
}

TEST_P(WhileATaskIsOpen, TheStrikerCanGo) {
    Breakage b = open_hit(GetParam());
    ASSERT_TRUE(b.world.remove(b.ball).ok());
    EXPECT_GT(step_until_born(b.world, 60), 0u);  // the blow was struck
    for (int frame = 0; frame < 20; ++frame) b.world.step();
    for (const BodyId body : shells_of(b.world)) EXPECT_EQ(state_of(b.world).bodies.hold_count[body.index], 0);
}

TEST_P(WhileATaskIsOpen, AnotherBodyMayTakeTheStrikersRow) {
    Breakage b = open_hit(GetParam());
    ASSERT_TRUE(b.world.remove(b.ball).ok());
    SphereSettings other;
    other.pose.position = {5, 5, 5};
    other.motion.velocity = {1, 0, 0};
    const BodyId ball = b.world.add_sphere(other).value();
    ASSERT_EQ(ball.index, b.ball.index);
    for (int frame = 0; frame < 60; ++frame) b.world.step();
    EXPECT_NEAR(b.world.motion(ball).value().velocity.x, 1, 1e-6f);
}

TEST_P(WhileATaskIsOpen, TheModelCanGo) {
    World fresh = make_world(small_settings());
    Breakage b = open_hit(GetParam());
    ASSERT_TRUE(b.world.remove_model({0, 1}).ok());
    EXPECT_GT(step_until_born(b.world, 60), 0u);
    remove_everything(b.world, {});
    EXPECT_EQ(pools_hash(b.world), pools_hash(fresh));
}

TEST_P(WhileATaskIsOpen, TheGameMayPushPlaceAndWakeTheBody) {
    Breakage b = open_hit(GetParam());
    expect_valid_after_each_system(b.world);
    EXPECT_TRUE(b.world.apply_impulse(b.body, {0, 1, 0}, {0, 0.1f, 0}).ok());
    EXPECT_TRUE(b.world.set_pose(b.body, {{0, 1, 0}, {}}).ok());
    EXPECT_TRUE(b.world.wake(b.body).ok());
    const double mass = matter_of(b.world).mass;
    for (int frame = 0; frame < 60; ++frame) b.world.step();
    EXPECT_NEAR(matter_of(b.world).mass, mass, 1e-6 * mass);
}

/// Runs a break under a limit; the mass must stay, and what was refused must be named.
std::set<std::string> refused_by(Breakage& b, int frames) {
    std::set<std::string> names;
    expect_valid_after_each_system(b.world);
    const double mass = matter_of(b.world).mass;
    for (int frame = 0; frame < frames; ++frame) {
        b.world.step();
        for (const RefusedEvent& e : b.world.events().refused) names.insert(e.setting);
        const double now = matter_of(b.world).mass;
        EXPECT_NEAR(now, mass, 1e-6 * mass) << "frame " << frame;
        if (std::fabs(now - mass) > 1e-6 * mass) break;
    }
    return names;
}

TEST(WorldLimits, BodiesThatFindNoRowStayPartOfTheirParent) {
    Settings settings = small_settings();
    settings.limits.bodies = 4;
    Breakage b = vase_and_ball(settings);
    const std::set<std::string> names = refused_by(b, 30);
    EXPECT_EQ(names.count("limits.bodies"), 1u);
    EXPECT_EQ(b.world.bodies(nullptr, 0), 4u);
    const Result<BodyId> more = b.world.add_sphere({});
    ASSERT_FALSE(more.ok());
    EXPECT_NE(more.error().find("limits.bodies"), std::string::npos) << more.error();
}

TEST(WorldLimits, WithoutRoomForAnyPieceTheBodyKeepsItsCracksAndNobodyIsPushed) {
    Settings settings = small_settings();
    settings.limits.bodies = 2;
    settings.debris_share = 0;
    settings.debris_elements = 0;
    Breakage b = vase_and_ball(settings);
    const std::set<std::string> names = refused_by(b, 30);
    EXPECT_EQ(names.count("limits.bodies"), 1u);
    EXPECT_EQ(b.world.bodies(nullptr, 0), 2u);
}

TEST(WorldLimits, OpenHitsBeyondTheLimitWait) {
    Settings settings = small_settings();
    settings.limits.open_hits = 1;
    settings.units_a_frame = 1'000'000;
    Breakage b = vase_and_ball(settings);
    SpawnSettings vase;
    vase.pose.position = {1, 0, 0};
    (void)b.world.spawn({0, 1}, vase).value();
    (void)b.world.add_sphere(ball_at({1.01f, 0.13f, 0}, 0.3f, 8)).value();
    const BodyId second = shells_of(b.world).back();
    EXPECT_EQ(refused_by(b, 60), std::set<std::string>{});
    const State& state = state_of(b.world);
    uint32_t first_pieces = 0, second_pieces = 0;
    for (const BodyId id : shells_of(b.world)) {
        first_pieces += state.bodies.parent[id.index] == b.body.index;
        second_pieces += state.bodies.parent[id.index] == second.index;
    }
    EXPECT_GT(first_pieces, 0u);
    EXPECT_GT(second_pieces, 0u);
}

TEST(WorldLimits, EveryAmountOfRoomForVerticesKeepsTheMass) {
    const uint32_t vertices = small_vase().report().vertices;
    for (uint32_t limit = 4096; limit < 4 * vertices + 4096; limit += 256) {
        Settings settings = small_settings();
        settings.limits.vertices = limit;
        Breakage b = vase_and_ball(settings);
        for (const std::string& name : refused_by(b, 8)) EXPECT_EQ(name, "limits.vertices") << limit;
    }
}

TEST(WorldLimits, EveryAmountOfRoomForDrawnVerticesKeepsTheMassAndTheMeshes) {
    Breakage probe = vase_and_ball(small_settings());
    const uint32_t drawn = probe.world.view(probe.body).value().vertex_count;
    std::set<std::string> names;
    for (uint32_t limit = std::max(4096u, drawn + 16); limit < 3 * drawn; limit += drawn / 5) {
        Settings settings = small_settings();
        settings.limits.view_vertices = limit;
        Breakage b = vase_and_ball(settings);
        names.merge(refused_by(b, 8));
    }
    EXPECT_EQ(names, std::set<std::string>{"limits.view_vertices"});
}

TEST(WorldLimits, DebrisBeyondTheLimitStaysPartOfItsParent) {
    Settings settings = small_settings();
    settings.limits.debris = 1;
    settings.debris_share = 0.05f;  // much debris
    Breakage b = vase_and_ball(settings, 12);
    EXPECT_EQ(refused_by(b, 20).count("limits.debris"), 1u);
    EXPECT_EQ(b.world.report().debris, 1u);
}

TEST(WorldLimits, TwoThatBreakInOneFrameShareTheRoomForDebris) {
    Settings settings = small_settings();
    settings.limits.debris = 2;
    settings.debris_share = 0.05f;
    settings.units_a_frame = 1'000'000'000;  // both are decided in the frame of the touch
    World world = two_vases(settings, 6, 6);
    const double mass = matter_of(world).mass;
    uint64_t most_in_a_frame = 0, before = 0;
    for (int frame = 0; frame < 20; ++frame) {
        world.step();
        const uint64_t broke = world.contents().data.counts.broke;
        most_in_a_frame = std::max(most_in_a_frame, broke - before);
        before = broke;
        EXPECT_NEAR(matter_of(world).mass, mass, 1e-9 * mass) << frame;
    }
    EXPECT_GE(most_in_a_frame, 2u);
    EXPECT_EQ(world.report().debris, 2u);
}

TEST(WorldLimits, AModelThatDoesNotFitIsRefusedAndTakesNothing) {
    Settings settings = small_settings();
    settings.limits.elements = 4096;
    settings.limits.models = 1;
    World world = make_world(settings);
    const ModelId first = world.add_model(small_pane()).value();
    const Result<ModelId> second = world.add_model(small_pane());
    ASSERT_FALSE(second.ok());
    EXPECT_NE(second.error().find("limits.models"), std::string::npos) << second.error();
    ASSERT_TRUE(world.remove_model(first).ok());
    const uint64_t before = pools_hash(world);
    const Result<ModelId> vase = world.add_model(small_vase());
    EXPECT_TRUE(vase.ok() || vase.error().find("limits.") != std::string::npos) << vase.error();
    if (vase.ok()) {
        ASSERT_TRUE(world.remove_model(vase.value()).ok());
    }
    EXPECT_EQ(pools_hash(world), before);
}

TEST(WorldLife, AHundredRandomSpawnsRemovalsAndHitsEndWithEverythingGivenBack) {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    settings.units_a_frame = 3'000'000;
    settings.limits = {64, 8, 1u << 15, 1u << 16, 8, 1u << 17, 128};  // small: all of it is looked at after each system
    settings.threads = 2;
    World fresh = make_world(settings), world = make_world(settings);
    expect_valid_after_each_system(world);
    const BodyId floor = add_floor(world);
    const Random random{7};
    std::vector<ModelId> models;
    uint64_t opened = 0;
    for (uint32_t n = 0; n < 100; ++n) {
        const auto number = [&](uint32_t channel) { return static_cast<float>(random.uniform(n, channel)); };
        const std::vector<BodyId> bodies = all_bodies(world);
        const BodyId any = bodies[static_cast<size_t>(number(1) * static_cast<float>(bodies.size()))];
        const float choice = number(0);
        if (choice < 0.08f) {
            const Result<ModelId> model = world.add_model(number(2) < 0.5f ? small_pane() : small_wall());
            if (model.ok()) models.push_back(model.value());
        } else if (choice < 0.12f && !models.empty()) {
            ASSERT_TRUE(world.remove_model(models.back()).ok());
            models.pop_back();
        } else if (choice < 0.35f && !models.empty()) {
            SpawnSettings s;
            s.pose.position = {2 * number(2) - 1, 0.2f + number(3), 2 * number(4) - 1};
            s.motion.velocity = {0, -6 * number(5), 0};
            s.strength_scale = number(6) < 0.2f ? 1e30f : 0.5f;
            (void)world.spawn(models.back(), s);
        } else if (choice < 0.55f) {
            (void)world.add_sphere(ball_at({2 * number(2) - 1, 0.5f * number(3), 0}, 2, 12));
        } else if (choice < 0.75f && any != floor) {
            ASSERT_TRUE(world.remove(any).ok());
        } else if (choice < 0.85f) {
            const Vec3 place = world.pose(any).value().position;
            ASSERT_TRUE(world.apply_impulse(any, {0.1f * number(2), 0.1f * number(3), 0.1f * number(4)}, place).ok());
        }
        for (int frame = 0; frame < 2; ++frame) world.step();
    }
    opened = world.contents().data.counts.opened;
    EXPECT_GT(opened, 3u);
    remove_everything(world, models);
    EXPECT_EQ(pools_hash(world), pools_hash(fresh));
    for (const uint8_t held : std::span(state_of(world).bodies.hold_count.data(), state_of(world).bodies.size()))
        EXPECT_EQ(held, 0);
}

}  // namespace
}  // namespace cullet::test
