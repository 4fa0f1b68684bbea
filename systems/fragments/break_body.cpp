#include "systems/fragments/break_body.hpp"

#include <algorithm>

#include "systems/damage/thresholds.hpp"
#include "systems/fragments/body_rows.hpp"
#include "systems/fragments/group_fragments.hpp"
#include "systems/fragments/make_piece.hpp"
#include "systems/fragments/rigid_handoff.hpp"
#include "systems/fragments/rigid_shape.hpp"
#include "systems/rigid/body_id.hpp"

namespace cullet {
namespace {

// Siblings that start in touch, and a striker beside the shards it made, are not tested against each other for so long.
constexpr float kSiblingSeconds = 0.25f, kStrikerSeconds = 0.1f;
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

Moment moment_of(const State& state, Row<Tasks> task, std::span<const PartMotion> motions) {
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

// A piece that found no room stays part of another and moves with it.
void join_motions(PartMotion& motion, PartMotion& joined) {
    const double mass = motion.mass + joined.mass;
    if (mass > 0) motion.centre = (1 / mass) * (motion.mass * motion.centre + joined.mass * joined.centre);
    motion.mass = mass;
    motion.momentum += joined.momentum;
    motion.is_static = motion.is_static || joined.is_static;
    if (motion.is_static) motion.momentum = {};
    motion.velocity = (1.0 / motion.mass) * motion.momentum;
    if (motion.is_static) motion.spin = {};
    joined = {};
}

// Crumbs that the world still has room for.
uint32_t free_debris(const Debris& debris) {
    uint32_t used = 0;
    for (uint32_t d = 0; d < debris.size(); ++d) used += debris.is_used[d];
    return debris.limit() - used;
}

void make_debris(Births& births, ShellView shell, const FragmentPart& part, const Motion& motion, const Moment& moment,
                 Row<Bodies> parent, Vec3d centre) {
    State& state = births.state;
    Debris& debris = state.debris;
    uint32_t row = 0;
    while (row < debris.size() && debris.is_used[row]) ++row;
    if (row == debris.size() && debris.append(1) == kNone) return;  // free_debris counted: there is room
    double volume = 0;
    for (uint32_t e = part.first_element; e != kNone; e = state.elements.next[shell.element(e)])
        volume += state.elements.volume[shell.element(e)];
    const Vec3 place = to_world(moment.pose, centre.to_float());
    debris.is_used[row] = 1;
    debris.is_resting[row] = 0;
    debris.position.set(row, place);
    debris.velocity.set(row, motion.velocity);
    debris.mass[row] = part.mass;
    // Radius of the ball of the same volume; the cube root by Newton from above.
    double r = 1;
    for (int i = 0; i < 60; ++i) r = (2 * r + 0.2387 * volume / (r * r)) / 3;
    debris.radius[row] = static_cast<float>(r);
    debris.floor[row] = births.rigid.height_below(place, -1e6f) + debris.radius[row];
    debris.colour[row] = state.bodies.colour[parent];
    births.debris_events.push(
        {body_id(state.bodies, parent), state.bodies.user_data[parent], place, motion.velocity, part.mass});
}

// Rows, shell and drawn mesh of a new body, or a row that does not exist and the name of the limit.
Row<Bodies> reserve_body(State& state, Row<Bodies> parent, Row<Shells> broken, const FragmentPart& part,
                         const char** full) {
    const Row<Bodies> body = take_body(state);
    if (!body.exists()) {
        *full = "limits.bodies";
        return {};
    }
    state.bodies.shell[body] =
        make_piece(state, broken, part, static_cast<uint8_t>(state.shells.generation[broken] + 1), full);
    if (state.bodies.shell[body].exists() && take_view(state, body)) {
        Bodies& b = state.bodies;
        b.model[body] = b.model[parent];
        b.parent[body] = parent;
        for (auto* column : {&b.friction, &b.restitution, &b.strength_scale}) (*column)[body] = (*column)[parent];
        b.layer[body] = b.layer[parent];
        b.mask[body] = b.mask[parent];
        b.user_data[body] = b.user_data[parent];
        b.is_breakable[body] = b.is_breakable[parent];
        return body;
    }
    if (state.bodies.shell[body].exists()) *full = "limits.view_vertices";
    free_body(state, body);
    return {};
}

void place_body(Births& births, Row<Bodies> body, const Moment& moment, const Motion& motion, bool is_static) {
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
    bodies.velocity.set(body, is_static ? Vec3{} : motion.velocity);
    bodies.spin.set(body, is_static ? Vec3{} : motion.angular_velocity);
    bodies.retry_frame[body] = births.step.frame + retry_frames(births.step.dt);
    bodies.is_asleep[body] = 0;
    take_mass_properties(births.state, body);
    births.changed.push({body});
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

Vec3d blow_of(const TaskContacts& contacts, uint32_t c) {
    return contacts.impulse[c] * Vec3d(contacts.normal[c]);
}

void push(Births& births, Row<Bodies> striker, Vec3 impulse, Vec3 place) {
    Bodies& bodies = births.state.bodies;
    const Pose pose = pose_of(bodies, striker);
    const Vec3 arm = place - to_world(pose, bodies.centre[striker].to_float());
    const Vec3d turn(rotate(conjugate(pose.orientation), cross(arm, impulse)));
    bodies.velocity.set(striker, bodies.velocity[striker] + static_cast<float>(1.0 / bodies.mass[striker]) * impulse);
    bodies.spin.set(
        striker, bodies.spin[striker] + rotate(pose.orientation, (inverse(bodies.inertia[striker]) * turn).to_float()));
    births.rigid.set_motion(striker, {bodies.velocity[striker], bodies.spin[striker]});
}

// The striker is being worked off against `body` too: should it break as well, it has its share already.
void mark_answered(State& state, Row<Bodies> striker, Row<Bodies> body) {
    const uint32_t t = state.bodies.task[striker];
    if (t == kNone) return;
    const uint32_t first = state.tasks.first_contact[t];
    for (uint32_t c = first; c < first + state.tasks.contact_count[t]; ++c)
        if (state.task_contacts.striker[c] == body) state.task_contacts.is_answered[c] = 1;
}

// Strikers and supports get what the pieces took, so that momentum is kept (6.6, and the impulse ahead of the solve).
// Where the striker has broken first and passed its own impulse, the difference of the two goes to `largest`. What the
// pins took during the run is what is missing from the pieces: hidden steps keep momentum to rounding. What rounding
// took (some 1e-5 of it in 2,000 steps of floats)
// goes to `largest` too.
void strike_back(Births& births, Row<Tasks> task, const Moment& moment, std::span<PartMotion> motions,
                 uint32_t largest) {
    State& state = births.state;
    const Row<Bodies> body = state.tasks.body[task];
    const TaskContacts& contacts = state.task_contacts;
    Vec3d to_static, came_in, answered, moving;
    bool is_pinned = false;
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c) {
        const Row<Bodies> striker = contacts.striker[c];
        if (contacts.is_answered[c]) {
            answered += blow_of(contacts, c);
            continue;
        }
        came_in += blow_of(contacts, c);
        const bool yields = striker.exists() && contacts.striker_inverse_mass[c] > 0 &&
                            static_cast<BodyKind>(state.bodies.kind[striker]) == BodyKind::Dynamic;
        if (!yields) {
            to_static += -1.0 * blow_of(contacts, c);
            continue;
        }
        push(births, striker, rotate(moment.pose.orientation, (-1.0 * blow_of(contacts, c)).to_float()),
             to_world(moment.pose, contacts.point[c]));
        mark_answered(state, striker, body);
    }
    for (const PartMotion& m : motions) {
        is_pinned = is_pinned || m.is_static;
        if (!m.is_static) moving += m.momentum;
    }
    PartMotion& heir = motions[largest];
    if (is_pinned) {
        to_static += came_in + answered - moving;
        (heir.is_static ? to_static : heir.momentum) += -1.0 * answered;
    } else {
        const Vec3d start = state.bodies.mass[body] * Vec3d(state.tasks.start_velocity[task]);
        const Vec3d rounding = start + came_in + answered - moving;
        const double scale = std::max(length(start), length(came_in + answered));
        births.counts.worst_rounding =
            std::max(births.counts.worst_rounding, scale > 0 ? length(rounding) / scale : 0.0);
        heir.momentum += rounding - answered;
    }
    heir.velocity = (1 / heir.mass) * heir.momentum;
    const Vec3d booked(rotate(moment.pose.orientation, to_static.to_float()));
    for (int k = 0; k < 3; ++k) births.counts.impulse_to_static[k] += booked[k];
}

// The body's shell becomes `shell` when its drawn mesh finds room, else nothing changes.
bool change_shell(State& state, Row<Bodies> body, Row<Shells> shell) {
    const Row<Shells> before = state.bodies.shell[body];
    state.bodies.shell[body] = shell;
    if (!take_view(state, body)) {
        state.bodies.shell[body] = before;
        release_shell(state, shell);
        return false;
    }
    release_shell(state, before);
    return true;
}

// One break while it is planned.
struct Plan {
    State& state;
    Row<Bodies> body;
    Row<Shells> broken;
    std::span<FragmentPart> parts;
    std::span<PartMotion> motions;
    std::span<uint32_t> order;     // parts, heaviest first
    std::span<Row<Bodies>> child;  // new bodies
    std::span<uint8_t> is_crumb;
    uint32_t largest = 0;

    void stay(Births& births, uint32_t part, const char* setting) {
        births.refused.push({body_id(state.bodies, body), setting});
        join_parts(ShellView(state, broken), parts, part, largest);
        join_motions(motions[largest], motions[part]);
    }
};

// Which pieces are crumbs, bodies, or stay; heaviest first, ties by number.
void plan_births(Births& births, Plan& plan) {
    State& state = births.state;
    const auto count = static_cast<uint32_t>(plan.parts.size());
    for (uint32_t i = 0; i < count; ++i) plan.order[i] = i;
    std::sort(plan.order.begin(), plan.order.end(), [&](uint32_t a, uint32_t b) {
        return plan.parts[a].mass != plan.parts[b].mass ? plan.parts[a].mass > plan.parts[b].mass : a < b;
    });
    plan.largest = plan.order[0];
    const double least_mass = births.settings.debris_share * state.shells.intact_mass[plan.broken];
    uint32_t crumbs_left = free_debris(state.debris);
    for (uint32_t p = 0; p < count; ++p) {
        plan.child[p] = {};
        plan.is_crumb[p] = 0;
    }
    for (uint32_t i = 1; i < count; ++i) {
        const uint32_t p = plan.order[i];
        const FragmentPart& part = plan.parts[p];
        const char* full = nullptr;
        if (!part.has_pins && (part.mass < least_mass || part.element_count < births.settings.debris_elements)) {
            if (crumbs_left > 0) {
                --crumbs_left;
                plan.is_crumb[p] = 1;
            } else {
                plan.stay(births, p, "limits.debris");
            }
            continue;
        }
        plan.child[p] = reserve_body(state, plan.body, plan.broken, part, &full);
        if (!plan.child[p].exists()) plan.stay(births, p, full);
    }
}

// The body's own new shell. Where it finds no room the lightest piece gives its rows back and stays. False when even
// then there is none: nothing has changed.
bool reserve_rest(Births& births, Plan& plan) {
    State& state = births.state;
    const auto generation = static_cast<uint8_t>(state.shells.generation[plan.broken] + 1);
    auto lightest = static_cast<uint32_t>(plan.order.size());
    for (;;) {
        const char* full = nullptr;
        const Row<Shells> rest = make_piece(state, plan.broken, plan.parts[plan.largest], generation, &full);
        if (rest.exists() && change_shell(state, plan.body, rest)) return true;
        if (rest.exists()) full = "limits.view_vertices";
        do {
            if (--lightest == 0) {
                births.refused.push({body_id(state.bodies, plan.body), full});
                return false;
            }
        } while (!plan.child[plan.order[lightest]].exists());
        const uint32_t p = plan.order[lightest];
        free_body(state, plan.child[p]);
        plan.child[p] = {};
        plan.stay(births, p, full);
    }
}

// New pieces start in touch with each other and with what struck them.
void part_neighbours(Births& births, Row<Tasks> task, const Plan& plan, std::span<const Bounds> bounds, bool is_late) {
    State& state = births.state;
    const auto count = static_cast<uint32_t>(plan.parts.size());
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t p = 0; p < count; ++p) {
        if (!plan.child[p].exists()) continue;
        for (uint32_t q = p + 1; q < count; ++q)
            if (plan.child[q].exists() && bounds[p].is_near(bounds[q]))
                births.rigid.ignore_pair(plan.child[p], plan.child[q], kSiblingSeconds, true);
        for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c) {
            const Row<Bodies> striker = state.task_contacts.striker[c];
            if (!striker.exists()) continue;
            if (p == plan.largest && !is_late) births.rigid.skip_contacts(plan.body, striker);
            if (static_cast<BodyKind>(state.bodies.kind[striker]) == BodyKind::Dynamic)
                births.rigid.ignore_pair(plan.child[p], striker, kStrikerSeconds, false);
        }
    }
}

// One piece's row, rigid body and event. The body frame and the pose stay the parent's.
void make_birth(Births& births, const Plan& plan, uint32_t p, const Moment& moment, Bounds& bounds) {
    State& state = births.state;
    Bodies& bodies = state.bodies;
    const Row<Bodies> body = plan.body, child = plan.child[p];
    const Motion motion = world_motion(moment, plan.motions[p]);
    const bool was_static = static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Static;
    const bool is_static = plan.motions[p].is_static;
    place_body(births, child, moment, motion, is_static);
    const auto pieces = convex_pieces(state, bodies.shell[child], births.arena);
    bounds = {};
    for (const ConvexPiece& piece : pieces)
        for (const Vec3 point : piece.points) bounds.add(point);
    if (p == plan.largest && was_static == is_static) {
        births.rigid.set_shape(body, bodies.mass[body], bodies.centre[body], bodies.inertia[body], pieces);
        if (!was_static) births.rigid.set_motion(body, motion);
        return;
    }
    if (p == plan.largest) births.rigid.remove(body);
    births.rigid.add(child, describe_rigid(state, child, pieces));
    if (p == plan.largest) return;
    bodies.born_frame[child] = births.step.frame;
    births.born.push({body_id(bodies, child), body_id(bodies, body), bodies.user_data[body],
                      to_world(moment.pose, bodies.centre[child].to_float()), motion, bodies.mass[child],
                      state.shells.generation[bodies.shell[child]]});
}

}  // namespace

void break_body(Births& births, Row<Tasks> task) {
    State& state = births.state;
    const Row<Bodies> body = state.tasks.body[task];
    const Row<Shells> broken = state.tasks.shell[task];
    const ShellView shell(state, broken);
    const uint32_t count = state.tasks.part_count[task];
    Arena& arena = births.arena;
    Plan plan{state,
              body,
              broken,
              std::span(state.fragments.part.data() + size_t{task} * kMostParts, count),
              arena.take<PartMotion>(count),
              arena.take<uint32_t>(count),
              arena.take<Row<Bodies>>(count),
              arena.take<uint8_t>(count)};
    const HandoffReport report =
        rigid_handoff(shell,
                      {Vec3d(state.tasks.start_velocity[task]), Vec3d(state.tasks.start_spin[task]),
                       state.shells.centre[broken], state.tasks.approach_speed[task]},
                      plan.parts, plan.motions);
    plan_births(births, plan);
    if (!reserve_rest(births, plan)) return;
    bool is_broken = false;
    for (uint32_t p = 0; p < count; ++p) is_broken = is_broken || plan.child[p].exists() || plan.is_crumb[p];
    if (!is_broken) {  // all pieces stay: what frees no piece changes no velocity
        births.changed.push({body});
        return;
    }
    births.counts.clamped += report.speed_clamps + report.spin_clamps;
    const Moment moment = moment_of(state, task, plan.motions);
    if (!moment.is_late) strike_back(births, task, moment, plan.motions, plan.largest);
    for (uint32_t i = 1; i < count; ++i) {
        const uint32_t p = plan.order[i];
        if (!plan.is_crumb[p]) continue;
        make_debris(births, shell, plan.parts[p], world_motion(moment, plan.motions[p]), moment, body,
                    plan.motions[p].centre);
    }
    plan.child[plan.largest] = body;
    const auto bounds = arena.take<Bounds>(count);
    for (uint32_t i = 0; i < count; ++i)
        if (plan.child[plan.order[i]].exists()) make_birth(births, plan, plan.order[i], moment, bounds[plan.order[i]]);
    part_neighbours(births, task, plan, bounds, moment.is_late);
}

void keep_cracks(Births& births, Row<Tasks> task) {
    State& state = births.state;
    const Row<Bodies> body = state.tasks.body[task];
    const Row<Shells> broken = state.tasks.shell[task];
    const FragmentPart& whole = state.fragments.part[size_t{task} * kMostParts];
    const char* full = nullptr;
    const Row<Shells> kept = make_piece(state, broken, whole, state.shells.generation[broken], &full);
    const bool is_kept = kept.exists() && change_shell(state, body, kept);
    if (is_kept)
        births.changed.push({body});
    else
        births.refused.push({body_id(state.bodies, body), kept.exists() ? "limits.view_vertices" : full});
}

}  // namespace cullet
