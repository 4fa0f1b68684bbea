#include "systems/births/make_break.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "engine/rigid_bounds.hpp"
#include "systems/births/limit_energy.hpp"
#include "systems/births/limit_flight.hpp"
#include "systems/births/make_crumb.hpp"
#include "systems/births/strike_back.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/models.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/rigid_shape.hpp"
#include "systems/structures/shell/waiting_pieces.hpp"

namespace cullet {
namespace {

// A striker beside the shards it made is not tested against them for so long.
constexpr float kStrikerSeconds = 0.1f;
constexpr float kTouch = 0.004f;  // m between the bounds of two siblings that count as in touch

// What turns the hidden state's motions into the world's. `change` is the body's motion now less the hidden motion that
// stands for it, both in body axes about the pieces' common centre. On time that is its motion at the touch: zero,
// unless something pushed the body while it was held. Late it is the hidden state's mean, because the rigid solver has
// passed the blow's impulse already; a pinned body has no motion to be relative to.
struct Moment {
    Pose pose;
    Vec3d centre;  // of the pieces' vertices, body frame
    Vec3d velocity_change, spin_change;
    bool is_late;
};

struct Mean {
    double mass = 0;
    Vec3d centre, velocity, spin;  // body axes; at rest when some part is pinned
};

Mean mean_of(std::span<const PartMotion> motions) {
    Mean mean;
    bool is_pinned = false;
    Vec3d momentum, turning;
    for (const PartMotion& m : motions) {
        mean.mass += m.mass;
        mean.centre += m.mass * m.centre;
        momentum += m.momentum;
        is_pinned = is_pinned || m.is_static;
    }
    if (!(mean.mass > 0)) return mean;
    mean.centre = (1 / mean.mass) * mean.centre;
    if (is_pinned) return mean;
    mean.velocity = (1 / mean.mass) * momentum;
    Sym3d inertia;
    for (const PartMotion& m : motions) {
        if (!(m.mass > 0)) continue;
        const Vec3d arm = m.centre - mean.centre;
        inertia = inertia + m.inertia + m.mass * inertia_of(outer(arm));
        turning += m.inertia * m.spin + cross(arm, m.momentum);
    }
    const double scale = trace(inertia);
    if (determinant(inertia) > 1e-12 * scale * scale * scale) mean.spin = inverse(inertia) * turning;
    return mean;
}

Moment moment_of(const BodyRows& state, Row<Tasks> task, std::span<const PartMotion> motions) {
    const Row<Bodies> body = state.tasks.body[task];
    const Mean mean = mean_of(motions);
    Moment m{pose_of(state.bodies, body), mean.centre, {}, {}, state.tasks.is_late[task] != 0};
    const Quat to_body_axes = conjugate(m.pose.orientation);
    m.velocity_change = Vec3d(rotate(to_body_axes, state.bodies.velocity[body])) -
                        (m.is_late ? mean.velocity : Vec3d(state.tasks.start_velocity[task]));
    m.spin_change = Vec3d(rotate(to_body_axes, state.bodies.spin[body])) -
                    (m.is_late ? mean.spin : Vec3d(state.tasks.start_spin[task]));
    return m;
}

Motion world_motion(const Moment& m, const PartMotion& part) {
    if (part.is_static) return {};
    const Vec3d velocity = part.velocity + m.velocity_change + cross(m.spin_change, part.centre - m.centre);
    return {rotate(m.pose.orientation, velocity.to_float()),
            rotate(m.pose.orientation, (part.spin + m.spin_change).to_float())};
}

// The row of the crumb; planning counted: there is room.
uint32_t make_debris(Births& births, const Break& plan, uint32_t p, const Moment& moment) {
    const SoftRows& state = births.state;
    const ShellView shell(births.state, plan.broken);
    double volume = 0;
    for (uint32_t e = plan.parts[p].first_element; e != kNone; e = state.elements.next[shell.element(e)])
        volume += state.elements.volume[shell.element(e)];
    const Motion motion = world_motion(moment, plan.motions[p]);
    return make_crumb({births.debris, births.debris_ages}, state.bodies, births.rigid,
                      {plan.body, to_world(moment.pose, plan.motions[p].centre.to_float()), motion.velocity,
                       plan.parts[p].mass, volume},
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
        take_rest_properties(births.state.bodies, births.state.structures, body);
    else
        take_mass_properties(births.state.bodies, births.state.structures, body,
                             radius_of(ShellView(births.state, births.state.bodies.structure[body])));
    births.changed.push({body, is_local});
}

struct Bounds {
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    void add(Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    bool is_near(const Bounds& o) const {
        return low.x <= o.high.x + kTouch && o.low.x <= high.x + kTouch && low.y <= o.high.y + kTouch &&
               o.low.y <= high.y + kTouch && low.z <= o.high.z + kTouch && o.low.z <= high.z + kTouch;
    }
};

/// Where parts had been one, pair by pair: world axes.
class Cracks {
 public:
    /// Without room in the arena there are none.
    Cracks(std::span<const Touch> touches, const Pose& pose, Arena& arena)
        : of_(arena.take<Between>(touches.size())), touches_(arena.take<CrackTouch>(touches.size())) {
        if (of_.size() < touches.size() || touches_.size() < touches.size()) of_ = {};
        for (uint32_t t = 0; t < of_.size(); ++t)
            of_[t] = {std::min(touches[t].a, touches[t].b), std::max(touches[t].a, touches[t].b), t};
        std::sort(of_.begin(), of_.end());
        for (size_t k = 0; k < of_.size(); ++k) {
            const Touch& t = touches[of_[k].touch];
            const Vec3 normal = rotate(pose.orientation, t.normal.to_float());
            touches_[k] = {to_world(pose, t.point.to_float()), t.a < t.b ? normal : -normal,
                           static_cast<float>(t.reach)};
        }
    }
    /// Normals from q towards p, p < q.
    std::span<const CrackTouch> between(uint32_t p, uint32_t q) const {
        const auto first = std::lower_bound(of_.begin(), of_.end(), Between{p, q, 0}),
                   last = std::lower_bound(first, of_.end(), Between{p, q + 1, 0});
        return touches_.subspan(static_cast<size_t>(first - of_.begin()), static_cast<size_t>(last - first));
    }

 private:
    struct Between {
        uint32_t p, q, touch;
        auto operator<=>(const Between&) const = default;
    };
    std::span<Between> of_;
    std::span<CrackTouch> touches_;
};

// What is left of the body is one of them.
void name_siblings(Births& births, const Break& plan) {
    const auto ids = births.arena.take<RigidId>(plan.parts.size());
    size_t count = 0;
    for (uint32_t p = 0; p < plan.parts.size(); ++p)
        if (count < ids.size() && plan.child[p].exists()) ids[count++] = plan.child[p];
    births.rigid.name_siblings(ids.first(count));
}

// New pieces start in touch with each other, and with what struck them. What a cut or a tear parts has no motion of its
// own that would take it out of its sibling: unmet, the upper half of a vase fell 30 cm into the lower one and stayed
// there. Such pieces meet at once; their overlap is pushed out without adding velocity.
void part_siblings(Births& births, const Break& plan, const Moment& moment, std::span<const Bounds> bounds) {
    const bool has_own_motion = plan.task.exists() ? !is_cut_task(births.blows, plan.task) : plan.waited > 0;
    if (!has_own_motion) return;
    const auto count = static_cast<uint32_t>(plan.parts.size());
    const Cracks cracks(plan.touches, moment.pose, births.arena);
    for (uint32_t p = 0; p < count; ++p)
        for (uint32_t q = p + 1; q < count; ++q)
            if (plan.child[p].exists() && plan.child[q].exists() && bounds[p].is_near(bounds[q]))
                births.rigid.part_siblings(plan.child[p], plan.child[q], cracks.between(p, q));
}

void part_strikers(Births& births, Row<Tasks> task, const Break& plan, bool is_late) {
    BodyRows& state = births.state;
    const auto count = static_cast<uint32_t>(plan.parts.size());
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t p = 0; p < count; ++p) {
        if (!plan.child[p].exists()) continue;
        for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c) {
            const Row<Bodies> striker = state.task_contacts.striker[c];
            if (!striker.exists()) continue;
            if (p == plan.largest && !is_late) births.rigid.skip_contacts(plan.body, striker);
            if (static_cast<BodyKind>(state.bodies.kind[striker]) == BodyKind::Dynamic)
                births.rigid.ignore_pair(plan.child[p], striker, kStrikerSeconds);
        }
    }
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
PartMotion limited_motion(Births& births, const Break& plan, uint32_t p, const Moment& moment, Leaving& leaving) {
    PartMotion part = plan.motions[p];
    if (p != plan.largest) {
        const bool was_clamped = part.is_speed_clamped || part.is_spin_clamped;
        const Row<Structures> shell = births.state.bodies.structure[plan.child[p]];
        leaving.cut += limit_flight(leaving.limit, births.state.structures.centre[shell], part);
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

// One piece's row, rigid body and event. The body frame and the pose stay the parent's.
void make_birth(Births& births, const Break& plan, uint32_t p, const Moment& moment, Bounds& bounds, Leaving& leaving) {
    BodyRows& state = births.state;
    Bodies& bodies = state.bodies;
    const Row<Bodies> body = plan.body, child = plan.child[p];
    Motion motion = world_motion(moment, limited_motion(births, plan, p, moment, leaving));
    // A blow without measure may leave pieces faster than the rigid world takes.
    const bool is_too_fast = shorten(motion.velocity, kFastest),
               spins_too_fast = shorten(motion.angular_velocity, kFastest);
    births.counts.clamped += is_too_fast || spins_too_fast;
    const bool was_static = static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Static;
    const bool is_static = plan.motions[p].is_static;
    const bool is_rest = p == plan.largest;
    place_body(births, child, moment, motion, is_static, is_rest && plan.keeps_mesh);
    if (is_rest && plan.keeps_hulls) {
        pack_renewed_hulls(ShellView(state, bodies.structure[body]));
        // What it was drawn as holds its hulls.
        const auto& drawn = bodies.drawn_box[body];
        bounds.low = {drawn[0], drawn[1], drawn[2]}, bounds.high = {drawn[3], drawn[4], drawn[5]};
        if (was_static == is_static && change_rest(births, body)) {
            if (!was_static) births.rigid.set_motion(body, motion);
            return;
        }
    } else {
        pack_hulls(ShellView(state, bodies.structure[child]));
        bounds = {};
    }
    const auto pieces = convex_pieces(state, bodies.structure[child], births.arena, body);
    if (!is_rest || !plan.keeps_hulls)
        for (const ConvexPiece& piece : pieces)
            for (const Vec3 point : piece.points) bounds.add(point);
    if (is_rest && was_static == is_static) {
        // Hulls of a copy's cells that did not change are those of the body, by the same names.
        const bool has_cells = state.structures.shape_points[bodies.structure[body]] == 0;
        const bool is_of_copy = !plan.keeps_hulls && !plan.is_torn && plan.had_cells && has_cells &&
                                births.models.keeps_cell_names(state, body);
        if (!is_of_copy || !change_rest(births, body))
            births.rigid.set_shape(body, bodies.mass[body], bodies.centre[body], bodies.inertia[body], pieces);
        if (!was_static) births.rigid.set_motion(body, motion);
        return;
    }
    if (is_rest) births.rigid.remove(body);
    RigidDescription description = describe_rigid(state.bodies, state.structures, child, pieces);
    description.parent = body;
    births.rigid.add(child, description);
    if (is_rest) return;
    set_born(state.fragment_ages, child, births.step.frame + 1);
    births.born.push({body_id(bodies, child), body_id(bodies, body), bodies.user_data[body],
                      to_world(moment.pose, bodies.centre[child].to_float()), motion, bodies.mass[child],
                      state.structures.generation[bodies.structure[child]]});
}

// Children first: their hulls are found among the body's, which change last.
void make_births_of(Births& births, const Break& plan, const Moment& moment) {
    BodyRows& state = births.state;
    const auto count = static_cast<uint32_t>(plan.parts.size());
    for (uint32_t i = 1; i < count; ++i) {
        const uint32_t p = plan.order[i];
        if (!plan.is_crumb[p]) continue;
        plan.debris[p] = make_debris(births, plan, p, moment);
    }
    plan.child[plan.largest] = plan.body;
    const auto bounds = births.arena.take<Bounds>(count);
    Leaving leaving;
    if (plan.task.exists()) leaving.limit = flight_limit(state, births.blows, plan.task);
    for (uint32_t i = 1; i <= count; ++i) {
        const uint32_t p = plan.order[i % count];
        if (plan.child[p].exists()) make_birth(births, plan, p, moment, bounds[p], leaving);
    }
    name_siblings(births, plan);
    part_siblings(births, plan, moment, bounds);
}

}  // namespace

void make_break(Births& births, const Break& plan) {
    SoftRows& state = births.state;
    if (plan.is_torn) births.models.give_torn(state, {plan.body, plan.order, plan.parts, plan.child});
    if (!plan.task.exists()) {
        const double allowed = rigid_energy(state.bodies, plan.body) + plan.waited;
        make_births_of(births, plan, {pose_of(state.bodies, plan.body), {}, {}, {}, false});
        if (plan.is_torn) return births.models.keep_torn(state, births.rigid, plan.body);
        const double goes_on_waiting = waiting_energy(state, plan.body);
        if (plan.waited > 0) limit_energy(births, plan, allowed - goes_on_waiting);
        return;
    }
    for (const Handoff& handoff : plan.handoff) {
        births.counts.clamped += handoff.report.speed_clamps + handoff.report.spin_clamps;
        births.counts.crushing_energy += handoff.report.energy_crushed;
    }
    const Moment moment = moment_of(state, plan.task, plan.motions);
    // Late, the rigid solver has passed the blow's impulse, and what it took by it comes back; an explosion's energy
    // comes from outside.
    const bool comes_from_outside = has_explosion(births.blows, plan.task);
    const double before = rigid_energy(state.bodies, plan.body);
    const double allowed = moment.is_late ? before + owed_to_late(state, plan.task)
                                          : strike_back(births, plan.task, moment.pose, plan.motions, plan.largest);
    make_births_of(births, plan, moment);
    if (moment.is_late || !comes_from_outside) limit_energy(births, plan, allowed);
    if (!moment.is_late && !comes_from_outside) share_with_strikers(births, plan, allowed);
    double energy = pieces_energy(state.bodies, births.debris, plan);
    if (plan.is_refused)
        energy += comes_from_outside ? waiting_energy(state, plan.body)
                                     : limit_waiting(state, plan.body, std::max(0.0, allowed - energy));
    if (moment.is_late || comes_from_outside)
        births.counts.work_from_outside += std::max(0.0, energy - (moment.is_late ? before : allowed));
    part_strikers(births, plan.task, plan, moment.is_late);
}

}  // namespace cullet
