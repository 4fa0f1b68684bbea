// Blows on a body whose hit is still worked off, and what its pieces get of them.
#include <gtest/gtest.h>

#include <cmath>

#include "systems/damage/explosion.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// A vase whose hit takes several frames, after the first of them.
struct Waiting {
    World world;
    BodyId vase;
    Vec3 place;  // where it was struck

    explicit Waiting(Settings settings) : world(make_world(settings)) {
        vase = world.spawn(world.add_model(small_vase()).value()).value();
        place = state_of(world).bodies.centre[vase.index].to_float() + Vec3{0, 0, 0.1f};
        EXPECT_TRUE(world.push_impact(vase, push(10)).ok());
        world.step();
        EXPECT_EQ(open_tasks(world), 1u);
    }
    PushSettings push(float speed) const {
        PushSettings push;
        push.place = place;
        push.normal = {0, 0, -1};
        push.approach_speed = speed;
        push.mass = 0.3f;
        push.radius = 0.03f;
        return push;
    }
};

Settings sliced_settings() {
    Settings settings = small_settings();
    settings.units_a_frame = 1'500'000;
    return settings;
}

TEST(WaitingBlows, APushOnWhatBecomesACrumbStrikesNothingElse) {
    Settings settings = sliced_settings();
    settings.debris_elements = 1'000'000;  // all but the largest piece are crumbs
    Waiting w(settings);
    const float body_height = w.world.pose(w.vase)->position.y;
    ASSERT_TRUE(w.world.push_impact(w.vase, w.push(8)).ok());
    for (int frame = 0; frame < 100; ++frame) w.world.step();
    ASSERT_EQ(w.world.contents().data.counts.broke, 1u);
    const State& state = state_of(w.world);
    const ShellView shell(state_of(w.world), state.bodies.shell[w.vase.index]);
    const Vec3 in_body = w.place - Vec3{0, body_height, 0};
    float nearest = 1;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        if (state.vertices.element[shell.vertex(v)] != kNone)
            nearest = std::min(nearest, length(state.vertices.rest[shell.vertex(v)] - in_body));
    ASSERT_GT(nearest, 0.06f) << "the struck wall is gone";
    EXPECT_EQ(w.world.contents().data.counts.opened, 1u) << "what is left was not struck";
    EXPECT_EQ(state.blows.size(), 0u);
}

TEST(WaitingBlows, EachPieceIsToldItsOwnShareOfAnExplosionsEnergy) {
    Waiting w(sliced_settings());
    const State& state = state_of(w.world);
    const double mass = w.world.mass(w.vase).value();
    ExplosionSettings e;
    e.centre = w.place + Vec3{0, 0, 0.1f};
    e.impulse = 100;
    const Pose pose = w.world.pose(w.vase).value();
    const Explosion explosion{to_body(pose, e.centre), e.radius, e.impulse};
    const double impulse = length(
        measure_explosion(ShellView(state_of(w.world), state.bodies.shell[w.vase.index]), explosion, {}).impulse);
    ASSERT_TRUE(w.world.explode(e).ok());
    uint32_t told = 0;
    double sum = 0;
    for (int frame = 0; frame < 200; ++frame) {
        double masses[512] = {};
        after_each_system(w.world, [&](const std::string& system) {
            if (system != "open_tasks") return;
            for (const BodyId id : shells_of(w.world)) masses[id.index] = w.world.mass(id).value();
        });
        w.world.step();
        for (const ImpactEvent& event : w.world.events().impacts) {
            const double own = impulse / mass * impulse / mass * masses[event.body.index] / 2;
            EXPECT_NEAR(event.energy, own, 1e-3 * own);
            sum += event.energy;
            ++told;
        }
    }
    EXPECT_GT(told, 2u);
    EXPECT_LE(sum, impulse * impulse / mass / 2 * 1.001);
}

}  // namespace
}  // namespace cullet::test
