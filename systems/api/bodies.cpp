// What a game asks of a body, and what it does to one.
#include "components/body_id.hpp"
#include "engine/host_scope.hpp"
#include "systems/api/checks.hpp"
#include "systems/bodies/settled_pose.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/models.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

bool World::is_alive(BodyId id) const {
    return body_row(contents_->data.state.bodies, id).exists();
}

Result<Pose> World::pose(BodyId id) const {
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    return pose_of(bodies, body);
}

Result<Motion> World::motion(BodyId id) const {
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    return Motion{bodies.velocity[body], bodies.spin[body]};
}

Result<double> World::mass(BodyId id) const {
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    return bodies.mass[body];
}

Result<uint64_t> World::user_data(BodyId id) const {
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    return bodies.user_data[body];
}

Result<bool> World::is_asleep(BodyId id) const {
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    return bodies.is_asleep[body] != 0;
}

namespace {

bool is_finite(Vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// A quaternion and its negative are one rotation.
bool are_one_turn(Quat a, Quat b) {
    const auto is_same = [a, b](float sign) {
        return a.x == sign * b.x && a.y == sign * b.y && a.z == sign * b.z && a.w == sign * b.w;
    };
    return is_same(1) || is_same(-1);
}

void wake_body(WorldData& d, Row<Bodies> body) {
    if (static_cast<BodyKind>(d.state.bodies.kind[body]) != BodyKind::Dynamic) return;
    d.rigid->wake(body);
    d.state.bodies.is_asleep[body] = 0;
}

}  // namespace

Result<void> World::set_pose(BodyId id, const Pose& pose) {
    const HostScope call(contents_->host);
    WorldData& d = contents_->data;
    const Row<Bodies> body = body_row(d.state.bodies, id);
    if (!body.exists()) return stale("body", id.index);
    if (const Result<void> valid = check_pose(pose); !valid) return valid;
    Bodies& bodies = d.state.bodies;
    if (static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Static && !bodies.structure[body].exists())
        return Error{"body " + std::to_string(id.index) +
                     " is made of static triangles in world coordinates; remove it and add it where it is to stand."};
    if (contents_->recorder) contents_->recorder->set_pose(id, pose);
    const Pose unit{pose.position, normalised(pose.orientation)};
    const Quat stands = bodies.orientation[body];
    const bool is_there = bodies.position[body] == unit.position &&
                          (are_one_turn(stands, unit.orientation) || are_one_turn(stands, pose.orientation));
    if (is_there) {
        bodies.previous_position.set(body, bodies.position[body]);
        bodies.previous_orientation[body] = bodies.orientation[body];
        return {};
    }
    // Put there, not moved there: nothing to draw between the two places.
    bodies.position.set(body, unit.position);
    bodies.orientation[body] = unit.orientation;
    bodies.previous_position.set(body, unit.position);
    bodies.previous_orientation[body] = unit.orientation;
    if (static_cast<BodyKind>(bodies.kind[body]) != BodyKind::Scenery) {
        d.rigid->set_pose(body, unit);
        take_settled_pose(bodies, *d.rigid, body);
    }
    d.damage_models->follow(d.state, body);
    d.query_index->touch(bodies, body);
    wake_body(d, body);
    return {};
}

Result<void> World::set_motion(BodyId id, const Motion& motion) {
    const HostScope call(contents_->host);
    WorldData& d = contents_->data;
    const Row<Bodies> body = body_row(d.state.bodies, id);
    if (!body.exists()) return stale("body", id.index);
    if (const Result<void> valid = check_motion(motion); !valid) return valid;
    const auto kind = static_cast<BodyKind>(d.state.bodies.kind[body]);
    if (kind == BodyKind::Static || kind == BodyKind::Scenery)
        return Error{"body " + std::to_string(id.index) +
                     " is static (level geometry, pinned, or retired) and has no motion; use a kinematic body."};
    if (contents_->recorder) contents_->recorder->set_motion(id, motion);
    // What sleeps is still: a motion that it has already, or none, changes nothing.
    Bodies& bodies = d.state.bodies;
    const bool is_moving = !(motion.velocity == Vec3{} && motion.angular_velocity == Vec3{});
    const bool has_it = bodies.velocity[body] == motion.velocity && bodies.spin[body] == motion.angular_velocity;
    if (bodies.is_asleep[body] && (has_it || !is_moving)) return {};
    d.state.bodies.velocity.set(body, motion.velocity);
    d.state.bodies.spin.set(body, motion.angular_velocity);
    d.rigid->set_motion(body, motion);
    d.damage_models->follow(d.state, body);
    if (is_moving) wake_body(d, body);
    return {};
}

Result<void> World::apply_impulse(BodyId id, Vec3 impulse, Vec3 place) {
    const HostScope call(contents_->host);
    const Bodies& bodies = contents_->data.state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    if (!is_finite(impulse) || !is_finite(place))
        return Error{"impulse is " + text(impulse) + " at " + text(place) + "; give finite N s and m."};
    if (static_cast<BodyKind>(bodies.kind[body]) != BodyKind::Dynamic) return {};  // nothing moves it
    const Pose pose = pose_of(bodies, body);
    const Vec3 arm = place - to_world(pose, bodies.centre[body].to_float());
    const Vec3d turn(rotate(conjugate(pose.orientation), cross(arm, impulse)));
    const Vec3 spin = rotate(pose.orientation, (inverse(bodies.inertia[body]) * turn).to_float());
    return set_motion(
        id, {bodies.velocity[body] + static_cast<float>(1.0 / bodies.mass[body]) * impulse, bodies.spin[body] + spin});
}

Result<void> World::wake(BodyId id) {
    WorldData& d = contents_->data;
    const Row<Bodies> body = body_row(d.state.bodies, id);
    if (!body.exists()) return stale("body", id.index);
    const HostScope call(contents_->host);
    if (contents_->recorder) contents_->recorder->wake(id);
    wake_body(d, body);
    return {};
}

uint32_t World::bodies(BodyId* out, uint32_t capacity) const {
    const Bodies& bodies = contents_->data.state.bodies;
    uint32_t count = 0;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Free) continue;
        if (count < capacity) out[count] = body_id(bodies, Row<Bodies>(b));
        ++count;
    }
    return count;
}

}  // namespace cullet
