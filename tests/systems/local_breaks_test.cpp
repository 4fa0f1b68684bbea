// What a hit leaves of a body is changed where it cracked alone: after each of many random breaks drawn meshes, boxes,
// mass and collision shape are those that a look at the whole body gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "components/state.hpp"
#include "engine/random.hpp"
#include "systems/bodies/rigid_shape.hpp"
#include "systems/cook/materials.hpp"
#include "systems/drawn/bound_drawn.hpp"
#include "systems/structures/shell/draw_shell.hpp"
#include "systems/structures/shell/group_fragments.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/world_contents.hpp"
#include "tests/support/large_hits.hpp"

namespace cullet {
namespace {

Result<Model> cook_fine_vase(float edge) {
    CookSettings settings;
    settings.longest_edge = 100;
    settings.fracture = FractureKind::Fine;
    return test::cook_vase(0.3f, edge, settings);
}

/// Triangles by run, in an order that does not depend on how they were written.
using DrawnTriangle = std::array<ViewVertex, 3>;
std::vector<std::vector<DrawnTriangle>> triangles_of(const State& state, const Range& vertices, const Range& indices,
                                                     const std::array<uint32_t, kMostRuns>& runs) {
    std::vector<std::vector<DrawnTriangle>> found(kMostRuns);
    uint32_t next = indices.first;
    for (uint32_t r = 0; r < kMostRuns; ++r) {
        for (uint32_t end = next + runs[r]; next < end; next += 3) {
            DrawnTriangle triangle;
            for (uint32_t k = 0; k < 3; ++k)
                triangle[k] = state.view_vertices.vertex[vertices.first + state.view_indices.index[next + k]];
            found[r].push_back(triangle);
        }
        std::sort(found[r].begin(), found[r].end(),
                  [](const DrawnTriangle& a, const DrawnTriangle& b) { return std::memcmp(&a, &b, sizeof a) < 0; });
    }
    return found;
}

bool are_same(const std::vector<std::vector<DrawnTriangle>>& a, const std::vector<std::vector<DrawnTriangle>>& b) {
    for (size_t r = 0; r < a.size(); ++r)
        if (a[r].size() != b[r].size() || std::memcmp(a[r].data(), b[r].data(), a[r].size() * sizeof a[r][0]) != 0)
            return false;
    return true;
}

void expect_drawn_as_anew(World& world, Row<Bodies> body) {
    State& state = world.contents().data.state;
    const Bodies& bodies = state.bodies;
    const ShellView shell(state, bodies.structure[body]);
    const Result<void> sound = check_drawn_mesh(shell, {state.view_vertices, state.view_indices},
                                                bodies.view_vertices[body], bodies.view_indices[body]);
    ASSERT_TRUE(sound.ok()) << sound.error();
    const auto drawn =
        triangles_of(state, bodies.view_vertices[body], bodies.view_indices[body], bodies.run_indices[body]);
    const DrawnCount count = count_drawn(shell);
    Range vertices{state.view_vertices.pool.take(count.vertices), 0, count.vertices};
    Range indices{state.view_indices.pool.take(count.index_count()), 0, count.index_count()};
    ASSERT_TRUE(vertices.first != kNone && indices.first != kNone);
    if (state.view_vertices.pool.end() > state.view_vertices.size())
        state.view_vertices.append(state.view_vertices.pool.end() - state.view_vertices.size());
    if (state.view_indices.pool.end() > state.view_indices.size())
        state.view_indices.append(state.view_indices.pool.end() - state.view_indices.size());
    draw_shell(shell, {state.view_vertices, state.view_indices}, vertices, indices);
    EXPECT_TRUE(are_same(drawn, triangles_of(state, vertices, indices, count.indices)));
    state.view_vertices.pool.give_back(vertices.first, vertices.capacity);
    state.view_indices.pool.give_back(indices.first, indices.capacity);
    remember_drawn(shell, state.view_indices, bodies.view_indices[body]);
}

void expect_boxes_as_anew(World& world, Row<Bodies> body) {
    WorldData& d = world.contents().data;
    Bodies& bodies = d.state.bodies;
    const Range drawn = bodies.view_indices[body];
    const uint32_t boxes = (drawn.count / 3 + kTrianglesPerBox - 1) / kTrianglesPerBox;
    const auto* const first = d.view_boxes.box.data() + drawn.first / kViewGranule;
    const std::vector<std::array<float, 6>> before(first, first + boxes);
    const auto whole = bodies.drawn_box[body];
    bound_view(bodies, body, d.state.view_vertices, d.state.view_indices, d.view_boxes);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), first));
    EXPECT_EQ(whole, bodies.drawn_box[body]);
}

void expect_mass_as_anew(World& world, Row<Bodies> body) {
    State& state = world.contents().data.state;
    const Bodies& bodies = state.bodies;
    const ShellView shell(state, bodies.structure[body]);
    const MassProperties anew = mass_properties(shell_moments(shell));
    // Pieces are subtracted from what the body was before cracks put vertices on its edges; where the wall is curved
    // these move mass inside of their elements.
    EXPECT_NEAR(bodies.mass[body], anew.mass, 1e-9 * anew.mass);
    EXPECT_LT(length(bodies.centre[body] - anew.centre), 5e-6);                                 // 3.0e-6 seen
    EXPECT_NEAR(trace(bodies.inertia[body]), trace(anew.inertia), 1e-4 * trace(anew.inertia));  // 5.0e-5 seen
    float farthest = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        if (state.vertices.element[shell.vertex(v)] != kNone)
            farthest = std::max(farthest, length(state.vertices.rest[shell.vertex(v)] - anew.centre.to_float()));
    EXPECT_GE(bodies.radius[body], 0.9999f * farthest);
    EXPECT_LE(bodies.radius[body], 1.5f * farthest);
}

/// Its surface, asked at random points of its drawn mesh, is that of a body made of all of its hulls at once.
void expect_shape_as_anew(World& world, Row<Bodies> body, uint32_t seed) {
    WorldData& d = world.contents().data;
    const State& state = d.state;
    const Bodies& bodies = state.bodies;
    const auto rigid = make_bullet_world(bodies.limit());
    d.arena.reset();
    const auto pieces = convex_pieces(state, bodies.structure[body], d.arena);
    RigidDescription description = describe_rigid(state.bodies, state.structures, body, pieces);
    description.pose = d.rigid->pose(body);
    d.rigid->set_pose(body, description.pose);  // the last step moved it: its pieces follow
    rigid->add(body, description);
    const Range drawn = bodies.view_vertices[body];
    for (uint32_t k = 0; k < 200; ++k) {
        const uint32_t v = drawn.first + static_cast<uint32_t>(Random{seed}.bits(k) % drawn.count);
        const Vec3 place = to_world(description.pose, state.view_vertices.vertex[v].position);
        RigidSurface now, anew;
        const bool is_near = d.rigid->nearest_surface(body, place, 0.02f, now);
        ASSERT_EQ(is_near, rigid->nearest_surface(body, place, 0.02f, anew));
        if (is_near) {
            EXPECT_NEAR(now.distance, anew.distance, 2e-5f);  // its margin is that of its first wall
        }
    }
}

void expect_all_as_anew(World& world, uint32_t seed) {
    State& state = world.contents().data.state;
    const Bodies& bodies = state.bodies;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const Row<Bodies> body(b);
        if (static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Free || !bodies.structure[b].exists()) continue;
        expect_drawn_as_anew(world, body);
        expect_boxes_as_anew(world, body);
        expect_mass_as_anew(world, body);
        expect_shape_as_anew(world, body, seed + b);
    }
}

enum class Saving : uint8_t { None, Saves, Restores };

struct Pelted {
    uint32_t born = 0;
    uint64_t hash = 0;
    uint32_t least_drawn = 100;  // per cent of the body's mesh that a hit drew anew, in one range
};

/// Balls from random sides, one after the other, at a body that floats. With `saving` the world is saved after each,
/// and goes on or is restored.
Pelted pelt(float edge, FractureMode mode, uint32_t hits, Saving saving = Saving::None, uint32_t threads = 1) {
    const Result<Model> model = cook_fine_vase(edge);
    EXPECT_TRUE(model.ok());
    Settings settings;
    settings.gravity = {};
    settings.units_a_frame = 1'000'000'000;
    settings.debris_share = 0, settings.debris_elements = 3;
    settings.limits.bodies = 400;
    settings.threads = threads;
    World world = World::create(settings).value();
    const ModelId id = world.add_model(model.value()).value();
    SpawnSettings spawn;
    spawn.thick_shell.fracture = mode;
    if (mode == FractureMode::Quick) spawn.thick_shell.quick.strain_limit = 0.02f;
    const BodyId body = world.spawn(id, spawn).value();
    uint32_t born = 0, least_drawn = 100;
    for (uint32_t hit = 0; hit < hits; ++hit) {
        const auto uniform = [&](uint64_t k) { return static_cast<float>(Random{7}.uniform(hit, k)); };
        const float height = 0.05f + 0.2f * uniform(0), turn = 2 * uniform(1) - 1,
                    side = uniform(2) < 0.5f ? -1.0f : 1.0f;
        const Vec3 way = normalised(Vec3{turn, 0, side * std::sqrt(1 - turn * turn)});
        (void)world.set_pose(body, {});
        (void)world.set_motion(body, {});
        SphereSettings ball;
        ball.radius = 0.03f, ball.mass = 0.3f;
        ball.pose.position = Vec3{0, height, 0} + 0.4f * way;
        ball.motion.velocity = -40.0f * way;
        const BodyId thrown = world.add_sphere(ball).value();
        for (uint32_t frame = 0; frame < 6; ++frame) {
            const uint32_t stamp = world.view(body).value().stamp;
            world.step();
            const BodyView view = world.view(body).value();
            if (view.stamp != stamp)
                least_drawn = std::min(least_drawn, 100 * view.dirty_vertices.count / view.vertex_count);
            born += static_cast<uint32_t>(world.contents().data.told.of<FragmentBornEvent>().size());
        }
        (void)world.remove(thrown);
        if (saving == Saving::None) {
            expect_all_as_anew(world, hit);
        } else {
            const auto saved = world.snapshot();
            EXPECT_TRUE(saved.ok());
            if (saving == Saving::Restores) {
                EXPECT_TRUE(world.restore(saved->data(), saved->size(), "it").ok());
            }
        }
        if (testing::Test::HasFatalFailure() || testing::Test::HasNonfatalFailure()) {
            ADD_FAILURE() << "after hit " << hit;
            break;
        }
    }
    return {born, world.contents().data.state.hash(), least_drawn};
}

TEST(LocalBreaks, ALargeBodyHitOnCutOutsIsAsIfMadeAnewAfterEveryHit) {
    const Pelted pelted = pelt(0.0062f, FractureMode::Quick, 8);
    EXPECT_GT(pelted.born, 10u);
    EXPECT_LT(pelted.least_drawn, 100u) << "some of it stood";
}

TEST(LocalBreaks, ASmallBodyHitOnWholeCopiesIsAsIfMadeAnewAfterEveryHit) {
    EXPECT_GE(pelt(0.018f, FractureMode::Quick, 8).born, 8u);  // ten or so, of the first hits
    EXPECT_GT(pelt(0.018f, FractureMode::Hidden, 4).born, 10u);
}

TEST(LocalBreaks, GoOnAsTheyWouldHaveWhenTheWorldIsRestoredAndOnAnyThreads) {
    const Pelted saved = pelt(0.0062f, FractureMode::Quick, 6, Saving::Saves);
    EXPECT_GT(saved.born, 10u);
    EXPECT_EQ(pelt(0.0062f, FractureMode::Quick, 6, Saving::Restores).hash, saved.hash);
    EXPECT_EQ(pelt(0.0062f, FractureMode::Quick, 6, Saving::Saves, 3).hash, saved.hash);
}

}  // namespace
}  // namespace cullet
