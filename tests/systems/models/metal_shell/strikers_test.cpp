// What strikes metal in a world has its true shape: poles, walls, boxes, other bodies.
#include <gtest/gtest.h>

#include <cmath>

#include "components/body_id.hpp"
#include "sample_game/meshes.hpp"
#include "tests/systems/models/metal_shell/panels.hpp"

namespace cullet {
namespace {

template <class T>
T value_of(Result<T> result) {
    if (!result) ADD_FAILURE() << result.error(), std::abort();
    return std::move(result).value();
}

Settings settings_on(uint32_t threads) {
    Settings settings = test::small_settings();
    settings.gravity = {};
    settings.threads = threads;
    return settings;
}

/// A closed box of 1.2 x 0.8 x 0.8 m, its middle at the origin.
const Model& crate() {
    static const Model model = [] {
        Mesh mesh = test::box_mesh({1.2, 0.8, 0.8}, 24);
        for (Vec3& p : mesh.positions) p = p - Vec3{0.6f, 0.4f, 0.4f};
        return test::cook_metal(mesh);
    }();
    return model;
}

struct Crashed {
    std::unique_ptr<World> world;
    BodyId body;
    MetalView metal() const {
        auto& state = const_cast<State&>(world->contents().data.state);
        return {state, state.bodies.structure[body_row(state.bodies, body)]};
    }
    Vec3 place(uint32_t v) const { return metal().shell.state.vertices.rest[metal().shell.vertex(v)]; }
    Vec3 original(uint32_t v) const { return metal().vertices().original[metal().vertex(v)]; }
    /// Along x, of vertices of the end at +x that stood at so much z and anywhere near y = 0.
    double depth_at(double z) const {
        double most = 0;
        for (uint32_t v = 0; v < metal().vertex_count(); ++v) {
            const Vec3 p = original(v);
            if (p.x < 0.599f || std::fabs(p.y) > 0.1f || std::fabs(double{p.z} - z) > 0.025) continue;
            most = std::max(most, double{p.x} - double{place(v).x});
        }
        return most;
    }
};

/// The crate flies along +x into whatever `build` puts in the way at x = 0.65 and beyond.
template <class Build>
Crashed crash(float speed, uint32_t threads, Build build, int frames = 8) {
    Crashed made;
    made.world = std::make_unique<World>(test::make_world(settings_on(threads)));
    build(*made.world);
    SpawnSettings settings;
    settings.motion.velocity = {speed, 0, 0};
    made.body = value_of(made.world->spawn(value_of(made.world->add_model(crate())), settings));
    for (int frame = 0; frame < frames; ++frame) made.world->step();
    return made;
}

void add_mesh(World& world, Mesh mesh, Vec3 by) {
    for (Vec3& p : mesh.positions) p = p + by;
    ASSERT_TRUE(world.add_static(test::view_of_mesh(mesh)).ok());
}

TEST(Strikers, AWallLeavesAFlatFront) {
    const Crashed c = crash(10, 1, [](World& w) { add_mesh(w, make_box({0.2f, 2, 2}), {0.85f, 0, 0}); });
    const double deep = c.depth_at(0);
    ASSERT_GT(deep, 0.01);
    // Nothing stands out; folds go in.
    for (const double z : {-0.3, -0.15, 0.15, 0.3}) {
        EXPECT_GT(c.depth_at(z), deep - 2e-3) << z;
        EXPECT_LT(c.depth_at(z), deep + 0.02) << z;
    }
}

TEST(Strikers, AnUprightPoleLeavesAV) {
    const Crashed c = crash(10, 1, [](World& w) { add_mesh(w, make_pole(0.1f, 3), {0.75f, -1.5f, 0}); });
    const double deep = c.depth_at(0);
    ASSERT_GT(deep, 0.03);
    EXPECT_LT(c.depth_at(0.3), 0.8 * deep);
    EXPECT_LT(c.depth_at(-0.3), 0.8 * deep);
    EXPECT_GT(c.depth_at(0.1), c.depth_at(0.3));
    EXPECT_NEAR(c.depth_at(0.2), c.depth_at(-0.2), 0.25 * deep);
    EXPECT_EQ(test::state_of(*c.world).validate(), "");
}

TEST(Strikers, TheEdgeOfAWallLeavesTheOtherHalfLessDeep) {
    const Crashed c = crash(10, 1, [](World& w) { add_mesh(w, make_box({0.2f, 2, 1}), {0.85f, 0, 1.1f}); });
    EXPECT_GT(c.depth_at(0.3), 0.02);
    EXPECT_LT(c.depth_at(-0.35), 0.6 * c.depth_at(0.3));
}

TEST(Strikers, AKinematicBoxAndAnotherBodyAreSeenAsTheyAre) {
    const Crashed box = crash(10, 1, [](World& w) {
        KinematicSettings post;
        post.pose.position = {0.85f, 0, 0}, post.half_extents = {0.2f, 2, 0.1f};
        ASSERT_TRUE(w.add_kinematic_box(post).ok());
    });
    EXPECT_GT(box.depth_at(0), 0.02);
    EXPECT_LT(box.depth_at(0.35), 0.8 * box.depth_at(0));
    const Crashed other = crash(10, 1, [](World& w) {
        SpawnSettings settings;
        settings.pose.position = {1.27f, 0, 0};
        settings.is_breakable = false;
        (void)value_of(w.spawn(value_of(w.add_model(crate())), settings));
    });
    EXPECT_GT(other.depth_at(0), 1e-3);
    EXPECT_NEAR(other.depth_at(0.2), other.depth_at(0), 5e-3);
}

/// The crate turns as it flies, and comes to what stands at x = 1.2 and beyond some frames later.
Crashed crash_from_afar(uint32_t frames_ahead, Mesh obstacle, Vec3 by) {
    Settings settings = settings_on(1);
    settings.frames_ahead = frames_ahead;
    Crashed made;
    made.world = std::make_unique<World>(test::make_world(settings));
    add_mesh(*made.world, std::move(obstacle), by);
    SpawnSettings thrown;
    thrown.motion.velocity = {8, 0, 0}, thrown.motion.angular_velocity = {0, 0, 1};
    made.body = value_of(made.world->spawn(value_of(made.world->add_model(crate())), thrown));
    for (int frame = 0; frame < 12; ++frame) made.world->step();
    return made;
}

TEST(Strikers, AForeseenTouchLeavesTheDentOfOneThatIsNot) {
    const std::pair<Mesh, Vec3> obstacles[] = {{make_pole(0.1f, 3), {1.3f, -1.5f, 0}},
                                               {make_box({0.2f, 2, 1}), {1.4f, 0, 1.1f}},
                                               {make_box({0.2f, 2, 2}), {1.4f, 0, 0}}};
    for (const auto& [mesh, by] : obstacles) {
        const Crashed now = crash_from_afar(0, mesh, by), ahead = crash_from_afar(8, mesh, by);
        EXPECT_EQ(now.world->contents().data.counts.ahead_hits, 0u);
        EXPECT_GT(ahead.world->contents().data.counts.ahead_hits, 0u);
        double deepest = 0, apart = 0;
        for (uint32_t v = 0; v < now.metal().vertex_count(); ++v) {
            deepest = std::max(deepest, double{length(now.place(v) - now.original(v))});
            apart = std::max(apart, double{length(now.place(v) - ahead.place(v))});
        }
        EXPECT_GT(deepest, 0.02);
        EXPECT_LT(apart, 0.02 * deepest);
    }
}

TEST(Strikers, AnyNumberOfThreadsAndALoadedWorldGiveTheSameBytes) {
    const auto build = [](World& w) { add_mesh(w, make_pole(0.1f, 3), {0.75f, -1.5f, 0.05f}); };
    const Crashed one = crash(10, 1, build);
    for (const uint32_t threads : {2u, 3u, 8u}) EXPECT_EQ(crash(10, threads, build).world->hash(), one.world->hash());
    for (const int frames : {4, 5, 6, 7}) {
        Crashed early = crash(10, 1, build, frames);
        const std::vector<uint8_t> bytes = value_of(early.world->snapshot());
        World loaded = test::make_world(settings_on(2));
        ASSERT_TRUE(loaded.restore(bytes.data(), bytes.size()).ok());
        for (int frame = frames; frame < 10; ++frame) {
            loaded.step(), early.world->step();
            ASSERT_EQ(loaded.hash(), early.world->hash()) << frames << " " << frame;
        }
    }
}

}  // namespace
}  // namespace cullet
