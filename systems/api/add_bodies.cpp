// Bodies come into a world: of models, spheres, boxes that the game moves, level geometry.
#include <algorithm>

#include "components/body_id.hpp"
#include "engine/host_scope.hpp"
#include "systems/api/checks.hpp"
#include "systems/api/model_row.hpp"
#include "systems/bodies/body_rows.hpp"
#include "systems/bodies/model_mesh.hpp"
#include "systems/bodies/pin_boxes.hpp"
#include "systems/bodies/rigid_shape.hpp"
#include "systems/bodies/settled_pose.hpp"
#include "systems/cook/materials.hpp"
#include "systems/drawn/bound_drawn.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/models.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

Error no_room(const Bodies& bodies) {
    return Error{"limits.bodies is reached (" + std::to_string(bodies.limit()) + "); raise it or remove a body."};
}

// What every kind of body has.
void fill_body(Bodies& bodies, Row<Bodies> b, BodyKind kind, const Pose& pose, const Motion& motion,
               const ContactSettings& contact, float friction, uint64_t user_data) {
    bodies.kind[b] = static_cast<uint8_t>(kind);
    const Pose unit{pose.position, normalised(pose.orientation)};
    bodies.position.set(b, unit.position);
    bodies.orientation[b] = unit.orientation;
    bodies.previous_position.set(b, unit.position);
    bodies.previous_orientation[b] = unit.orientation;
    bodies.velocity.set(b, motion.velocity);
    bodies.spin.set(b, motion.angular_velocity);
    bodies.friction[b] = contact.friction >= 0 ? contact.friction : friction;
    bodies.restitution[b] = contact.restitution >= 0 ? contact.restitution : 0.2f;
    bodies.rolling_friction[b] = contact.rolling_friction >= 0 ? contact.rolling_friction : -1;
    bodies.layer[b] = contact.layer;
    bodies.mask[b] = contact.mask;
    bodies.user_data[b] = user_data;
}

RigidDescription description_of(const Bodies& bodies, Row<Bodies> b, RigidKind kind) {
    RigidDescription d;
    d.kind = kind;
    d.pose = pose_of(bodies, b);
    d.motion = {bodies.velocity[b], bodies.spin[b]};
    d.mass = bodies.mass[b];
    d.centre = bodies.centre[b];
    d.inertia = bodies.inertia[b];
    d.friction = bodies.friction[b];
    d.restitution = bodies.restitution[b];
    d.rolling_share = std::max(bodies.rolling_friction[b], 0.0f);
    d.layer = bodies.layer[b];
    d.mask = bodies.mask[b];
    return d;
}

// Of what has no material.
constexpr float kPlainFriction = 0.45f;
// Of its radius: as of a hard ball on a rough floor. One that is let go at 1 m/s rolls for 7 m.
constexpr float kRollingOfBalls = 0.01f;
// From here on nothing cracks; columns hold no infinity.
constexpr float kNeverCracks = 1e9f;

}  // namespace

Result<BodyId> World::spawn(ModelId id, const SpawnSettings& settings) {
    WorldData& d = contents_->data;
    State& state = d.state;
    const HostScope call(contents_->host);
    if (contents_->recorder) contents_->recorder->spawn(id, settings);
    const Row<Models> model = model_row(state.models, id);
    if (!model.exists()) return stale("model", id.index);
    if (const Result<void> valid = check_body(settings.pose, settings.motion, settings.contact); !valid)
        return Error{valid.error()};
    if (!(settings.strength_scale > 0))
        return Error{"strength_scale is " + std::to_string(settings.strength_scale) + "; use more than 0."};
    if (settings.pin_count > 0 && !settings.pins)
        return Error{"pin_count is " + std::to_string(settings.pin_count) + " but pins is null; give the boxes."};
    const DamageModels& models = *d.damage_models;
    const Spawning spawning{settings, settings.is_breakable && settings.strength_scale < kNeverCracks,
                            d.rigid->knows_surfaces(), d.step_info.dt, d.damage_settings.units_a_frame};
    const Row<Structures> shared = state.models.structure[model];
    if (const Result<void> valid = models.check_spawn(state, shared, settings); !valid) return Error{valid.error()};
    const Result<Row<Structures>> own = models.spawn_structure(state, shared, spawning);
    if (!own) return Error{own.error()};
    const Row<Structures> structure = own.value();
    if (structure == shared) ++state.structures.users[structure];
    const Row<Bodies> body = take_body(state);
    if (!body.exists()) {
        calls_of(state.structures, structure).release(state, structure);
        return no_room(state.bodies);
    }
    Bodies& bodies = state.bodies;
    bodies.structure[body] = structure;
    const bool is_models = structure == shared;  // drawn as all others of the model, until it cracks
    Row<ModelMeshes>& mesh = state.models.mesh[model];
    const bool is_drawn = is_models && mesh.exists();
    if (is_drawn) {
        show_model_mesh(state, body, mesh);
    } else if (!take_view(state, body, settings.is_breakable && !is_models)) {
        free_body(state, body);
        return Error{"limits.view_vertices is reached (" + std::to_string(state.view_vertices.limit()) +
                     "); raise it."};
    }
    const bool is_static = settings.pin_count > 0;
    fill_body(bodies, body, is_static ? BodyKind::Static : BodyKind::Dynamic, settings.pose,
              is_static ? Motion{} : settings.motion, settings.contact,
              state.materials.friction[state.structures.material[structure]], settings.user_data);
    bodies.model[body] = model;
    bodies.has_pins[body] = is_static;
    if (is_static) bodies.pins[body] = add_pin_boxes(state, {settings.pins, settings.pin_count});
    if (is_static && bodies.pins[body].count == 0) {
        free_body(state, body);
        return Error{"no room for " + std::to_string(settings.pin_count) + " pin boxes; raise limits.bodies."};
    }
    bodies.strength_scale[body] = std::min(settings.strength_scale, kNeverCracks);
    bodies.strength_seed[body] = settings.strength_seed;
    take_mass_properties(state.bodies, state.structures, body,
                         calls_of(state.structures, structure).radius(state, structure));
    const Result<ShellRoom> room = models.spawn_body(state, body, spawning);
    if (!room) {
        free_body(state, body);
        return Error{room.error()};
    }
    if (room->vertices > 0) d.make_ready(*room);
    d.arena.reset();
    d.rigid->add(body, describe_rigid(state.bodies, state.structures, body, convex_pieces(state, structure, d.arena)));
    if (take_settled_pose(bodies, *d.rigid, body)) models.follow(state, body);
    bodies.drawn_frame[body] = d.step_info.frame;
    if (!is_drawn) {
        calls_of(state.structures, structure).draw(state, body);
        bound_view(bodies, body, state.view_vertices, state.view_indices, d.view_boxes);
        if (is_models) mesh = give_model_mesh(state, body);
    }
    d.query_index->touch(bodies, body);
    return body_id(bodies, body);
}

Result<BodyId> World::add_sphere(const SphereSettings& settings) {
    WorldData& d = contents_->data;
    const HostScope call(contents_->host);
    if (contents_->recorder) contents_->recorder->add_sphere(settings);
    if (const Result<void> valid = check_body(settings.pose, settings.motion, settings.contact); !valid)
        return Error{valid.error()};
    if (!(settings.radius > 0 && settings.radius <= kFarthest && settings.mass > 0 && settings.mass <= kHeaviest))
        return Error{"a sphere needs a radius above 0, at most 1e6 m, and a mass above 0, at most 1e12 kg; got " +
                     std::to_string(settings.radius) + " m and " + std::to_string(settings.mass) + " kg."};
    const Row<Bodies> body = take_body(d.state);
    if (!body.exists()) return no_room(d.state.bodies);
    Bodies& bodies = d.state.bodies;
    fill_body(bodies, body, BodyKind::Dynamic, settings.pose, settings.motion, settings.contact, kPlainFriction,
              settings.user_data);
    bodies.mass[body] = settings.mass;
    const double inertia = 0.4 * settings.mass * settings.radius * settings.radius;
    bodies.inertia[body] = {inertia, inertia, inertia, 0, 0, 0};
    bodies.radius[body] = settings.radius;
    bodies.is_sphere[body] = 1;
    RigidDescription description = description_of(bodies, body, RigidKind::Dynamic);
    description.radius = settings.radius;
    if (settings.contact.rolling_friction < 0) description.rolling_share = kRollingOfBalls;
    description.rolling_friction = description.rolling_share * settings.radius;
    d.rigid->add(body, description);
    take_settled_pose(bodies, *d.rigid, body);
    d.query_index->touch(bodies, body);
    return body_id(bodies, body);
}

Result<BodyId> World::add_kinematic_box(const KinematicSettings& settings) {
    WorldData& d = contents_->data;
    const HostScope call(contents_->host);
    if (contents_->recorder) contents_->recorder->add_kinematic_box(settings);
    if (const Result<void> valid = check_body(settings.pose, settings.motion, settings.contact); !valid)
        return Error{valid.error()};
    const Vec3 h = settings.half_extents;
    if (!(h.x > 0 && h.y > 0 && h.z > 0 && is_within(h, kFarthest)))
        return Error{"half_extents of a box are " + text(h) + "; use more than 0 and at most 1e6 m."};
    const Row<Bodies> body = take_body(d.state);
    if (!body.exists()) return no_room(d.state.bodies);
    Bodies& bodies = d.state.bodies;
    fill_body(bodies, body, BodyKind::Kinematic, settings.pose, settings.motion, settings.contact, kPlainFriction,
              settings.user_data);
    Vec3 corners[8];
    RigidDescription description = description_of(bodies, body, RigidKind::Kinematic);
    const float margin = std::min(description.margin, 0.2f * std::min({h.x, h.y, h.z}));
    const Vec3 pulled_in = h - Vec3{margin, margin, margin};
    for (int k = 0; k < 8; ++k)
        corners[k] = {k & 1 ? pulled_in.x : -pulled_in.x, k & 2 ? pulled_in.y : -pulled_in.y,
                      k & 4 ? pulled_in.z : -pulled_in.z};
    const ConvexPiece piece{corners, 0};
    description.margin = margin;
    description.pieces = {&piece, 1};
    d.rigid->add(body, description);
    d.query_index->set_box(body, h);
    d.query_index->touch(bodies, body);
    return body_id(bodies, body);
}

namespace {

// Where nobody listens it is not said.
void tell_left_out(const Host& host, const std::string& name, LeftOut left_out, size_t triangles) {
    if (left_out.count == 0 || !host.log) return;
    const std::string sentence = name + ": " + std::to_string(left_out.count) + " of " + std::to_string(triangles) +
                                 " triangles have no area or repeat another one; they are left out (the first: " +
                                 std::to_string(left_out.first) + ").";
    host.log(host.user, LogLevel::Warning, sentence.c_str());
}

}  // namespace

Result<BodyId> World::add_static(const MeshView& mesh, const ContactSettings& contact, uint64_t user_data,
                                 bool one_sided) {
    WorldData& d = contents_->data;
    const HostScope call(contents_->host);
    if (contents_->recorder) contents_->recorder->add_static(mesh, contact, user_data, one_sided);
    const std::string name = mesh.name ? mesh.name : "static mesh";
    if (!mesh.positions || !mesh.indices || mesh.triangle_count == 0)
        return Error{name + ": has no triangles; give positions and indices."};
    if (const Result<void> valid = check_contact(contact); !valid) return Error{name + ": " + valid.error()};
    std::vector<std::array<uint32_t, 3>> triangles(mesh.triangle_count);
    for (size_t t = 0; t < mesh.triangle_count; ++t)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = mesh.indices[3 * t + k];
            if (v >= mesh.position_count)
                return Error{name + ": triangle " + std::to_string(t) + " names vertex " + std::to_string(v) + " of " +
                             std::to_string(mesh.position_count) + "; give indices below the number of positions."};
            if (!is_within(mesh.positions[v], kFarthest))
                return Error{name + ": vertex " + std::to_string(v) + " stands at " + text(mesh.positions[v]) +
                             "; give metres, at most 1000000 from the origin along each axis."};
            triangles[t][k] = v;
        }
    const Row<Bodies> body = take_body(d.state);
    if (!body.exists()) return no_room(d.state.bodies);
    Bodies& bodies = d.state.bodies;
    fill_body(bodies, body, BodyKind::Static, {}, {}, contact, kPlainFriction, user_data);
    d.rigid->add_static_triangles(body, {mesh.positions, mesh.position_count}, triangles, bodies.friction[body],
                                  bodies.restitution[body], bodies.layer[body], bodies.mask[body], one_sided);
    tell_left_out(contents_->host, name, d.rigid->left_out(body), mesh.triangle_count);
    d.rigid->set_rolling_share(body, std::max(bodies.rolling_friction[body], 0.0f));
    d.query_index->set_triangles(body, {mesh.positions, mesh.position_count}, triangles);
    d.query_index->touch(bodies, body);
    return body_id(bodies, body);
}

}  // namespace cullet
