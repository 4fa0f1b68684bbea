#include "sample_game/rest.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/profiler.hpp"
#include "sample_game/fallen_through.hpp"
#include "sample_game/mesh_gap.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/solid.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr double kTouching = 0.0001;  // m: nearer is touching, how much nearer nobody asks

struct Things {
    std::vector<DrawnSolid> solids;  // what never moves comes first
    std::vector<BodyRest> rest;
    size_t first_moving = 0;
};

void add(Things& things, const Mesh& mesh, const Pose& pose, float scale) {
    DrawnSolid& solid = things.solids.emplace_back();
    for (const Vec3 p : mesh.positions) solid.points.push_back(to_world(pose, scale * p));
    solid.triangles = mesh.triangles;
    solid.finish();
}

Things gather(const GameWorld& game) {
    Things things;
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
                things.solids.push_back(solid_of(*view));
            if (!moves || things.solids.size() == before) continue;
            things.solids.back().is_moving = true;
            BodyRest& rest = things.rest.emplace_back();
            rest.body = id;
            rest.is_asleep = rows.is_asleep[b];
            const Structures& structures = world.contents().data.state.structures;
            const bool is_shell = rows.structure[b].exists();
            const auto shape =
                is_shell ? static_cast<ShapeKind>(structures.shape[rows.structure[b]]) : ShapeKind::Cells;
            rest.is_box = shape == ShapeKind::Box, rest.is_hull = shape == ShapeKind::Hull;
        }
    }
    return things;
}

/// Least of `best` and the gap between the two meshes.
double gap(const DrawnSolid& a, const DrawnSolid& b, double best) {
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
        const DrawnSolid& solid = things.solids[things.first_moving + k];
        rest.is_through = has_fallen_through(solid, std::span(things.solids).first(things.first_moving));
        rest.hover = kMostHover;
        for (const DrawnSolid& other : things.solids) {
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
    std::vector<float> sinks, overlaps, hovers, hovers_of_boxes, hovers_of_hulls;
    for (const BodyRest& body : measure_bodies(game)) {
        out.through += body.is_through;
        if (!body.is_asleep) continue;
        sinks.push_back(static_cast<float>(1000 * body.sink));
        overlaps.push_back(static_cast<float>(1000 * body.overlap));
        std::vector<float>& of_its_kind = body.is_box ? hovers_of_boxes : body.is_hull ? hovers_of_hulls : hovers;
        of_its_kind.push_back(static_cast<float>(1000 * body.hover));
    }
    out.measured = sinks.size();
    out.sink_p95_mm = static_cast<double>(percentile(sinks, 0.95));
    out.sink_max_mm = static_cast<double>(percentile(sinks, 1));
    out.overlap_p95_mm = static_cast<double>(percentile(overlaps, 0.95));
    out.overlap_max_mm = static_cast<double>(percentile(overlaps, 1));
    out.hover_p95_mm = static_cast<double>(percentile(hovers, 0.95));
    out.hover_max_mm = static_cast<double>(percentile(hovers, 1));
    out.hover_boxes_max_mm = static_cast<double>(percentile(hovers_of_boxes, 1));
    out.hover_hulls_max_mm = static_cast<double>(percentile(hovers_of_hulls, 1));
    return out;
}

}  // namespace cullet
