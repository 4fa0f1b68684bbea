// What loses its support falls: a tower whose foot is shot away comes down in pieces that hit each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "components/body_id.hpp"
#include "components/state.hpp"
#include "sample_game/meshes.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

constexpr float kHeight = 6;

/// Highest drawn point of all bodies, world.
float top_of(const World& world) {
    float top = -1e9f;
    for (const BodyId id : shells_of(world)) {
        const Result<BodyView> view = world.view(id);
        for (uint32_t v = 0; v < view->vertex_count; ++v)
            top = std::max(top, to_world(view->pose, view->vertices[v].position).y);
    }
    return top;
}

struct Standing {
    World world;
    BodyId tower;

    Standing() : world(make_world(settings())) {
        CookSettings cooking;
        cooking.material = "brick";
        cooking.thickness = 0.22f;
        cooking.longest_edge = 100;
        const Mesh mesh = make_building({.width = 3,
                                         .depth = 3,
                                         .height = kHeight,
                                         .roof = 1.5f,
                                         .edge = 0.6f,
                                         .is_round = true,
                                         .is_windowless = true});
        const Box foot{{-5, -0.1f, -5}, {5, 0.05f, 5}};
        SpawnSettings spawning;
        spawning.pose.position = {0, 0.001f, 0};
        spawning.pins = &foot;
        spawning.pin_count = 1;
        const Vec3 corners[] = {{-50, 0, -50}, {-50, 0, 50}, {50, 0, 50}, {50, 0, -50}};
        const uint32_t quad[] = {0, 1, 2, 0, 2, 3};
        (void)world.add_static({corners, 4, quad, 2}).value();
        tower = world.spawn(world.add_model(cook(view_of_mesh(mesh), cooking).value()).value(), spawning).value();
    }
    static Settings settings() {
        Settings settings = small_settings();
        settings.gravity = {0, -9.81f, 0};
        settings.units_a_frame = 50'000'000;
        return settings;
    }
};

TEST(Collapse, AWholeTowerStands) {
    Standing s;
    const float before = top_of(s.world);
    EXPECT_NEAR(before, kHeight + 1.5f, 0.01f);
    for (int frame = 0; frame < 60; ++frame) s.world.step();
    EXPECT_EQ(top_of(s.world), before);
    EXPECT_EQ(s.world.report().fragments, 0u);
}

TEST(Collapse, ATowerWhoseFootIsShotAwayComesDownInPiecesThatHitEachOther) {
    Standing s;
    const float before = top_of(s.world);
    uint32_t hits_between_pieces = 0;
    for (int frame = 0; frame < 480; ++frame) {
        // Round the foot, one shot after the other.
        if (frame % 10 == 0 && frame < 160) {
            const Vec3 places[] = {{1.2f, 0, 0}, {-1.2f, 0, 0}, {0, 0, 1.2f}, {0, 0, -1.2f}};
            const Vec3 at = places[frame / 10 % 4] + Vec3{0, 0.6f, 0};
            ASSERT_TRUE(s.world.explode({.centre = at, .radius = 2.5f, .impulse = 12000}).ok());
        }
        s.world.step();
        const WorldData& d = s.world.contents().data;
        const auto is_piece = [&](RigidId id) {
            return id < d.state.bodies.size() && d.state.bodies.structure[id].exists();
        };
        for (const RigidContact& c : d.rigid->contacts())
            hits_between_pieces += is_piece(c.a) && is_piece(c.b) && c.approach_speed > 0.5f;
    }
    const float after = top_of(s.world);
    std::printf("%u pieces; the top came from %.2f m to %.2f m; %u contacts between pieces above 0.5 m/s\n",
                s.world.report().fragments, before, after, hits_between_pieces);
    EXPECT_GT(s.world.report().fragments, 10u);
    EXPECT_LT(after, 0.6f * before);
    EXPECT_GT(hits_between_pieces, 20u);
    const State& state = state_of(s.world);
    for (const BodyId id : shells_of(s.world))
        EXPECT_GT(centre_of(state.bodies, Row<Bodies>(id.index)).y, 0) << id.index << " went through the ground";
}

}  // namespace
}  // namespace cullet::test
