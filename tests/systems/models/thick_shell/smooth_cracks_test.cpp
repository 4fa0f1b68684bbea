// Cracks are drawn after one pass of (1/4, 1/2, 1/4): fewer kinks, the same line on both sides, no face turned over.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "components/state.hpp"
#include "systems/structures/shell/prism.hpp"
#include "systems/structures/shell/ring.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

using Place = std::tuple<float, float, float>;
Place place_of(Vec3 p) {
    return {p.x, p.y, p.z};
}

/// One side of a crack at a vertex: its neighbours along the free border of its fan.
struct Side {
    ShellView shell;
    uint32_t vertex, next, previous;

    Vec3 rest(uint32_t v) const { return shell.state.vertices.rest[shell.vertex(v)]; }
    Vec3 drawn(uint32_t v) const { return smoothed_place(shell.state, shell.vertex(v)); }
    Vec3 shift() const { return shell.state.vertices.crack_shift[shell.vertex(vertex)]; }
    /// Degrees between the way in and the way out.
    template <class Where>
    double kink(Where where) const {
        const Vec3d in(where(vertex) - where(previous)), out(where(next) - where(vertex));
        return std::acos(std::clamp(dot(normalised(in), normalised(out)), -1.0, 1.0)) * 57.29577951308232;
    }
};

/// Of vertices whose free edges are both cracks.
std::vector<Side> sides_of(const ShellView& shell) {
    std::vector<Side> sides;
    const Elements& elements = shell.state.elements;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        if (shell.state.vertices.element[shell.vertex(v)] == kNone) continue;
        Ring ring;
        walk_ring(shell, v, ring);
        if (ring.count == 0 || ring.is_closed) continue;
        const uint32_t first = shell.element(ring.element[0]), last = shell.element(ring.element[ring.count - 1]);
        const uint32_t out = ring.corner[0], in = (ring.corner[ring.count - 1] + 2u) % 3;
        const auto is_crack = [&](uint32_t e, uint32_t k) {
            return elements.edge_kind[e][k] == static_cast<uint8_t>(EdgeKind::Crack);
        };
        if (is_crack(first, out) && is_crack(last, in))
            sides.push_back({shell, v, elements.corner[first][(out + 1) % 3], elements.corner[last][in]});
    }
    return sides;
}

struct Cracked {
    std::string name;
    World world;
};
std::vector<Cracked> broken_bodies() {
    std::vector<Cracked> all;
    Settings settings = small_settings();
    settings.units_a_frame = 100'000'000;
    all.push_back({"vase", vase_and_ball(settings).world});
    all.push_back({"wall", wall_and_ball(settings).world});
    all.push_back({"pane", pane_and_ball(settings).world});
    // Quick cracks follow the edges of the mesh, and have the most kinks.
    for (const float height : {0.13f, 0.16f}) {
        all.push_back({"quick vase", make_world(settings)});
        SpawnSettings spawn;
        spawn.thick_shell.fracture = FractureMode::Quick;
        World& world = all.back().world;
        (void)world.spawn(world.add_model(small_vase()).value(), spawn);
        (void)world.add_sphere(ball_at({0.01f, height, 0}, 0.3f, 40));
    }
    for (Cracked& c : all) EXPECT_GT(step_until_born(c.world, 60), 0u) << c.name;
    return all;
}

constexpr double kLargeKink = 40;  // degrees, of C6

/// Of all pieces, the points with a crack on exactly two sides that name the same neighbours: no tips, no junctions.
std::vector<Side> points_on_cracks(World& world) {
    State& state = state_of(world);
    std::map<Place, std::vector<Side>> at;
    for (const BodyId id : shells_of(world))
        for (const Side& s : sides_of(ShellView(state, state.bodies.structure[id.index])))
            at[place_of(s.rest(s.vertex))].push_back(s);
    std::vector<Side> points;
    for (const auto& [place, sides] : at)
        if (sides.size() == 2 && sides[0].rest(sides[0].next) == sides[1].rest(sides[1].previous) &&
            sides[0].rest(sides[0].previous) == sides[1].rest(sides[1].next) &&
            !(sides[0].rest(sides[0].next) == sides[0].rest(sides[0].previous)))
            points.push_back(sides[0]);
    return points;
}

TEST(SmoothCracks, HaveAFifthOfTheKinks) {
    uint32_t points = 0, kinked = 0, kinked_drawn = 0;
    for (Cracked& c : broken_bodies())
        for (const Side& s : points_on_cracks(c.world)) {
            ++points;
            kinked += s.kink([&](uint32_t v) { return s.rest(v); }) > kLargeKink;
            kinked_drawn += s.kink([&](uint32_t v) { return s.drawn(v); }) > kLargeKink;
        }
    RecordProperty("points", static_cast<int>(points));
    RecordProperty("kinks_at_rest", static_cast<int>(kinked));
    RecordProperty("kinks_drawn", static_cast<int>(kinked_drawn));
    EXPECT_GT(kinked, 10u) << "of " << points;
    EXPECT_LT(5 * kinked_drawn, kinked) << "of " << points;
}

// Pieces fit: every vertex of one place at rest is drawn at one place, whichever piece has it.
TEST(SmoothCracks, AreOneLineForBothSides) {
    for (Cracked& c : broken_bodies()) {
        State& state = state_of(c.world);
        std::map<Place, Vec3> shift_at;
        uint32_t moved = 0, met = 0;
        for (const BodyId id : shells_of(c.world)) {
            const ShellView shell(state, state.bodies.structure[id.index]);
            for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
                const uint32_t row = shell.vertex(v);
                if (state.vertices.element[row] == kNone) continue;
                const Vec3 shift = state.vertices.crack_shift[row];
                moved += dot(shift, shift) > 0;
                const auto [at, is_new] = shift_at.try_emplace(place_of(state.vertices.rest[row]), shift);
                met += !is_new && dot(shift, shift) > 0;
                EXPECT_EQ(place_of(at->second), place_of(shift)) << c.name;
            }
        }
        EXPECT_GT(moved, 20u) << c.name;
        EXPECT_GT(met, moved / 3) << c.name;  // the other side may be debris
    }
}

TEST(SmoothCracks, MoveSidewaysALittleAndTurnNoFaceOver) {
    for (Cracked& c : broken_bodies())
        for (const BodyId id : shells_of(c.world)) {
            State& state = state_of(c.world);
            const ShellView shell(state, state.bodies.structure[id.index]);
            for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
                const Vec3 shift = state.vertices.crack_shift[shell.vertex(v)];
                EXPECT_LT(length(shift), 0.75f * state.shells.mean_edge[shell.row]) << c.name;
                Ring ring;
                walk_ring(shell, v, ring);
                for (uint32_t i = 0; i < ring.count && dot(shift, shift) > 0; ++i) {
                    const auto at = [&](uint32_t k) {
                        return state.vertices
                            .rest[shell.vertex(state.elements.corner[shell.element(ring.element[i])][k])];
                    };
                    const Vec3 normal = normalised(cross(at(1) - at(0), at(2) - at(0)));
                    EXPECT_LT(std::fabs(dot(shift, normal)), 0.32f * length(shift)) << c.name << ": within 18 degrees";
                }
            }
            for (uint32_t e = 0; e < shell.element_count(); ++e) {
                const auto corner = state.elements.corner[shell.element(e)];
                const auto area = [&](auto where) {
                    const Vec3 a = where(shell.vertex(corner[0]));
                    return cross(where(shell.vertex(corner[1])) - a, where(shell.vertex(corner[2])) - a);
                };
                const Vec3 then = area([&](uint32_t row) { return state.vertices.rest[row]; });
                const Vec3 now = area([&](uint32_t row) { return smoothed_place(state, row); });
                EXPECT_GE(dot(now, then), 0.299f * dot(then, then)) << c.name << ", element " << e;
            }
        }
}

}  // namespace
}  // namespace cullet::test
