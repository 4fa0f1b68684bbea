#include "systems/births/make_pieces.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "engine/rigid_bounds.hpp"
#include "systems/births/limit_flight.hpp"
#include "systems/births/make_debris.hpp"
#include "systems/births/part_siblings.hpp"
#include "systems/bodies/rigid_shape.hpp"
#include "systems/bodies/thresholds.hpp"

namespace cullet {
namespace {

// The row of Debris; planning counted: there is room.
uint32_t make_debris(Births& births, const Break& plan, Row<Fragments> f, const Moment& moment) {
    const PartMotion part = motion_of(births.fragments, f);
    const Motion motion = world_motion(moment, part);
    return make_debris({births.debris, births.debris_ages}, births.state.bodies, births.rigid,
                       {plan.body, to_world(moment.pose, part.centre.to_float()), motion.velocity,
                        births.fragments.mass[f], births.fragments.volume[f]},
                       births.step.frame, births.debris_events);
}

void place_body(Births& births, Row<Bodies> body, const Moment& moment, const Motion& motion, bool is_static,
                bool is_local) {
    Bodies& bodies = births.state.bodies;
    if (static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Free) {
        // Nothing moved since the step began: a new piece was where its parent was.
        bodies.position.set(body, moment.pose.position);
        bodies.orientation[body] = moment.pose.orientation;
        bodies.previous_position.set(body, moment.pose.position);
        bodies.previous_orientation[body] = moment.pose.orientation;
    }
    bodies.kind[body] = static_cast<uint8_t>(is_static ? BodyKind::Static : BodyKind::Dynamic);
    bodies.has_pins[body] = is_static;
    if (!is_static) bodies.pins[body] = {};
    bodies.velocity.set(body, is_static ? Vec3{} : motion.velocity);
    bodies.spin.set(body, is_static ? Vec3{} : motion.angular_velocity);
    bodies.retry_frame[body] = births.step.frame + retry_frames(births.step.dt);
    bodies.overload_runs[body] = 0;
    bodies.is_asleep[body] = 0;
    if (is_local)
        take_rest_properties(bodies, births.state.structures, body);
    else
        take_mass_properties(bodies, births.state.structures, body,
                             births.calls(bodies.structure[body]).radius(births.state, bodies.structure[body]));
    births.changed.push({body, is_local});
}

// False: this rigid world wants all pieces.
bool change_rest(Births& births, Row<Bodies> body) {
    const Bodies& bodies = births.state.bodies;
    std::span<const uint32_t> gone;
    const auto pieces = changed_pieces(births.state, bodies.structure[body], births.arena, gone);
    return births.rigid.change_shape(body, bodies.mass[body], bodies.centre[body], bodies.inertia[body], gone, pieces);
}

// The limit of what leaves, and what it has cut off so far, which the largest piece takes, or the support when that
// holds it. Body axes.
struct Leaving {
    FlightLimit limit;
    Vec3d cut;  // N s
};

// The largest part comes last.
PartMotion limited_motion(Births& births, const Break& plan, Row<Fragments> f, const Moment& moment, Leaving& leaving) {
    PartMotion part = motion_of(births.fragments, f);
    if (f != plan.largest) {
        const bool was_clamped = part.is_speed_clamped || part.is_spin_clamped;
        const Row<Structures> piece = births.state.bodies.structure[births.fragments.child[f]];
        leaving.cut += limit_flight(leaving.limit, births.state.structures.centre[piece], part);
        births.counts.clamped += !was_clamped && (part.is_speed_clamped || part.is_spin_clamped);
    } else if (!part.is_static && part.mass > 0) {
        part.velocity += (1 / part.mass) * leaving.cut;
    } else {
        const Vec3 cut = rotate(moment.pose.orientation, leaving.cut.to_float());
        auto& given = births.counts.impulse_to_static;
        given[0] += double{cut.x}, given[1] += double{cut.y}, given[2] += double{cut.z};
    }
    return part;
}

// A blow without measure may leave pieces faster than the rigid world takes.
Motion bounded_motion(Births& births, Motion motion) {
    const bool is_too_fast = shorten(motion.velocity, kFastest),
               spins_too_fast = shorten(motion.angular_velocity, kFastest);
    births.counts.clamped += is_too_fast || spins_too_fast;
    return motion;
}

// What a body was drawn as holds its hulls.
PieceBounds drawn_bounds(const Bodies& bodies, Row<Bodies> body) {
    const auto& drawn = bodies.drawn_box[body];
    return {{drawn[0], drawn[1], drawn[2]}, {drawn[3], drawn[4], drawn[5]}};
}

PieceBounds bounds_of(std::span<const ConvexPiece> pieces) {
    PieceBounds bounds;
    for (const ConvexPiece& piece : pieces)
        for (const Vec3 point : piece.points) bounds.add(point);
    return bounds;
}

void add_body(Births& births, Row<Bodies> body, Row<Bodies> parent, std::span<const ConvexPiece> pieces) {
    RigidDescription description = describe_rigid(births.state.bodies, births.state.structures, body, pieces);
    description.parent = parent;
    births.rigid.add(body, description);
}

// What is left has its place in the rigid world already, unless it begins to move or to stand.
void reshape_rest(Births& births, const Break& plan, std::span<const ConvexPiece> pieces, const Motion& motion,
                  bool was_static, bool is_static) {
    const Bodies& bodies = births.state.bodies;
    const Row<Bodies> body = plan.body;
    if (was_static != is_static) {
        births.rigid.remove(body);
        return add_body(births, body, body, pieces);
    }
    // Hulls of a copy's cells that did not change are those of the body, by the same names.
    const bool has_cells = births.state.structures.shape_points[bodies.structure[body]] == 0;
    const bool is_of_copy = !plan.keeps_hulls && !plan.is_torn && plan.had_cells && has_cells &&
                            births.models.keeps_cell_names(births.state, body);
    if (!is_of_copy || !change_rest(births, body))
        births.rigid.set_shape(body, bodies.mass[body], bodies.centre[body], bodies.inertia[body], pieces);
    if (!was_static) births.rigid.set_motion(body, motion);
}

// One fragment's row, rigid body and event. The body frame and the pose stay the parent's.
PieceBounds make_piece_body(Births& births, const Break& plan, Row<Fragments> f, const Moment& moment,
                            Leaving& leaving) {
    auto& state = births.state;
    Bodies& bodies = state.bodies;
    const Row<Bodies> body = plan.body, child = births.fragments.child[f];
    const Motion motion =
        bounded_motion(births, world_motion(moment, limited_motion(births, plan, f, moment, leaving)));
    const bool was_static = static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Static;
    const bool is_static = births.fragments.has_pins[f] != 0;
    const bool is_rest = f == plan.largest, keeps_hulls = is_rest && plan.keeps_hulls;
    place_body(births, child, moment, motion, is_static, is_rest && plan.keeps_mesh);
    const Row<Structures> structure = bodies.structure[child];
    births.calls(structure).pack_hulls(state, structure, keeps_hulls);
    if (keeps_hulls && was_static == is_static && change_rest(births, body)) {
        if (!was_static) births.rigid.set_motion(body, motion);
        return drawn_bounds(bodies, body);
    }
    const auto pieces = convex_pieces(state, structure, births.arena, body);
    const PieceBounds bounds = keeps_hulls ? drawn_bounds(bodies, body) : bounds_of(pieces);
    if (is_rest) {
        reshape_rest(births, plan, pieces, motion, was_static, is_static);
        return bounds;
    }
    add_body(births, child, body, pieces);
    set_born(state.fragment_ages, child, births.step.frame + 1);
    births.born.push({body_id(bodies, child), body_id(bodies, body), bodies.user_data[body],
                      to_world(moment.pose, bodies.centre[child].to_float()), motion, bodies.mass[child],
                      state.structures.generation[structure]});
    return bounds;
}

}  // namespace

void make_pieces(Births& births, const Break& plan, const Moment& moment) {
    Fragments& f = births.fragments;
    const uint32_t count = plan.fragments.count;
    for (uint32_t i = 1; i < count; ++i)
        if (const Row<Fragments> row = plan.in_order(f, i); f.is_debris[row])
            f.debris[row] = make_debris(births, plan, row, moment);
    f.child[plan.largest] = plan.body;
    const auto bounds = births.arena.take<PieceBounds>(count);
    Leaving leaving;
    if (plan.task.exists()) leaving.limit = flight_limit(births.state, births.blows, plan.task);
    for (uint32_t i = 1; i <= count; ++i) {
        const Row<Fragments> row = plan.in_order(f, i % count);
        if (f.child[row].exists())
            bounds[row - plan.fragments.first] = make_piece_body(births, plan, row, moment, leaving);
    }
    name_siblings(births, plan);
    part_siblings(births, plan, moment, bounds);
}

}  // namespace cullet
