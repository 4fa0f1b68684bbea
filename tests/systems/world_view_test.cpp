// What the game draws: closed meshes, stamps, dirty ranges, poses; and that a step asks for no memory.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <vector>

#include "components/state.hpp"
#include "sample_game/allocations.hpp"
#include "systems/structures/shell/draw_shell.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

void expect_closed(World& world, BodyId id) {
    State& state = state_of(world);
    const Bodies& bodies = state.bodies;
    const Result<void> closed =
        check_drawn_mesh(ShellView(state, bodies.structure[id.index]), {state.view_vertices, state.view_indices},
                         bodies.view_vertices[id.index], bodies.view_indices[id.index]);
    EXPECT_TRUE(closed.ok()) << closed.error();
    const BodyView view = world.view(id).value();
    uint32_t next = 0;
    for (uint32_t r = 0; r < view.run_count; ++r) {
        const MaterialRun& run = view.runs[r];
        EXPECT_EQ(run.first_index, next);
        next += run.index_count;
    }
    EXPECT_EQ(next, view.index_count);
    for (uint32_t i = 0; i < view.vertex_count; ++i)
        ASSERT_NEAR(length(view.vertices[i].normal), 1, 1e-3f) << "vertex " << i;
}

/// What is not dirty is as it was.
void expect_same_outside(const BodyView& view, const std::vector<ViewVertex>& vertices,
                         const std::vector<uint32_t>& indices) {
    const auto is_in = [](DirtyRange range, uint32_t i) { return i >= range.first && i - range.first < range.count; };
    for (uint32_t i = 0; i < view.vertex_count; ++i)
        if (!is_in(view.dirty_vertices, i)) {
            ASSERT_LT(i, vertices.size());
            ASSERT_EQ(std::memcmp(&view.vertices[i], &vertices[i], sizeof(ViewVertex)), 0) << "vertex " << i;
        }
    for (uint32_t i = 0; i < view.index_count; ++i)
        if (!is_in(view.dirty_indices, i)) {
            ASSERT_LT(i, indices.size());
            ASSERT_EQ(view.indices[i], indices[i]) << "index " << i;
        }
}

class EachView : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(VaseWallPane, EachView, testing::Values(0, 1, 2));

TEST_P(EachView, AreClosedAndChangeTheirStampOnlyWithTheMesh) {
    Settings settings = small_settings();
    settings.units_a_frame = 10'000'000;
    Breakage b = GetParam() == 0   ? vase_and_ball(settings)
                 : GetParam() == 1 ? wall_and_ball(settings)
                                   : pane_and_ball(settings);
    struct Seen {
        uint32_t stamp;
        uint64_t bytes;
        const ViewVertex* address;
        std::vector<ViewVertex> vertices;
        std::vector<uint32_t> indices;
    };
    std::map<std::pair<uint32_t, uint32_t>, Seen> seen;
    uint32_t changes = 0;
    for (int frame = 0; frame < 40; ++frame) {
        b.world.step();
        for (const BodyId id : shells_of(b.world)) {
            const BodyView view = b.world.view(id).value();
            uint64_t bytes = hash_bytes(view.vertices, view.vertex_count * sizeof(ViewVertex), 1);
            bytes = hash_bytes(view.indices, view.index_count * sizeof(uint32_t), bytes);
            const Seen now{view.stamp,
                           bytes,
                           view.vertices,
                           {view.vertices, view.vertices + view.vertex_count},
                           {view.indices, view.indices + view.index_count}};
            const auto [at, is_new] = seen.insert({{id.index, id.generation}, now});
            if (is_new || at->second.stamp != now.stamp) {
                expect_closed(b.world, id);
                if (frame > 0) {
                    ++changes;
                    EXPECT_GT(view.dirty_vertices.count, 0u);
                    EXPECT_LE(view.dirty_vertices.first + view.dirty_vertices.count, view.vertex_count);
                    if (is_new) {
                        EXPECT_EQ(view.dirty_vertices.count, view.vertex_count);
                        EXPECT_EQ(view.dirty_indices.count, view.index_count);
                    } else {
                        expect_same_outside(view, at->second.vertices, at->second.indices);
                    }
                }
            } else {
                EXPECT_EQ(at->second.bytes, bytes);
                EXPECT_EQ(at->second.address, view.vertices);
                EXPECT_EQ(view.dirty_vertices.count, 0u);
            }
            at->second = now;
        }
    }
    EXPECT_GT(changes, 2u);
}

TEST(Views, OfNewPiecesBeginWhereTheirParentWas) {
    Settings settings = small_settings();
    settings.gravity = {0, -9.81f, 0};
    Breakage b = vase_and_ball(settings);
    Pose before;
    for (int frame = 0; frame < 10; ++frame) {
        before = b.world.pose(b.body).value();
        b.world.step();
        for (const FragmentBornEvent& e : b.world.events().fragments_born) {
            const BodyView view = b.world.view(e.fragment).value();
            EXPECT_LT(length(view.pose_before.position - before.position), 1e-5f);
            EXPECT_LT(length(view.pose.position - view.pose_before.position), 0.6f);
        }
        EXPECT_LT(length(b.world.view(b.body).value().pose_before.position - before.position), 1e-5f);
        if (b.world.events().fragments_born.count) return;
    }
    FAIL() << "nothing broke";
}

TEST(Views, ABodyPutElsewhereIsNotDrawnOnTheWayThere) {
    World world = make_world(small_settings());
    const BodyId ball = world.add_sphere({}).value();
    ASSERT_TRUE(world.set_pose(ball, {{4, 5, 6}, {}}).ok());
    EXPECT_EQ(world.view(ball).value().pose_before.position.x, 4);
    EXPECT_EQ(world.view(ball).value().vertex_count, 0u);
}

TEST(Views, DrawnVolumesOfThePiecesSumToTheWholes) {
    Breakage b = vase_and_ball(small_settings());
    const auto volume_of = [&](BodyId id) {
        const BodyView view = b.world.view(id).value();
        double six = 0;
        for (uint32_t i = 0; i < view.index_count; i += 3) {
            const Vec3d p(view.vertices[view.indices[i]].position), q(view.vertices[view.indices[i + 1]].position),
                r(view.vertices[view.indices[i + 2]].position);
            six += dot(p, cross(q, r));
        }
        return six / 6;
    };
    const double whole = volume_of(b.body), density = b.world.mass(b.body).value() / whole;
    ASSERT_GT(step_until_born(b.world, 10), 0u);
    double sum = 0;
    for (const BodyId id : shells_of(b.world)) sum += volume_of(id);
    EXPECT_NEAR(sum + matter_of(b.world).debris_mass / density, whole, 1e-4 * whole);
}

TEST(Allocations, AStepMakesNoneOfOursFromFrameThirtyOnEvenWhereThingsBreak) {
    for (const uint32_t threads : {1u, 2u, 3u}) {
        Settings settings = small_settings();
        settings.gravity = {};
        settings.units_a_frame = 4'000'000;
        settings.threads = threads;
        World world = make_world(settings);
        (void)world.spawn(world.add_model(small_vase()).value()).value();
        SphereSettings ball = ball_at({0.01f, 0.13f, 0}, 0.3f, 8);
        ball.pose.position.z = 0.1f + 8 * 34 / 60.0f;
        (void)world.add_sphere(ball).value();
        uint64_t ours = 0;
        for (int frame = 0; frame < 60; ++frame) {
            if (frame >= 30) start_counting_allocations();
            world.step();
            if (frame >= 30) ours += stop_counting_allocations().ours;
            if (frame == 30) {
                EXPECT_EQ(world.contents().data.counts.opened, 0u);
            }
        }
        EXPECT_GT(world.contents().data.counts.broke, 0u);
        EXPECT_EQ(ours, 0u) << threads << " threads";
    }
}

}  // namespace
}  // namespace cullet::test
