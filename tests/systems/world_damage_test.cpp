// Which hits are looked at, what stays with the body, what fragments inherit.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "components/state.hpp"
#include "systems/bodies/thresholds.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// T9 and T11 on the shells of a world: masses agree, and each live element hangs together with all others of its body
/// unless pieces were refused.
void expect_sound_shells(World& world) {
    State& state = state_of(world);
    for (const BodyId id : shells_of(world)) {
        const Row<Structures> shell = state.bodies.structure[id.index];
        double elements = 0, vertices = 0, sound = 0, volume = 0;  // the last two without flat elements
        const Range e = state.shells.elements[state.shell_of(shell)], v = state.shells.vertices[state.shell_of(shell)];
        for (uint32_t i = e.first; i < e.first + e.count; ++i) {
            if (state.elements.flags[i] & kDead) continue;
            elements += state.elements.mass[i];
            if (state.elements.flags[i] & kDegenerate) continue;
            sound += state.elements.mass[i];
            volume += state.elements.volume[i];
        }
        for (uint32_t i = v.first; i < v.first + v.count; ++i) vertices += state.vertices.mass[i];
        const double density = state.materials.density[state.structures.material[shell]];
        EXPECT_NEAR(elements, vertices, 1e-12 * elements);
        EXPECT_NEAR(sound, density * volume, 1e-12 * sound);  // flat elements keep a lamina's mass
        EXPECT_NEAR(elements, world.mass(id).value(), 1e-9 * elements);
    }
}

TEST(WorldDamage, MassesOfElementsVerticesAndBodiesAgreeAfterEveryBreak) {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    Breakage b = vase_and_ball(settings);
    (void)b.world.add_static(view_of_mesh(Mesh{"floor",
                                               {{-3, -0.5f, -3}, {-3, -0.5f, 3}, {3, -0.5f, 3}, {3, -0.5f, -3}},
                                               {{0, 1, 2}, {0, 2, 3}},
                                               {},
                                               {},
                                               {}}));
    for (int frame = 0; frame < 60; ++frame) {
        b.world.step();
        if (b.world.events().fragments_born.count) expect_sound_shells(b.world);
    }
    expect_sound_shells(b.world);
    EXPECT_GT(shells_of(b.world).size(), 3u);
}

TEST(WorldDamage, AVetoLetsTheHitPassAsBetweenRigidBodies) {
    Breakage b = vase_and_ball(small_settings());
    static int asked = 0;
    asked = 0;
    b.world.set_veto(
        [](void* user, const ImpactEvent& e) {
            ++asked;
            EXPECT_EQ(user, &asked);
            EXPECT_EQ(e.body_user_data, 42u);
            EXPECT_EQ(e.striker_user_data, 99u);
            EXPECT_GT(e.approach_speed, 7);
            EXPECT_GT(e.energy, 0);
            EXPECT_NEAR(length(e.normal), 1, 1e-5f);
            return false;
        },
        &asked);
    for (int frame = 0; frame < 30; ++frame) b.world.step();
    EXPECT_GT(asked, 0);
    EXPECT_EQ(b.world.contents().data.counts.opened, 0u);
    EXPECT_GT(b.world.motion(b.body).value().velocity.z * -1, 0.1f);  // it was pushed
}

TEST(WorldDamage, ImpactAndCrackEventsSayWhereAndWhetherBodiesAreHeld) {
    Settings settings = small_settings();
    settings.units_a_frame = 2'000'000;
    Breakage b = vase_and_ball(settings);
    uint32_t impacts = 0, cracks = 0;
    for (int frame = 0; frame < 30; ++frame) {
        b.world.step();
        for (const ImpactEvent& e : b.world.events().impacts) {
            if (e.body != b.body || impacts++) continue;
            EXPECT_EQ(e.striker, b.ball);
            EXPECT_TRUE(e.is_held);
            EXPECT_LT(length(e.place - Vec3{0.01f, 0.13f, 0.085f}), 0.05f);
            EXPECT_LT(e.normal.z, -0.5f);  // pushed along the ball's flight
        }
        for (const CrackStartedEvent& e : b.world.events().cracks_started) {
            ++cracks;
            EXPECT_EQ(e.body, b.body);
            EXPECT_EQ(e.body_user_data, 42u);
            EXPECT_LT(length(e.place), 0.5f);
        }
        if (b.world.events().fragments_born.count) break;
    }
    EXPECT_GT(impacts, 0u);
    EXPECT_GT(cracks, 0u);
    b.world.step();
    EXPECT_EQ(b.world.events().cracks_started.count, 0u);  // good until the next step, and gone then
}

TEST(WorldDamage, EventsAreGoodAfterTheGameRemovesTheirBodies) {
    Breakage b = vase_and_ball(small_settings());
    ASSERT_GT(step_until_born(b.world, 10), 0u);
    const StepEvents events = b.world.events();
    for (const FragmentBornEvent& e : events.fragments_born) ASSERT_TRUE(b.world.remove(e.fragment).ok());
    for (const FragmentBornEvent& e : events.fragments_born) EXPECT_GT(e.mass, 0);
}

TEST(WorldDamage, InfiniteStrengthOrUnbreakableNeverOpensATask) {
    for (const bool is_infinite : {true, false}) {
        World world = make_world(small_settings());
        expect_valid_after_each_system(world);
        SpawnSettings vase;
        if (is_infinite) vase.strength_scale = std::numeric_limits<float>::infinity();
        vase.is_breakable = is_infinite;
        (void)world.spawn(world.add_model(small_vase()).value(), vase).value();
        (void)world.add_sphere(ball_at({0.01f, 0.13f, 0}, 0.3f, 30)).value();
        for (int frame = 0; frame < 30; ++frame) world.step();
        EXPECT_EQ(world.contents().data.counts.opened, 0u);
        EXPECT_EQ(world.bodies(nullptr, 0), 2u);
    }
}

TEST(WorldDamage, AWeakBodyIsLookedAtAtASlowerBlowAndAStrongOneAtAFaster) {
    const float crack = small_vase().report().first_crack_speed;
    ASSERT_GT(crack, 0);
    const auto opened = [&](float scale, float speed) {
        World world = make_world(small_settings());
        SpawnSettings vase;
        vase.strength_scale = scale;
        (void)world.spawn(world.add_model(small_vase()).value(), vase).value();
        SphereSettings ball = ball_at({0.01f, 0.13f, 0}, 0.3f, speed);
        ball.pose.position.z = 0.125f;
        (void)world.add_sphere(ball).value();
        for (int frame = 0; frame < 200 && world.contents().data.counts.opened == 0; ++frame) world.step();
        return world.contents().data.counts.opened > 0;
    };
    EXPECT_TRUE(opened(1, 0.4f * crack));
    EXPECT_FALSE(opened(1, 0.2f * crack));
    EXPECT_TRUE(opened(0.3f, 0.2f * crack));
    EXPECT_FALSE(opened(2, 0.4f * crack));
}

TEST(WorldDamage, FragmentsInheritWhatTheGameSet) {
    World world = make_world(small_settings());
    SpawnSettings vase;
    vase.user_data = 7;
    vase.strength_scale = 0.8f;
    vase.contact.friction = 0.31f, vase.contact.restitution = 0.11f, vase.contact.layer = 4, vase.contact.mask = 0xffu;
    const BodyId body = world.spawn(world.add_model(small_vase()).value(), vase).value();
    (void)world.add_sphere(ball_at({0.01f, 0.13f, 0}, 0.3f, 8)).value();
    ASSERT_GT(step_until_born(world, 10), 0u);
    const Bodies& bodies = state_of(world).bodies;
    for (const BodyId id : shells_of(world)) {
        EXPECT_EQ(world.user_data(id).value(), 7u);
        EXPECT_EQ(bodies.strength_scale[id.index], 0.8f);
        EXPECT_EQ(bodies.friction[id.index], 0.31f);
        EXPECT_EQ(bodies.restitution[id.index], 0.11f);
        EXPECT_EQ(bodies.layer[id.index], 4u);
        EXPECT_EQ(bodies.mask[id.index], 0xffu);
        EXPECT_EQ(bodies.parent[id.index].exists(), id != body);
    }
}

TEST(WorldDamage, BodiesOnLayersThatDoNotMeetPassThroughEachOther) {
    World world = make_world(small_settings());
    SpawnSettings vase;
    vase.contact.layer = 2;
    vase.contact.mask = 2;
    (void)world.spawn(world.add_model(small_vase()).value(), vase).value();
    const BodyId ball = world.add_sphere(ball_at({0.01f, 0.13f, 0}, 0.3f, 8)).value();
    for (int frame = 0; frame < 20; ++frame) world.step();
    EXPECT_NEAR(world.motion(ball).value().velocity.z, -8, 1e-4f);
    EXPECT_EQ(world.contents().data.counts.opened, 0u);
}

TEST(WorldDamage, ACrackedBodyKeepsItsCracksAndWakesAtHalfTheSpeed) {
    bool is_found = false;
    for (float speed = 0.5f; speed < 6 && !is_found; speed *= 1.05f) {
        Breakage b = wall_and_ball(small_settings(), speed);
        const DamageCounts& counts = b.world.contents().data.counts;
        const State& state = state_of(b.world);
        const float wake = wake_speed(state.structures, state.bodies.structure[b.body.index], 1);
        for (int frame = 0; frame < 40 && counts.opened == 0; ++frame) b.world.step();
        if (counts.cuts == 0 || counts.broke > 0) continue;
        is_found = true;
        const Row<Structures> shell = state.bodies.structure[b.body.index];
        EXPECT_EQ(state.structures.has_cracks[shell], 1);
        EXPECT_EQ(state.structures.generation[shell], 0);
        EXPECT_FLOAT_EQ(wake_speed(state.structures, shell, 1), 0.5f * wake);
        uint32_t cracked = 0;
        const Range v = state.shells.vertices[state.shell_of(shell)];
        for (uint32_t i = v.first; i < v.first + v.count; ++i) cracked += state.vertices.crack[i] != 0;
        EXPECT_GT(cracked, 0u);
        EXPECT_EQ(b.world.view(b.body).value().stamp, 2u);
        EXPECT_GT(b.world.view(b.body).value().runs[2].index_count, 0u);  // the cracks are drawn
        // A second, hard blow goes on from there.
        ASSERT_TRUE(b.world.remove(b.ball).ok());
        for (int frame = 0; frame < 3; ++frame) b.world.step();  // none is looked at within 20 ms
        (void)b.world.add_sphere(ball_at({0.1f, 0.5f, 0}, 20, 14, 0.12f)).value();
        EXPECT_GT(step_until_born(b.world, 60), 0u);
    }
    EXPECT_TRUE(is_found);
}

TEST(WorldDamage, APinnedWallStaysWhereItIsPinnedAndItsHoleIsAHoleForWhatFlies) {
    Breakage b = wall_and_ball(small_settings(), 14);
    for (int frame = 0; frame < 30; ++frame) b.world.step();
    State& state = state_of(b.world);
    const Bodies& bodies = state.bodies;
    uint32_t pinned = 0, loose = 0;
    ASSERT_TRUE(b.world.remove(b.ball).ok());
    std::vector<Vec3> standing;
    for (const BodyId id : shells_of(b.world)) {
        const bool is_pinned = bodies.has_pins[id.index];
        EXPECT_EQ(is_pinned, static_cast<BodyKind>(bodies.kind[id.index]) == BodyKind::Static);
        ++(is_pinned ? pinned : loose);
        if (!is_pinned) {
            ASSERT_TRUE(b.world.remove(id).ok());
            continue;
        }
        EXPECT_EQ(length(bodies.velocity[id.index]), 0);
        EXPECT_EQ(length(b.world.pose(id).value().position), 0);
        const Range v = state.shells.vertices[state.shell_of(bodies.structure[id.index])];
        for (uint32_t i = v.first; i < v.first + v.count; ++i)
            if (state.vertices.element[i] != kNone) standing.push_back(state.vertices.rest[i]);
    }
    EXPECT_GT(pinned, 0u);
    ASSERT_GT(loose, 0u);
    // The place of the intact wall that is farthest from what stands.
    Vec3 hole;
    float widest = 0;
    for (float x = -0.4f; x < 0.41f; x += 0.05f)
        for (float y = 0.2f; y < 0.71f; y += 0.05f) {
            float nearest = 10;
            for (const Vec3 p : standing) nearest = std::min(nearest, length(p - Vec3{x, y, 0}));
            if (nearest > widest) widest = nearest, hole = {x, y, 0};
        }
    ASSERT_GT(widest, 0.12f);
    const BodyId pellet = b.world.add_sphere(ball_at(hole, 0.1f, 20, 0.02f)).value();
    for (int frame = 0; frame < 30; ++frame) b.world.step();
    EXPECT_LT(b.world.pose(pellet).value().position.z, -1);
    EXPECT_NEAR(b.world.motion(pellet).value().velocity.z, -20, 1e-3f);
}

TEST(WorldDamage, FragmentsBreakAgainButNotBeyondTheLastGeneration) {
    for (const uint32_t generations : {0u, 1u, 3u}) {
        Settings settings = small_settings();
        settings.gravity = {0, -9.81f, 0};
        settings.generations = generations;
        Breakage b = vase_and_ball(settings, 10);
        const Vec3 corners[] = {{-3, -0.7f, -3}, {-3, -0.7f, 3}, {3, -0.7f, 3}, {3, -0.7f, -3}};
        const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
        (void)b.world.add_static({corners, 4, quad, 2}).value();
        uint32_t most = 0;
        std::map<uint32_t, uint64_t> last_try;
        for (int frame = 0; frame < 80; ++frame) {
            b.world.step();
            for (const FragmentBornEvent& e : b.world.events().fragments_born) most = std::max(most, e.generation);
            for (const ImpactEvent& e : b.world.events().impacts) {
                const auto before = last_try.find(e.body.index);
                EXPECT_TRUE(before == last_try.end() || static_cast<uint64_t>(frame) >= before->second + 2);  // 20 ms
                last_try[e.body.index] = static_cast<uint64_t>(frame);
            }
        }
        EXPECT_GE(most, generations == 0 ? 1u : 2u * (generations > 1) + (generations == 1));
        EXPECT_LE(most, std::max(1u, generations));
    }
}

}  // namespace
}  // namespace cullet::test
