// Blows on a body whose hit is still worked off, and what its pieces get of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "components/state.hpp"
#include "systems/structures/shell/explosion.hpp"
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

/// Rest places of the body's live vertices.
std::vector<Vec3> places_of(World& world, BodyId body) {
    const State& state = state_of(world);
    const ShellView shell(state_of(world), state.bodies.structure[body.index]);
    std::vector<Vec3> places;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        if (state.vertices.element[shell.vertex(v)] != kNone) places.push_back(state.vertices.rest[shell.vertex(v)]);
    return places;
}

/// The place of a body that is farthest from all of what is left of it.
Vec3 lost_place(const std::vector<Vec3>& before, const std::vector<Vec3>& left) {
    Vec3 lost;
    float farthest = 0;
    for (const Vec3 p : before) {
        float nearest = 1;
        for (const Vec3 q : left) nearest = std::min(nearest, length(p - q));
        if (nearest > farthest) farthest = nearest, lost = p;
    }
    EXPECT_GT(farthest, 0.02f);
    return lost;
}

TEST(WaitingBlows, APushOnWhatBecomesDebrisStrikesNothingElse) {
    Settings settings = sliced_settings();
    settings.debris_elements = 1'000'000;  // all but the largest piece is debris
    Waiting twin(settings);
    const std::vector<Vec3> before = places_of(twin.world, twin.vase);
    for (int frame = 0; frame < 100; ++frame) twin.world.step();
    const std::vector<Vec3> left = places_of(twin.world, twin.vase);
    const auto tasks_after_push_at = [&](Vec3 place) {
        Waiting w(settings);
        PushSettings push = w.push(8);
        push.place = place;
        EXPECT_TRUE(w.world.push_impact(w.vase, push).ok());
        for (int frame = 0; frame < 100; ++frame) w.world.step();
        EXPECT_GE(w.world.contents().data.counts.broke, 1u);
        EXPECT_EQ(state_of(w.world).blows.size(), 0u);
        return w.world.contents().data.counts.opened;
    };
    EXPECT_EQ(tasks_after_push_at(lost_place(before, left)), 1u);
    EXPECT_EQ(tasks_after_push_at(left[0]), 2u) << "what stays is struck";
}

TEST(WaitingBlows, EachPieceIsToldItsOwnShareOfAnExplosionsEnergy) {
    Settings settings = sliced_settings();
    settings.break_share = 0;
    settings.break_elements = 0;
    Waiting w(settings);
    const State& state = state_of(w.world);
    const double mass = w.world.mass(w.vase).value();
    ExplosionSettings e;
    e.centre = w.place + Vec3{0, 0, 0.1f};
    e.impulse = 100;
    const Pose pose = w.world.pose(w.vase).value();
    const Explosion explosion{to_body(pose, e.centre), e.radius, e.impulse};
    const double impulse = length(
        measure_explosion(ShellView(state_of(w.world), state.bodies.structure[w.vase.index]), explosion, {}).impulse);
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
            if (w.world.is_alive(event.striker)) continue;  // pieces that strike each other
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
