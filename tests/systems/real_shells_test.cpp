// T3, T4 and T5 of the thick shell note on the meshes of the data folder; on generated ones: propagation_test.
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "sample_game/thresholds.hpp"
#include "systems/cook/tessellate.hpp"
#include "systems/structures/shell/cook/tetrahedra.hpp"
#include "tests/support/expect_always.hpp"
#include "tests/support/extrusions.hpp"
#include "tests/support/real_meshes.hpp"
#include "tests/support/simple_meshes.hpp"

namespace cullet {
namespace {

using test::extruded, test::kWays, test::prepared, test::random_thickness;

Vec3d closest_on_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d n = cross(b - a, c - a);
    const Vec3d corner[3] = {a, b, c};
    bool is_inside = true;
    for (size_t k = 0; k < 3; ++k) is_inside &= dot(cross(corner[(k + 1) % 3] - corner[k], p - corner[k]), n) >= 0;
    if (is_inside) return p - (dot(p - a, n) / dot(n, n)) * n;
    Vec3d best = a;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3d from = corner[k], along = corner[(k + 1) % 3] - from;
        const double share = std::clamp(dot(p - from, along) / dot(along, along), 0.0, 1.0);
        const Vec3d q = from + share * along;
        if (length(p - q) < length(p - best)) best = q;
    }
    return best;
}

/// Half the local thickness: the radius of the largest ball that touches the surface at the vertex, its centre inward
/// of it. It holds no point of a face that looks the other way (m_q . m_v < -0.1). Over all triangles, each until its
/// closest point stays; the generator's search by boxes has no part in it. Stops when the ball is smaller than
/// `enough`.
double half_thickness(const Surface& s, uint32_t vertex, Vec3d inward, double enough = 0) {
    const Vec3d v = s.positions[vertex];
    double r = s.diagonal;
    for (const Triangle& t : s.triangles) {
        const Vec3d a = s.positions[t[0]], b = s.positions[t[1]], c = s.positions[t[2]];
        if (!(dot(normalised(cross(b - a, c - a)), inward) > 0.1)) continue;
        for (int round = 0; round < 64; ++round) {
            const Vec3d centre = v + r * inward, q = closest_on_triangle(centre, a, b, c);
            const double ahead = dot(q - v, inward);
            if (!(length(q - centre) < r * (1 - 1e-9)) || !(ahead > 0)) break;
            r = dot(q - v, q - v) / (2 * ahead);
        }
        if (r < enough) return r;
    }
    return r;
}

/// Closed, and no vertex in front of any of its faces.
bool is_convex(const Surface& s) {
    if (s.components.size() != 1 || !s.components[0].is_closed) return false;
    for (const Triangle& t : s.triangles) {
        const Vec3d a = s.positions[t[0]], n = normalised(cross(s.positions[t[1]] - a, s.positions[t[2]] - a));
        for (const Vec3d p : s.positions)
            if (dot(p - a, n) > 1e-6 * s.diagonal) return false;
    }
    return true;
}

std::vector<Surface> convex_pieces(const char* name) {
    const Surface all = prepared(test::read_real_mesh(name));
    std::vector<Surface> convex;
    for (uint32_t c = 0; c < all.components.size(); ++c) {
        Surface piece = prepared(test::component_mesh(all, c));
        if (is_convex(piece)) convex.push_back(std::move(piece));
    }
    return convex;
}

/// Way from a vertex inward to the first face that lies across it in parallel, within 4 degrees; 0 where there is none
/// or another face comes first. Against every triangle.
double gap_below(const Surface& s, uint32_t vertex, Vec3d inward) {
    const Vec3d v = s.positions[vertex];
    double nearest = s.diagonal, facing = 0;
    for (const Triangle& t : s.triangles) {
        if (t[0] == vertex || t[1] == vertex || t[2] == vertex) continue;
        const Vec3d a = s.positions[t[0]], n = cross(s.positions[t[1]] - a, s.positions[t[2]] - a);
        const double along = dot(inward, n);
        if (!(std::fabs(along) > 0)) continue;
        const double way = dot(a - v, n) / along;
        if (!(way > 0 && way < nearest)) continue;
        const Vec3d hit = v + way * inward;
        bool is_inside = true;
        for (size_t k = 0; k < 3; ++k) {
            const Vec3d from = s.positions[t[k]], edge = s.positions[t[(k + 1) % 3]] - from;
            is_inside &= dot(cross(edge, hit - from), n) >= -1e-9 * dot(n, n);
        }
        if (is_inside) nearest = way, facing = along / length(n);
    }
    return facing > 0.9976 ? nearest : 0;
}

/// A thin-walled mesh, its inward directions, and the gap below each vertex.
struct Walls {
    Surface surface;
    std::vector<double> gap;
    std::vector<uint32_t> between;  // vertices round which, two gaps wide, all have a parallel wall as far away
    double typical = 0;             // m, median gap

    explicit Walls(Surface s) : surface(std::move(s)), gap(surface.positions.size()) {
        const std::vector<Vec3d> inward = extruded(surface, 1e-6 * surface.diagonal, {}).direction;
        for (uint32_t v = 0; v < gap.size(); ++v) gap[v] = gap_below(surface, v, inward[v]);
        typical = spread_of(gap).median;
        for (uint32_t v = 0; v < gap.size(); ++v)
            if (gap[v] > 0 && is_alike_round(v)) between.push_back(v);
    }

 private:
    bool is_alike_round(uint32_t v) const {
        for (uint32_t w = 0; w < gap.size(); ++w)
            if (length(surface.positions[w] - surface.positions[v]) < 2 * gap[v] &&
                std::fabs(gap[w] - gap[v]) > 0.01 * gap[v])
                return false;
        return true;
    }
};

/// T3 for any thickness above half of the gap.
void expect_half_of_the_gap(const std::string& name, Surface surface) {
    const Walls walls(std::move(surface));
    std::printf("%s: %zu of %zu vertices between parallel walls\n", name.c_str(), walls.between.size(),
                walls.gap.size());
    ASSERT_GT(walls.between.size(), 30u) << name;
    test::expect_always(3, [&](uint32_t number) {
        const double thickness = walls.typical * (0.55 + (number % 1000) / 1000.0);
        const Extrusion shell = extruded(walls.surface, thickness, {});
        for (const uint32_t v : walls.between) {
            const double half = walls.gap[v] / 2, step_min = half / (64 * 5);
            if (half < thickness) RC_ASSERT(std::fabs(shell.depth[v] - half) <= 0.02 * half + step_min);
        }
    });
}

/// One convex piece of a file, its long edges halved until they are about as long as it is thick.
Surface cut_piece(const std::string& name, uint32_t component) {
    const Mesh piece = test::component_mesh(prepared(test::read_real_mesh(name)), component);
    const Surface coarse = prepared(piece);
    EXPECT_TRUE(is_convex(coarse)) << name << " " << component;
    const std::vector<Vec3d> inward = extruded(coarse, 1e-6 * coarse.diagonal, {}).direction;
    TessellationSettings fine;
    fine.longest_edge = coarse.diagonal;
    for (uint32_t v = 0; v < inward.size(); ++v)
        fine.longest_edge = std::min(fine.longest_edge, 2 * half_thickness(coarse, v, inward[v]));
    const Result<Mesh> cut = tessellate(piece, fine);
    if (!cut) ADD_FAILURE() << cut.error();
    return cut ? prepared(*cut) : Surface{};
}

TEST(RealShells, BetweenParallelWallsTheDepthIsHalfTheGap) {
    CULLET_SKIP_WITHOUT_DATA();
    for (const char* name : {"thick_shell/vase_thick.ply", "thick_shell/bowl.ply"})
        expect_half_of_the_gap(name, prepared(test::read_real_mesh(name)));
    for (const uint32_t panel : {3u, 4u, 10u, 11u})
        expect_half_of_the_gap("a panel of the double door", cut_piece("convex/double_door.glb", panel));
    for (const uint32_t plank : {49u, 61u, 67u, 73u})
        expect_half_of_the_gap("a plank of the rope bridge", cut_piece("convex/rope_bridge.obj", plank));
}

/// Whether at this depth every prism is the right way round, as rule 2 of A5 asks it: where a facet is smaller than the
/// depth, as at a bevel, it is not, however thick the body.
bool is_right_way_round(const Surface& s, const std::vector<Vec3d>& inward, double depth) {
    for (const Triangle& t : s.triangles) {
        std::array<Vec3d, 3> outer, inner;
        for (size_t k = 0; k < 3; ++k) outer[k] = s.positions[t[k]], inner[k] = outer[k] + depth * inward[t[k]];
        const Vec3d n = cross(outer[1] - outer[0], outer[2] - outer[0]),
                    m = cross(inner[1] - inner[0], inner[2] - inner[0]);
        if (!(dot(normalised(n), normalised(m)) >= 0.2)) return false;
        const PrismTetrahedra tets = prism_tetrahedra(outer, inner, t);
        for (const double volume : tets.volume)
            if (!(volume >= 0.01 * 0.5 * length(n) * depth / 3)) return false;
    }
    return true;
}

/// A convex body with the depth that T5 asks for: less than half of its thickness anywhere, and no prism turned over.
struct ConvexBody {
    Surface surface;
    double most = 0;
};

std::vector<ConvexBody> convex_bodies(const char* name) {
    constexpr int kDepths = 64;
    ExtrusionSettings settings;
    settings.has_mitre = false;
    std::vector<ConvexBody> bodies;
    for (Surface& piece : convex_pieces(name)) {
        const std::vector<Vec3d> inward = extruded(piece, 1e-6 * piece.diagonal, settings).direction;
        double thin = piece.diagonal, most = 0;
        for (uint32_t v = 0; v < piece.positions.size(); ++v)
            thin = std::min(thin, half_thickness(piece, v, inward[v]));
        for (int k = 1; k < kDepths && is_right_way_round(piece, inward, k * thin / kDepths); ++k)
            most = k * thin / kDepths;
        if (most > 0) bodies.push_back({std::move(piece), most});
    }
    return bodies;
}

TEST(RealShells, OnAConvexBodyEveryWayReachesTheThicknessWithoutACollision) {
    CULLET_SKIP_WITHOUT_DATA();
    for (const char* name : {"convex/wall_rocks.glb", "convex/lego_vhacd.obj", "convex/cube_bricks.glb"}) {
        const std::vector<ConvexBody> bodies = convex_bodies(name);
        ASSERT_GE(bodies.size(), 20u) << name;
        test::expect_always(100, [&](uint32_t body, uint16_t share) {
            const ConvexBody& one = bodies[body % bodies.size()];
            const double thickness = one.most * (1 + share % 1000) / 1000;
            ExtrusionSettings settings;
            settings.has_mitre = false;
            for (const Propagation way : kWays) {
                settings.propagation = way;
                const Extrusion shell = extruded(one.surface, thickness, settings);
                // Vertex by vertex with the tetrahedra's test is apart: one that is ahead of the others may turn a
                // small facet over, is set back, and can be late for good.
                if (way == Propagation::SingleVertexTets && shell.statistics.collisions > 0) continue;
                RC_ASSERT(shell.statistics.collisions == 0u);
                for (const double d : shell.depth) RC_ASSERT(std::fabs(d / thickness - 1) < 1e-9);
            }
        });
    }
}

TEST(RealShells, EveryWayGivesTheSameDepthsForAnyNumberingAndOnTwoThreads) {
    CULLET_SKIP_WITHOUT_DATA();
    for (const char* name : {"thick_shell/spot_control_mesh.obj", "thick_shell/vase.glb", "thick_shell/plate.glb",
                             "thick_shell/husky.glb", "thick_shell/curtains_double.glb"}) {
        const Mesh mesh = test::read_real_mesh(name);
        const Surface surface = prepared(mesh);
        test::expect_always(3, [&](uint64_t numbering, uint32_t number) {
            const Surface other = prepared(test::shuffled(mesh, numbering));
            RC_ASSERT(std::equal(surface.positions.begin(), surface.positions.end(), other.positions.begin(),
                                 other.positions.end()));
            const double thickness = random_thickness(surface, number);
            for (const Propagation way : kWays) {
                ExtrusionSettings settings;
                settings.propagation = way;
                const Extrusion alone = extruded(surface, thickness, settings);
                Extrusion beside;
                std::thread second([&] { beside = extruded(other, thickness, settings); });
                const Extrusion again = extruded(surface, thickness, settings);
                second.join();
                RC_ASSERT(again.depth == alone.depth);
                RC_ASSERT(beside.depth == alone.depth);
                RC_ASSERT(beside.statistics.collisions == alone.statistics.collisions);
            }
        });
    }
}

}  // namespace
}  // namespace cullet
