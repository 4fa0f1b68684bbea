// A cut parts what it crosses, whatever triangles it is made of: boxes of twelve, cut anywhere and in any direction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/random.hpp"
#include "sample_game/meshes.hpp"
#include "systems/structures/shell/cut_shell.hpp"
#include "tests/support/play_script.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

struct Draw {
    Random random;
    uint64_t n = 0;
    float within(float low, float high) { return low + (high - low) * static_cast<float>(random.uniform(n++)); }
    uint32_t of(uint32_t count) { return static_cast<uint32_t>(random.uniform(n++) * count) % count; }
};

Settings settings_of_cuts() {
    Settings settings = small_settings();
    settings.debris_share = 0;
    settings.debris_elements = 0;
    return settings;
}

struct Sawn {
    World world;
    BodyId body;
    Vec3 half;  // of the box, m
    float wall = 0;
};
/// A prism of 3 to 9 sides, ends and sides of as few triangles as there can be.
Mesh random_prism(Draw& draw, Vec3 half) {
    const uint32_t sides = 3 + draw.of(7);
    Mesh mesh;
    for (uint32_t i = 0; i < sides; ++i) {
        const float angle = 2 * 3.14159265f * static_cast<float>(i) / static_cast<float>(sides);
        for (const float x : {-half.x, half.x})
            mesh.positions.push_back({x, half.y * std::cos(angle), half.z * std::sin(angle)});
    }
    for (uint32_t i = 0; i < sides; ++i) {
        const uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
        if (i < 2) continue;
        mesh.triangles.push_back({0, a, a - 2});
        mesh.triangles.push_back({1, a - 1, a + 1});
    }
    return mesh;
}
/// A plate of two triangles.
Mesh plate(Vec3 half) {
    Mesh mesh;
    mesh.positions = {{-half.x, -half.y, 0}, {half.x, -half.y, 0}, {half.x, half.y, 0}, {-half.x, half.y, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

/// 0.1 to 1 m, sides up to 1 : 20; solid or hollow.
enum class Shape : uint8_t { Box, Ball, Prism, Plate };
Sawn random_thing(Draw& draw, Shape shape) {
    const float size = std::exp2(draw.within(-3.3f, 0));
    const uint32_t longest = draw.of(3);
    Vec3 half;
    for (uint32_t i = 0; i < 3; ++i) {
        const float side = i == longest ? 0.5f * size : 0.5f * size * std::exp2(draw.within(-4.3f, 0));
        (i == 0 ? half.x : i == 1 ? half.y : half.z) = side;
    }
    const float thinnest = std::min({half.x, half.y, half.z});
    CookSettings settings;
    settings.material = "concrete";
    settings.thickness = draw.of(2) ? thinnest : draw.within(0.1f, 0.5f) * thinnest;
    settings.longest_edge = 100;
    settings.thick_shell.measures_threshold = false;
    settings.thick_shell.joins_walls =
        shape == Shape::Box;  // a flat prism becomes a sheet, whose faces can be scraped off
    if (shape == Shape::Ball) half = {half.x, half.x, half.x};
    if (shape == Shape::Plate) half.z = 0;
    const Mesh mesh = shape == Shape::Box     ? make_box(half)
                      : shape == Shape::Ball  ? make_ball(half.x, static_cast<int>(draw.of(2)))
                      : shape == Shape::Prism ? random_prism(draw, half)
                                              : plate(half);
    Sawn sawn{make_world(settings_of_cuts()), {}, half, settings.thickness};
    sawn.body = sawn.world.spawn(sawn.world.add_model(cook(view_of_mesh(mesh), settings).value()).value(), {}).value();
    return sawn;
}

/// Of the triangle on the side that the normal shows to, a share.
double share_beyond(const std::array<Vec3, 3>& corner, Vec3 place, Vec3 normal) {
    std::array<double, 3> d{};
    uint32_t beyond = 0;
    for (uint32_t i = 0; i < 3; ++i) beyond += (d[i] = double{dot(corner[i] - place, normal)}) > 0;
    if (beyond == 0 || beyond == 3) return beyond / 3.0;
    uint32_t lone = 0;
    for (uint32_t i = 0; i < 3; ++i)
        if ((d[i] > 0) == (beyond == 1)) lone = i;
    double share = 1;
    for (const uint32_t i : {(lone + 1) % 3, (lone + 2) % 3}) share *= d[lone] / (d[lone] - d[i]);
    return beyond == 1 ? share : 1 - share;
}

/// kg beyond the plane: walls are cut as their middle says; or their outer side, where the middle has less than half as
/// much beyond.
double mass_beyond(Sawn& sawn, Vec3 place, Vec3 normal) {
    const State& state = state_of(sawn.world);
    const ShellView shell(state_of(sawn.world), state.bodies.structure[sawn.body.index]);
    double mass[2] = {0, 0};
    float low[2] = {0, 0}, high[2] = {0, 0};
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (const uint32_t layer : {0u, 1u}) {
            const uint32_t row = shell.element(e);
            std::array<Vec3, 3> corner;
            for (uint32_t i = 0; i < 3; ++i) {
                corner[i] = place_in_wall(shell, state.elements.corner[row][i], layer == 0 ? 0.5f : 0.0f);
                low[layer] = std::max(low[layer], -dot(corner[i] - place, normal));
                high[layer] = std::max(high[layer], dot(corner[i] - place, normal));
            }
            mass[layer] += state.elements.mass[row] * share_beyond(corner, place, normal);
        }
    return std::min(low[0], high[0]) < 0.5f * std::min(low[1], high[1]) ? mass[1] : mass[0];
}

/// A cut across `normal`: a plane, or a straight or broken line along it.
void saw(Sawn& sawn, Draw& draw, Vec3 place, Vec3 normal) {
    CutSettings cut;
    cut.place = place;
    cut.normal = normal;
    std::vector<Vec3> points;
    if (const uint32_t kind = draw.of(3); kind > 0) {
        const Vec3 helper = std::fabs(normal.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 along = normalised(cross(helper, normal));
        cut.direction = cross(along, normal);
        const uint32_t count = kind == 1 ? 2 : 3 + draw.of(6);
        for (uint32_t i = 0; i < count; ++i) {
            const float share = 2 * static_cast<float>(i) / static_cast<float>(count - 1) - 1;
            points.push_back(place + (3 * share * length(sawn.half)) * along);
        }
        cut.points = points.data();
        cut.point_count = count;
    }
    ASSERT_TRUE(sawn.world.cut(sawn.body, cut).ok());
    sawn.world.step();
}

/// At a share of the way through, along a direction.
Vec3 place_at(Sawn& sawn, Vec3 direction, float share) {
    const State& state = state_of(sawn.world);
    const ShellView shell(state_of(sawn.world), state.bodies.structure[sawn.body.index]);
    float low = 1e9f, high = -1e9f;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const float at = dot(direction, state.vertices.rest[shell.vertex(v)]);
        low = std::min(low, at), high = std::max(high, at);
    }
    return (low + share * (high - low)) * direction;
}

void expect_two_parts(Sawn& sawn, double beyond, double whole, const std::string& told) {
    const std::vector<BodyId> pieces = shells_of(sawn.world);
    EXPECT_EQ(pieces.size(), 2u) << told;
    double lighter = whole;
    for (const BodyId piece : pieces) lighter = std::min(lighter, sawn.world.mass(piece).value());
    EXPECT_NEAR(matter_of(sawn.world).mass, whole, 1e-6 * whole) << told;
    const double wanted = std::min(beyond, whole - beyond);
    EXPECT_NEAR(lighter, wanted, 0.1 * wanted + 1e-4 * whole) << told << ", of " << whole;
}

/// Hits on parts, and the runs that got out of hand and were given up.
struct HitsOnParts {
    uint32_t hits = 0, dropped = 0;
};
void hit_parts(Sawn& sawn, HitsOnParts& counts) {
    for (const BodyId part : shells_of(sawn.world)) {
        PushSettings push;
        push.place =
            to_world(sawn.world.pose(part).value(), state_of(sawn.world).bodies.centre[part.index].to_float()) +
            Vec3{0, 0, 0.1f};
        push.normal = {0, 0, -1};
        push.approach_speed = 10;
        push.mass = 0.5f;
        push.radius = 0.03f;
        ASSERT_TRUE(sawn.world.push_impact(part, push).ok());
        ++counts.hits;
    }
    for (int frame = 0; frame < 8; ++frame) sawn.world.step();
    counts.dropped += static_cast<uint32_t>(sawn.world.contents().data.counts.dropped);
}

void cut_random_things(Shape shape, bool is_askew, uint64_t cases) {
    HitsOnParts counts;
    for (uint64_t n = 0; n < cases; ++n) {
        Draw draw{Random{n + 1}};
        Sawn sawn = random_thing(draw, shape);
        Vec3 normal{};
        if (is_askew) {
            do normal = {draw.within(-1, 1), draw.within(-1, 1), shape == Shape::Plate ? 0 : draw.within(-1, 1)};
            while (length(normal) < 0.2f);
            normal = normalised(normal);
        } else {
            const uint32_t axis = draw.of(3);
            (axis == 0 ? normal.x : axis == 1 ? normal.y : normal.z) = draw.of(2) ? 1.0f : -1.0f;
        }
        const float share = n % 4 == 0   ? draw.within(0.01f, 0.05f)
                            : n % 4 == 1 ? draw.within(0.95f, 0.99f)
                                         : draw.within(0.05f, 0.95f);
        const Vec3 place = place_at(sawn, normal, share);
        const double whole = sawn.world.mass(sawn.body).value(), beyond = mass_beyond(sawn, place, normal);
        saw(sawn, draw, place, normal);
        char told[300];
        std::snprintf(told, sizeof told, "%d: half %.3f %.3f %.3f wall %.3f, across %.2f %.2f %.2f at %.3f",
                      static_cast<int>(n), double{sawn.half.x}, double{sawn.half.y}, double{sawn.half.z},
                      double{sawn.wall}, double{normal.x}, double{normal.y}, double{normal.z}, double{share});
        expect_two_parts(sawn, beyond, whole, told);
        if (n % 4 == 0) hit_parts(sawn, counts);
    }
    // A run on slivers may be given up: that part stays whole.
    EXPECT_LE(counts.dropped, counts.hits / 20) << counts.hits;
}

TEST(CutCoarse, ABoxOfTwelveTrianglesIsSawnThroughWhereTheCutSays) {
    cut_random_things(Shape::Box, false, 160);
}

TEST(CutCoarse, ABoxOfTwelveTrianglesIsSawnThroughAskew) {
    cut_random_things(Shape::Box, true, 160);
}

TEST(CutCoarse, ABallOfTwentyOrEightyTrianglesIsSawnThrough) {
    cut_random_things(Shape::Ball, true, 80);
}

TEST(CutCoarse, APrismOfLongTrianglesIsSawnThrough) {
    cut_random_things(Shape::Prism, true, 80);
}

TEST(CutCoarse, APlateOfTwoTrianglesIsSawnThrough) {
    cut_random_things(Shape::Plate, true, 80);
}

// Short edges that count as lying on the line, and lay farther off than they are long, held half of them together.
TEST(CutCoarse, AJaggedLineRightThroughAPlatePartsIt) {
    const Played played = play_script(R"(
        game.scene{shows = 'cuts', seconds = 60}
        local wide = 0.0446
        local plate = game.cook{mesh = game.mesh.box{half_extents = {0.0911, 0.0086, wide}}, material = 'porcelain', thickness = 0.0086, edge = 0.0146}
        local state = 1
        local function random() state = (state * 16807) % 2147483647 return 2 * state / 2147483647 - 1 end
        for k = 0, 39 do
            local x, z, place, points = k % 7, k // 7, 0.05 * random(), {}
            local b = game.spawn{cooked = plate, at = {x, 1, z}}
            for i = 0, 9 do points[i + 1] = {x + place + 0.0036 * random(), 1, z + wide * (1.5 - i / 3)} end
            wait{frames = 1}
            local before = game.fragments()
            b:cut{points = points, direction = {0, 1, 0}}
            wait{frames = 3}
            game.expect(game.fragments() > before, 'cut ' .. k .. ' parted nothing')
        end)",
                                      {3, 60, 2, false});
    EXPECT_EQ(played.failure, "");
    EXPECT_GE(played.pieces, 40u);
}

}  // namespace
}  // namespace cullet::test
