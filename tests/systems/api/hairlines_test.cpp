// Cracks that have not parted a body are lines of its view.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "components/state.hpp"
#include "sample_game/meshes.hpp"
#include "systems/structures/shell/prism.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

using Place = std::array<float, 3>;
using Line = std::pair<Place, Place>;

Place place_of(Vec3 p) {
    return {p.x, p.y, p.z};
}
Line line_of(Vec3 p, Vec3 q) {
    return std::minmax(place_of(p), place_of(q));
}

std::vector<uint32_t> hairlines_of(const World& world, BodyId body) {
    std::vector<uint32_t> indices(world.view(body).value().index_count / 2);
    const Result<uint32_t> count = world.hairlines(body, indices.data(), static_cast<uint32_t>(indices.size()));
    EXPECT_TRUE(count.ok()) << count.error();
    indices.resize(count.value_or(0));
    return indices;
}

std::multiset<Line> lines_of(const World& world, BodyId body) {
    const BodyView view = world.view(body).value();
    const std::vector<uint32_t> indices = hairlines_of(world, body);
    std::multiset<Line> lines;
    for (size_t i = 0; i < indices.size(); i += 2)
        lines.insert(line_of(view.vertices[indices[i]].position, view.vertices[indices[i + 1]].position));
    return lines;
}

/// Each crack edge of the shell against each other one: those that lie on each other, along both walls.
std::multiset<Line> lines_by_comparing_all(World& world, BodyId body) {
    State& state = state_of(world);
    const ShellView shell(state, state.bodies.structure[body.index]);
    const Elements& elements = state.elements;
    struct Edge {
        Vec3 from[2], to[2];
    };
    std::vector<Edge> edges;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t row = shell.element(e);
            if ((elements.flags[row] & kDead) || elements.neighbour[row][k] != kNone) continue;
            if (elements.edge_kind[row][k] != static_cast<uint8_t>(EdgeKind::Crack)) continue;
            const uint32_t a = shell.vertex(elements.corner[row][k]),
                           b = shell.vertex(elements.corner[row][(k + 1) % 3]);
            edges.push_back({{smoothed_place(state, a), smoothed_twin(state, a).to_float()},
                             {smoothed_place(state, b), smoothed_twin(state, b).to_float()}});
        }
    std::multiset<Line> lines;
    for (size_t i = 0; i < edges.size(); ++i)
        for (size_t j = i + 1; j < edges.size(); ++j)
            for (int wall = 0; wall < 2; ++wall)
                if (edges[i].from[wall] == edges[j].to[wall] && edges[i].to[wall] == edges[j].from[wall])
                    lines.insert(line_of(edges[i].from[wall], edges[i].to[wall]));
    return lines;
}

double length_of(const std::multiset<Line>& lines) {
    double sum = 0;
    for (const auto& [p, q] : lines) sum += length(Vec3{q[0] - p[0], q[1] - p[1], q[2] - p[2]});
    return sum;
}

/// A pane in the plane z = 0 that floats freely, 0.3 x 0.3 m from (-0.15, 0, 0) on.
BodyId floating_pane(World& world) {
    return world.spawn(world.add_model(small_pane()).value()).value();
}

TEST(Hairlines, OfAnIntactBodyThereAreNone) {
    World world = make_world(small_settings());
    EXPECT_TRUE(hairlines_of(world, floating_pane(world)).empty());
}

TEST(Hairlines, RunAlongASlitOnBothWallsAndEndAtItsTips) {
    World world = make_world(small_settings());
    const BodyId pane = floating_pane(world);
    const Vec3 slit[] = {{-0.06f, 0.15f, 0}, {0.07f, 0.15f, 0}};
    CutSettings cut;
    cut.points = slit, cut.point_count = 2;
    ASSERT_TRUE(world.cut(pane, cut).ok());
    for (int frame = 0; frame < 5; ++frame) world.step();
    ASSERT_EQ(world.bodies(nullptr, 0), 1u);
    const BodyView view = world.view(pane).value();
    const std::multiset<Line> lines = lines_of(world, pane);
    ASSERT_GT(lines.size(), 4u);
    EXPECT_EQ(lines, lines_by_comparing_all(world, pane));
    double along[2] = {0, 0};  // of the outer wall and the inner one
    const std::vector<uint32_t> indices = hairlines_of(world, pane);
    for (size_t i = 0; i < indices.size(); i += 2) {
        const ViewVertex &a = view.vertices[indices[i]], &b = view.vertices[indices[i + 1]];
        EXPECT_EQ(a.uv.y > 0, b.uv.y > 0);
        EXPECT_NEAR(a.position.y, 0.15f, 0.026f);  // an edge is 25 mm long
        along[a.uv.y > 0] += length(b.position - a.position);
    }
    EXPECT_NEAR(along[0], 0.13, 0.05);
    EXPECT_NEAR(along[1], along[0], 1e-5);
}

TEST(Hairlines, WithTooLittleRoomOrOfWhatIsGoneAreRefusedInASentence) {
    World world = make_world(small_settings());
    const BodyId pane = floating_pane(world);
    const Vec3 slit[] = {{-0.06f, 0.15f, 0}, {0.07f, 0.15f, 0}};
    CutSettings cut;
    cut.points = slit, cut.point_count = 2;
    ASSERT_TRUE(world.cut(pane, cut).ok());
    for (int frame = 0; frame < 5; ++frame) world.step();
    uint32_t few[4];
    EXPECT_NE(world.hairlines(pane, few, 4).error().find("hairlines: room for 4 indices"), std::string::npos);
    EXPECT_EQ(world.hairlines(world.add_sphere({}).value(), few, 4).value(), 0u);  // nothing is drawn of a ball
    ASSERT_TRUE(world.remove(pane).ok());
    EXPECT_NE(world.hairlines(pane, few, 4).error().find("names nothing"), std::string::npos);
}

TEST(Hairlines, OfAPlaneThatPartsTheBodyThereAreNone) {
    World world = make_world(small_settings());
    const BodyId pane = floating_pane(world);
    CutSettings cut;
    cut.place = {0, 0.14f, 0};
    ASSERT_TRUE(world.cut(pane, cut).ok());
    for (int frame = 0; frame < 5; ++frame) world.step();
    ASSERT_EQ(shells_of(world).size(), 2u);
    for (const BodyId body : shells_of(world)) EXPECT_TRUE(hairlines_of(world, body).empty());
}

TEST(Hairlines, AreThoseThatComparingAllCrackEdgesFinds) {
    uint32_t with_lines = 0;
    for (const float speed : {1.6f, 2.0f, 2.2f, 2.6f, 3.0f, 3.5f, 5.0f, 8.0f}) {
        Breakage worlds[] = {vase_and_ball(small_settings(), speed), wall_and_ball(small_settings(), speed),
                             pane_and_ball(small_settings(), speed)};
        for (Breakage& b : worlds) {
            for (int frame = 0; frame < 12; ++frame) b.world.step();
            for (const BodyId body : shells_of(b.world)) {
                const std::multiset<Line> lines = lines_of(b.world, body);
                EXPECT_EQ(lines, lines_by_comparing_all(b.world, body)) << "at " << speed << " m/s";
                with_lines += !lines.empty();
            }
        }
    }
    EXPECT_GT(with_lines, 3u);
}

TEST(Hairlines, OfALoadedWorldAreTheSame) {
    Breakage b = wall_and_ball(small_settings(), 2.2f);
    for (int frame = 0; frame < 20; ++frame) b.world.step();
    const Result<std::vector<uint8_t>> bytes = b.world.snapshot();
    ASSERT_TRUE(bytes.ok()) << bytes.error();
    World other = make_world(small_settings());
    ASSERT_TRUE(other.restore(bytes->data(), bytes->size()).ok());
    size_t lines = 0;
    for (const BodyId body : shells_of(b.world)) {
        const std::vector<uint32_t> here = hairlines_of(b.world, body);
        EXPECT_EQ(here, hairlines_of(other, body));
        lines += here.size();
    }
    EXPECT_GT(lines, 0u);
}

TEST(Hairlines, StayAndGrowWhenTheNextHitGoesOnFromTheirTips) {
    Breakage b = wall_and_ball(small_settings(), 2.2f);
    double before = 0;
    for (int hit = 0; hit < 3; ++hit) {
        for (int frame = 0; frame < 20; ++frame) b.world.step();
        if (shells_of(b.world).size() > 1) break;  // parted: its lines are gone
        const double now = length_of(lines_of(b.world, b.body));
        EXPECT_GE(now, before * (1 - 1e-6));
        before = now;
        SphereSettings ball = ball_at({0.1f, 0.5f, 0}, 20, 2.2f, 0.12f);
        ball.user_data = 100;
        ASSERT_TRUE(b.world.add_sphere(ball).ok());
    }
    EXPECT_GT(before, 0.1);
}

}  // namespace
}  // namespace cullet::test
