#include "sample_game/rest.hpp"

#include <algorithm>
#include <cmath>

#include "engine/profiler.hpp"
#include "sample_game/mesh_gap.hpp"
#include "sample_game/meshes.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr double kTouching = 0.0001;  // m: nearer is touching, how much nearer nobody asks

struct Bounds {
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};

    void include(Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    bool is_within(const Bounds& other, float reach) const {
        return low.x <= other.high.x + reach && other.low.x <= high.x + reach && low.y <= other.high.y + reach &&
               other.low.y <= high.y + reach && low.z <= other.high.z + reach && other.low.z <= high.z + reach;
    }
    /// In y and z, with a micrometre to spare.
    bool holds_across(Vec3 p) const {
        return p.y >= low.y - 1e-6f && p.y <= high.y + 1e-6f && p.z >= low.z - 1e-6f && p.z <= high.z + 1e-6f;
    }
    /// At most the square of the distance of anything inside.
    double squared_gap(Vec3 p) const {
        const auto out = [](float least, float x, float most) {
            return static_cast<double>(std::max({least - x, x - most, 0.0f}));
        };
        const double x = out(low.x, p.x, high.x), y = out(low.y, p.y, high.y), z = out(low.z, p.z, high.z);
        return 0.999999 * (x * x + y * y + z * z);
    }
    bool holds(Vec3 p) const {
        return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
    }
};

using Triangle = std::array<uint32_t, 3>;

/// 1 where the ray from p along x goes out through the triangle, -1 where it comes in, 0 where it misses.
int crossing(Vec3d p, const Corners& c) {
    const auto turn = [&](Vec3d a, Vec3d b) { return (a.y - p.y) * (b.z - p.z) - (a.z - p.z) * (b.y - p.y); };
    const double u = turn(c[0], c[1]), v = turn(c[1], c[2]), w = turn(c[2], c[0]), sum = u + v + w;
    if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) return 0;
    const double x = (v * c[0].x + w * c[1].x + u * c[2].x) / sum;
    return x <= p.x ? 0 : sum > 0 ? 1 : -1;
}

/// A thing as it is drawn, in world axes.
struct Solid {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<Bounds> bounds;  // of the triangles
    Bounds all;
    bool is_moving = false;

    Corners corners(size_t t) const {
        return {Vec3d(points[triangles[t][0]]), Vec3d(points[triangles[t][1]]), Vec3d(points[triangles[t][2]])};
    }
    void finish() {
        for (const Triangle& t : triangles) {
            Bounds& b = bounds.emplace_back();
            for (const uint32_t k : t) b.include(points[k]), all.include(points[k]);
        }
    }
    // The winding number: a ray along x leaves a closed mesh once more than it enters it from inside, and as often from
    // outside. The ray starts a fifth of a micrometre beside p, so that it meets no corner and no edge. Needs no ray
    // scene, of which Embree bears no thousand; solid angles cost ten times as much.
    bool holds(Vec3 p) const {
        if (!all.holds(p)) return false;
        const Vec3d from = Vec3d(p) + Vec3d(0, 1.37e-7, 1.71e-7);
        int leaves = 0;
        for (size_t t = 0; t < triangles.size(); ++t)
            if (bounds[t].high.x >= p.x && bounds[t].holds_across(p)) leaves += crossing(from, corners(t));
        return leaves > 0;
    }
    double depth(Vec3 p) const {
        double least = 1e30;
        for (size_t t = 0; t < triangles.size(); ++t)
            if (bounds[t].squared_gap(p) <= least * least) least = std::min(least, point_gap(Vec3d(p), corners(t)));
        return least;
    }
};

struct Things {
    std::vector<Solid> solids;  // what never moves comes first
    std::vector<BodyRest> rest;
    size_t first_moving = 0;
};

void add(Things& things, const Mesh& mesh, const Pose& pose, float scale) {
    Solid& solid = things.solids.emplace_back();
    for (const Vec3 p : mesh.positions) solid.points.push_back(to_world(pose, scale * p));
    solid.triangles = mesh.triangles;
    solid.finish();
}

void add(Things& things, const BodyView& view) {
    Solid& solid = things.solids.emplace_back();
    for (uint32_t v = 0; v < view.vertex_count; ++v)
        solid.points.push_back(to_world(view.pose, view.vertices[v].position));
    for (uint32_t i = 0; i + 2 < view.index_count; i += 3)
        solid.triangles.push_back({view.indices[i], view.indices[i + 1], view.indices[i + 2]});
    solid.finish();
}

Things gather(const GameWorld& game) {
    Things things;
    const float ground_height = game.stage().ground_height();
    for (const Prop& prop : game.stage().props) add(things, prop.mesh, {}, 1);
    for (const Mover& mover : game.stage().movers)
        if (const Result<Pose> pose = game.world().pose(mover.body); pose.ok()) add(things, mover.mesh, *pose, 1);
    const World& world = game.world();
    const Bodies& rows = world.contents().data.state.bodies;
    std::vector<BodyId> ids(world.bodies(nullptr, 0));
    world.bodies(ids.data(), static_cast<uint32_t>(ids.size()));
    const Mesh ball = make_ball(1, 4);
    for (const bool is_moving : {false, true}) {
        if (is_moving) things.first_moving = things.solids.size();
        for (const BodyId id : ids) {
            const uint32_t b = id.index;
            const bool moves = rows.kind[b] == static_cast<uint8_t>(BodyKind::Dynamic) && !rows.has_pins[b];
            if (moves != is_moving) continue;
            const size_t before = things.solids.size();
            if (rows.is_sphere[b])
                add(things, ball, {rows.position[b], rows.orientation[b]}, rows.radius[b]);
            else if (const Result<BodyView> view = world.view(id); view.ok() && view->index_count > 0)
                add(things, *view);
            if (!moves || things.solids.size() == before) continue;
            things.solids.back().is_moving = true;
            BodyRest& rest = things.rest.emplace_back();
            rest.body = id;
            rest.is_asleep = rows.is_asleep[b];
            rest.is_through = things.solids.back().all.high.y < ground_height;
        }
    }
    return things;
}

double deepest(const Solid& inner, const Solid& outer) {
    double most = 0;
    if (!inner.all.is_within(outer.all, 0)) return most;
    for (const Vec3 p : inner.points)
        if (outer.holds(p)) most = std::max(most, outer.depth(p));
    return most;
}

/// Least of `best` and the gap between the two meshes.
double gap(const Solid& a, const Solid& b, double best) {
    const auto reach = static_cast<float>(best);
    if (!a.all.is_within(b.all, reach)) return best;
    std::vector<size_t> near;
    for (size_t t = 0; t < b.triangles.size(); ++t)
        if (b.bounds[t].is_within(a.all, reach)) near.push_back(t);
    for (size_t t = 0; t < a.triangles.size(); ++t) {
        if (near.empty() || !a.bounds[t].is_within(b.all, static_cast<float>(best))) continue;
        const Corners corners = a.corners(t);
        for (const size_t other : near) {
            if (!a.bounds[t].is_within(b.bounds[other], static_cast<float>(best))) continue;
            best = std::min(best, triangle_gap(corners, b.corners(other)));
            if (best < kTouching) return 0;
        }
    }
    return best;
}

}  // namespace

std::vector<BodyRest> measure_bodies(const GameWorld& game) {
    Things things = gather(game);
    for (size_t k = 0; k < things.rest.size(); ++k) {
        BodyRest& rest = things.rest[k];
        const Solid& solid = things.solids[things.first_moving + k];
        rest.hover = kMostHover;
        for (const Solid& other : things.solids) {
            if (&other == &solid) continue;
            double& depth = other.is_moving ? rest.overlap : rest.sink;
            depth = std::max(depth, deepest(solid, other));
            // What lies in another thing touches it, even where no faces cross.
            if (rest.sink > 0 || rest.overlap > 0) rest.hover = 0;
            if (rest.hover > 0) rest.hover = gap(solid, other, rest.hover);
        }
    }
    return std::move(things.rest);
}

Rest measure_rest(const GameWorld& game, double peak_kinetic_energy) {
    Rest out;
    const Matter matter = measure_matter(game.world());
    const uint64_t moving = matter.asleep + matter.awake;
    if (moving > 0) out.asleep_share = static_cast<double>(matter.asleep) / static_cast<double>(moving);
    if (peak_kinetic_energy > 0) out.kinetic_share = matter.kinetic_energy / peak_kinetic_energy;
    std::vector<float> sinks, overlaps, hovers;
    for (const BodyRest& body : measure_bodies(game)) {
        out.through += body.is_through;
        if (!body.is_asleep) continue;
        sinks.push_back(static_cast<float>(1000 * body.sink));
        overlaps.push_back(static_cast<float>(1000 * body.overlap));
        hovers.push_back(static_cast<float>(1000 * body.hover));
    }
    out.measured = sinks.size();
    out.sink_p95_mm = static_cast<double>(percentile(sinks, 0.95));
    out.sink_max_mm = static_cast<double>(percentile(sinks, 1));
    out.overlap_p95_mm = static_cast<double>(percentile(overlaps, 0.95));
    out.overlap_max_mm = static_cast<double>(percentile(overlaps, 1));
    out.hover_p95_mm = static_cast<double>(percentile(hovers, 0.95));
    out.hover_max_mm = static_cast<double>(percentile(hovers, 1));
    return out;
}

}  // namespace cullet
