// Another place becomes the origin.
#include "components/body_id.hpp"
#include "engine/host_scope.hpp"
#include "systems/api/checks.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

// Rows take their pose from the rigid world, which rounds the centre of mass and not the frame's origin.
void shift_bodies(Bodies& bodies, const RigidWorld& rigid, Vec3 by) {
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const auto kind = static_cast<BodyKind>(bodies.kind[b]);
        if (kind == BodyKind::Free) continue;
        const bool is_moved = kind == BodyKind::Dynamic || kind == BodyKind::Kinematic;
        bodies.position.set(b, is_moved ? rigid.pose(b).position : bodies.position[b] + by);
        bodies.previous_position.set(b, bodies.previous_position[b] + by);
    }
}

void shift_debris(Debris& debris, Vec3 by) {
    for (uint32_t d = 0; d < debris.size(); ++d) {
        debris.position.set(d, debris.position[d] + by);
        debris.floor[d] += by.y;
    }
}

// Those that have found their body stand in its frame.
void shift_blows(Blows& blows, Vec3 by) {
    for (uint32_t b = 0; b < blows.size(); ++b) {
        if (blows.body[b].exists()) continue;
        blows.point.set(b, blows.point[b] + by);
        for (uint32_t i = 0; i < blows.point_count[b]; ++i) set_cut_point(blows, b, i, cut_point(blows, b, i) + by);
    }
}

void shift_springs(ShellSprings& springs, Vec3 by) {
    for (uint32_t row = 0; row < springs.size(); ++row)
        if (springs.is_used[row]) springs.origin.set(row, springs.origin[row] + by);
}

// What happened in the last step is still to be read.
void shift_events(WorldData& d, Vec3 by) {
    d.told.for_each([by](auto& events) {
        for (auto& event : events.all()) event.place += by;
    });
}

}  // namespace

Result<void> World::shift_origin(Vec3 by) {
    const HostScope call(contents_->host);
    WorldData& d = contents_->data;
    if (!is_within(by, kFarthest))
        return Error{"shift_origin by " + text(by) + "; give metres, at most 1000000 along each axis."};
    if (contents_->recorder) contents_->recorder->shift_origin(by);
    shift_springs(d.state.shell_springs, -by);
    d.rigid->shift(-by);
    shift_bodies(d.state.bodies, *d.rigid, -by);
    shift_debris(d.state.debris, -by);
    shift_blows(d.state.blows, -by);
    shift_events(d, -by);
    d.query_index->shift(-by);
    d.query_index->refresh(d.state.bodies);
    return {};
}

}  // namespace cullet
