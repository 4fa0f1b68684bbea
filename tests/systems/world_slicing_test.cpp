// In a world, one hit gives the same cracks, pieces and velocities however its units are sliced into frames.
#include <gtest/gtest.h>

#include <limits>

#include "components/state.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

constexpr uint64_t kSlices[] = {1'000, 8'000'000,
                                1'000'000'000'000};  // one step a frame, the everyday budget, all at once

Settings sliced(uint64_t units_a_frame) {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    settings.units_a_frame = units_a_frame;
    return settings;
}

/// What the first break left behind. A held body does not move, so world axes serve for its frame at the touch.
struct Break {
    std::vector<uint8_t> bytes;
    uint32_t pieces = 0, frames = 0, frames_held = 0, cuts = 0;
};

Break first_break(World& world) {
    Break found;
    World* w = &world;
    const auto add = [&found](const auto& value) {
        const auto* first = reinterpret_cast<const uint8_t*>(&value);
        found.bytes.insert(found.bytes.end(), first, first + sizeof value);
    };
    after_each_system(world, [&](const std::string& system) {
        const DamageCounts& counts = w->contents().data.counts;
        if (system != "make_births" || found.pieces > 0 || counts.broke == 0) return;
        found.frames_held = static_cast<uint32_t>(counts.frames_held);
        found.cuts = static_cast<uint32_t>(counts.cuts);
        const State& state = state_of(*w);
        const Bodies& bodies = state.bodies;
        for (uint32_t b = 0; b < bodies.size(); ++b) {
            if (static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Free) continue;
            add(bodies.position[b]), add(bodies.orientation[b]), add(bodies.velocity[b]), add(bodies.spin[b]);
            add(bodies.mass[b]);
            const Row<Structures> shell = bodies.structure[b];
            if (!shell.exists()) continue;
            ++found.pieces;
            const Range v = state.shells.vertices[state.shell_of(shell)],
                        e = state.shells.elements[state.shell_of(shell)];
            for (uint32_t i = v.first; i < v.first + v.count; ++i) {
                if (state.vertices.element[i] == kNone) continue;
                add(state.vertices.rest[i]), add(state.vertices.crack[i]), add(state.vertices.heading[i]);
                add(state.vertices.mass[i]);
            }
            for (uint32_t i = e.first; i < e.first + e.count; ++i)
                if (!(state.elements.flags[i] & kDead)) add(state.elements.corner[i]), add(state.elements.edge_kind[i]);
        }
        for (uint32_t d = 0; d < state.debris.size(); ++d)
            if (state.debris.is_used[d]) add(state.debris.position[d]), add(state.debris.velocity[d]);
    });
    for (; found.frames < 20'000 && found.pieces == 0; ++found.frames) world.step();
    return found;
}

template <class Make>
void expect_same_break(Make make) {
    Break first;
    for (const uint64_t units : kSlices) {
        World world = make(sliced(units));
        world.contents().data.damage_settings.hold_seconds = 100;  // a game may ask for 1 at most
        const Break found = first_break(world);
        std::printf("%llu units a frame: %u pieces, %u cuts after %u frames, %u of them held\n",
                    static_cast<unsigned long long>(units), found.pieces, found.cuts, found.frames, found.frames_held);
        ASSERT_GT(found.pieces, 1u);
        if (units == kSlices[0]) {
            first = found;
            EXPECT_GT(found.frames_held, 100u);
            continue;
        }
        EXPECT_LT(found.frames_held, first.frames_held);
        EXPECT_EQ(found.pieces, first.pieces);
        EXPECT_TRUE(found.bytes == first.bytes) << units << " units a frame";
    }
}

TEST(WorldSlicing, AVaseOnTheFloorBreaksAlikeHoweverItsUnitsAreSliced) {
    expect_same_break([](const Settings& settings) {
        World world = make_world(settings);
        add_floor(world);
        SpawnSettings vase;
        vase.pose.position = {0, 0.2f, 0};
        vase.pose.orientation = normalised(Quat{0.3f, 0.1f, 0.2f, 1});
        vase.motion.velocity = {0, -7, 0};
        vase.motion.angular_velocity = {1, 2, 0.5f};
        (void)world.spawn(world.add_model(small_vase()).value(), vase).value();
        return world;
    });
}

TEST(WorldSlicing, APaneAndItsBallToo) {
    expect_same_break([](const Settings& settings) { return std::move(pane_and_ball(settings).world); });
}

}  // namespace
}  // namespace cullet::test
