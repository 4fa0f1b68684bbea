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

// The body's motion now, and at the touch in its own axes. Equal while it was held; a late result is added to what the
// rigid world has done since.
struct Moment {
    Pose pose;
    Vec3 centre;          // body frame
    Vec3 velocity, spin;  // world, now
    Vec3d start_velocity, start_spin;
    bool is_late;
};

Motion world_motion(const Moment& m, const PartMotion& part) {
    if (!m.is_late)
        return {rotate(m.pose.orientation, part.velocity.to_float()), rotate(m.pose.orientation, part.spin.to_float())};
    const Vec3d arm = part.centre - Vec3d(m.centre);
    const Vec3d gained = part.velocity - (m.start_velocity + cross(m.start_spin, arm));
    const Vec3d turned = part.spin - m.start_spin;
    const Vec3 arm_now = rotate(m.pose.orientation, arm.to_float());
    return {m.velocity + cross(m.spin, arm_now) + rotate(m.pose.orientation, gained.to_float()),
            m.spin + rotate(m.pose.orientation, turned.to_float())};
}

// A piece that found no room stays part of another and moves with it.
void join_motions(PartMotion& motion, const PartMotion& joined) {
    motion.mass += joined.mass;
    motion.momentum += joined.momentum;
    motion.is_static = motion.is_static || joined.is_static;
    motion.velocity = motion.is_static ? Vec3d{} : (1.0 / motion.mass) * motion.momentum;
}

void make_debris(Births& births, ShellView shell, const FragmentPart& part, const Motion& motion, const Moment& moment,
                 Row<Bodies> parent, Vec3d centre) {
    State& state = births.state;
    Debris& debris = state.debris;
    uint32_t row = 0;
    while (row < debris.size() && debris.is_used[row]) ++row;
    if (row == debris.size() && debris.append(1) == kNone) {
        births.refused.push({body_id(state.bodies, parent), "limits.debris"});
        row = 0;  // the oldest place is taken over, with its mass, so that none is lost
    }
    const double kept = debris.is_used[row] ? debris.mass[row] : 0.0;
    double volume = 0;
    for (uint32_t e = part.first_element; e != kNone; e = state.elements.next[shell.element(e)])
        volume += state.elements.volume[shell.element(e)];
    const Vec3 place = to_world(moment.pose, centre.to_float());
    debris.is_used[row] = 1;
    debris.is_resting[row] = 0;
    debris.position.set(row, place);
    debris.velocity.set(row, motion.velocity);
    debris.mass[row] = part.mass + kept;
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
    bodies.kind[body] = static_cast<uint8_t>(is_static ? BodyKind::Static : BodyKind::Dynamic);
    bodies.has_pins[body] = is_static;
    bodies.position.set(body, moment.pose.position);
    bodies.orientation[body] = moment.pose.orientation;
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

Vec3 centre_of(const Bodies& bodies, Row<Bodies> b) {
    return to_world(pose_of(bodies, b), bodies.centre[b].to_float());
}

void push_body(Births& births, Row<Bodies> b, Vec3 impulse, Vec3 turn) {
    Bodies& bodies = births.state.bodies;
    const Quat q = bodies.orientation[b];
    const Vec3d local(rotate(conjugate(q), turn));
    bodies.velocity.set(b, bodies.velocity[b] + static_cast<float>(1.0 / bodies.mass[b]) * impulse);
    bodies.spin.set(b, bodies.spin[b] + rotate(q, (inverse(bodies.inertia[b]) * local).to_float()));
    births.rigid.set_motion(b, {bodies.velocity[b], bodies.spin[b]});
}

bool is_dynamic(const Bodies& bodies, Row<Bodies> b) {
    return b.exists() && static_cast<BodyKind>(bodies.kind[b]) == BodyKind::Dynamic;
}

// The open task of `striker` in which `body` is the striker: both may break, each against the other.
Row<Tasks> mutual_task(const State& state, Row<Bodies> striker, Row<Bodies> body) {
    const uint32_t t = state.bodies.task[striker];
    if (t == kNone || state.tasks.is_late[t]) return {};
    const uint32_t first = state.tasks.first_contact[t];
    for (uint32_t c = first; c < first + state.tasks.contact_count[t]; ++c)
        if (state.task_contacts.striker[c] == body) return Row<Tasks>(t);
    return {};
}

void book_static(DamageCounts& counts, Vec3 impulse) {
    counts.impulse_to_static[0] += impulse.x;
    counts.impulse_to_static[1] += impulse.y;
    counts.impulse_to_static[2] += impulse.z;
}

// What strikers and supports received, so that momentum is kept (6.6). A striker whose own task is still open against
// this body is owed the impulse: its own run will say what passed the other way, and only the difference of the two
// counts.
void strike_back(Births& births, Row<Tasks> task, const Moment& moment, const HandoffReport& report) {
    State& state = births.state;
    const Bodies& bodies = state.bodies;
    book_static(births.counts, rotate(moment.pose.orientation, report.support_momentum.to_float()));
    const TaskContacts& contacts = state.task_contacts;
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c) {
        const Row<Bodies> striker = contacts.striker[c];
        const Vec3 impulse =
            static_cast<float>(-contacts.impulse[c]) * rotate(moment.pose.orientation, contacts.normal[c]);
        if (!is_dynamic(bodies, striker) || contacts.striker_inverse_mass[c] == 0) {
            book_static(births.counts, impulse);
            continue;
        }
        const Vec3 turn = cross(to_world(moment.pose, contacts.point[c]) - centre_of(bodies, striker), impulse);
        const Row<Tasks> mutual = mutual_task(state, striker, state.tasks.body[task]);
        if (mutual.exists()) {
            state.tasks.owed_impulse.set(mutual, state.tasks.owed_impulse[mutual] + impulse);
            state.tasks.owed_turn.set(mutual, state.tasks.owed_turn[mutual] + turn);
        } else {
            push_body(births, striker, impulse, turn);
        }
    }
}

// Both broke: what this body was owed goes to the heavier one's largest piece, together with what strike_back gave the
// other.
void settle_debt(Births& births, Row<Tasks> task, const Moment& moment, const FragmentPart& largest,
                 PartMotion& motion) {
    State& state = births.state;
    const Vec3 owed = state.tasks.owed_impulse[task];
    if (dot(owed, owed) == 0) return;
    Row<Bodies> other;
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t c = first; c < first + state.tasks.contact_count[task]; ++c)
        if (is_dynamic(state.bodies, state.task_contacts.striker[c])) other = state.task_contacts.striker[c];
    if (other.exists() && state.bodies.mass[other] > largest.mass) {
        push_body(births, other, owed, {});
        return;
    }
    motion.momentum += Vec3d(rotate(conjugate(moment.pose.orientation), owed));
    motion.velocity = motion.is_static ? Vec3d{} : (1.0 / motion.mass) * motion.momentum;
}

}  // namespace

void break_body(Births& births, Row<Tasks> task) {
    State& state = births.state;
    Bodies& bodies = state.bodies;
    const Row<Bodies> body = state.tasks.body[task];
    const Row<Shells> broken = state.tasks.shell[task];
    const ShellView shell(state, broken);
    const uint32_t count = state.tasks.part_count[task];
    const std::span<FragmentPart> parts(state.fragments.part.data() + size_t{task} * kMostParts, count);
    const auto motions = births.arena.take<PartMotion>(count);
    const auto order = births.arena.take<uint32_t>(count);
    const auto child = births.arena.take<Row<Bodies>>(count);

    Moment moment{pose_of(bodies, body),
                  bodies.centre[body].to_float(),
                  bodies.velocity[body],
                  bodies.spin[body],
                  Vec3d(state.tasks.start_velocity[task]),
                  Vec3d(state.tasks.start_spin[task]),
                  state.tasks.is_late[task] != 0};
    const HandoffReport report = rigid_handoff(
        shell, {moment.start_velocity, moment.start_spin, bodies.centre[body], state.tasks.approach_speed[task]}, parts,
        motions);
    births.counts.clamped += report.speed_clamps + report.spin_clamps;
    if (!moment.is_late) strike_back(births, task, moment, report);

    settle_debt(births, task, moment, parts[report.largest], motions[report.largest]);

    // Plan: heaviest first, ties by number. The largest stays; crumbs become debris; the rest ask for rows.
    for (uint32_t i = 0; i < count; ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return parts[a].mass != parts[b].mass ? parts[a].mass > parts[b].mass : a < b;
    });
    const uint32_t largest = order[0];
    const double least_mass = births.settings.debris_share * state.shells.intact_mass[broken];
    for (uint32_t i = 1; i < count; ++i) {
        const uint32_t p = order[i];
        child[p] = {};
        const bool is_crumb = !parts[p].has_pins &&
                              (parts[p].mass < least_mass || parts[p].element_count < births.settings.debris_elements);
        if (is_crumb) {
            make_debris(births, shell, parts[p], world_motion(moment, motions[p]), moment, body, motions[p].centre);
            continue;
        }
        const char* full = nullptr;
        child[p] = reserve_body(state, body, broken, parts[p], &full);
        if (child[p].exists()) continue;
        births.refused.push({body_id(bodies, body), full});
        join_parts(shell, parts, p, largest);
        join_motions(motions[largest], motions[p]);
    }
    child[largest] = body;
    const char* full = nullptr;
    const Row<Shells> rest =
        make_piece(state, broken, parts[largest], static_cast<uint8_t>(state.shells.generation[broken] + 1), &full);
    if (!rest.exists()) births.refused.push({body_id(bodies, body), full});

    // Make: rows, rigid bodies, events, heaviest first.
    const auto bounds = births.arena.take<Bounds>(count);
    const bool was_static = static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Static;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t p = order[i];
        if (!child[p].exists()) continue;
        const Motion motion = world_motion(moment, motions[p]);
        if (p == largest && rest.exists()) {
            release_shell(state, bodies.shell[body]);
            bodies.shell[body] = rest;
            if (!take_view(state, body)) births.refused.push({body_id(bodies, body), "limits.view_vertices"});
        }
        place_body(births, child[p], moment, motion, parts[p].has_pins);
        const auto pieces = convex_pieces(state, bodies.shell[child[p]], births.arena);
        bounds[p] = {};
        for (const ConvexPiece& piece : pieces)
            for (const Vec3 point : piece.points) bounds[p].add(point);
        if (p == largest && was_static == parts[p].has_pins) {
            births.rigid.set_shape(body, bodies.mass[body], bodies.centre[body], bodies.inertia[body], pieces);
            if (!was_static) births.rigid.set_motion(body, motion);
        } else {
            if (p == largest) births.rigid.remove(body);
            births.rigid.add(child[p], describe_rigid(state, child[p], pieces));
        }
        if (p != largest) {
            bodies.born_frame[child[p]] = births.step.frame;
            births.born.push({body_id(bodies, child[p]), body_id(bodies, body), bodies.user_data[body],
                              to_world(moment.pose, bodies.centre[child[p]].to_float()), motion, bodies.mass[child[p]],
                              state.shells.generation[bodies.shell[child[p]]]});
        }
    }
    // New pieces start in touch with each other and with what struck them.
    for (uint32_t p = 0; p < count; ++p) {
        if (!child[p].exists()) continue;
        for (uint32_t q = p + 1; q < count; ++q)
            if (child[q].exists() && bounds[p].is_near(bounds[q]))
                births.rigid.ignore_pair(child[p], child[q], kSiblingSeconds, true);
        for (uint32_t c = state.tasks.first_contact[task];
             c < state.tasks.first_contact[task] + state.tasks.contact_count[task]; ++c) {
            const Row<Bodies> striker = state.task_contacts.striker[c];
            if (!striker.exists()) continue;
            if (p == largest && !moment.is_late) births.rigid.skip_contacts(body, striker);
            if (static_cast<BodyKind>(bodies.kind[striker]) == BodyKind::Dynamic)
                births.rigid.ignore_pair(child[p], striker, kStrikerSeconds, false);
        }
    }
}

void pay_debt(Births& births, Row<Tasks> task) {
    const Vec3 owed = births.state.tasks.owed_impulse[task];
    if (dot(owed, owed) > 0 && is_dynamic(births.state.bodies, births.state.tasks.body[task]))
        push_body(births, births.state.tasks.body[task], owed, births.state.tasks.owed_turn[task]);
}

void keep_cracks(Births& births, Row<Tasks> task) {
    State& state = births.state;
    const Row<Bodies> body = state.tasks.body[task];
    const Row<Shells> broken = state.tasks.shell[task];
    const FragmentPart& whole = state.fragments.part[size_t{task} * kMostParts];
    const char* full = nullptr;
    const Row<Shells> kept = make_piece(state, broken, whole, state.shells.generation[broken], &full);
    if (!kept.exists()) {
        births.refused.push({body_id(state.bodies, body), full});
        return;
    }
    release_shell(state, state.bodies.shell[body]);
    state.bodies.shell[body] = kept;
    if (take_view(state, body)) births.changed.push({body});
}

}  // namespace cullet
