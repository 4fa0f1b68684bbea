#include "systems/fragments/break_body.hpp"

#include <algorithm>

#include "systems/damage/thresholds.hpp"
#include "systems/fragments/body_rows.hpp"
#include "systems/fragments/cell_hulls.hpp"
#include "systems/fragments/group_fragments.hpp"
#include "systems/fragments/make_piece.hpp"
#include "systems/fragments/mass_properties.hpp"
#include "systems/fragments/rest_of_body.hpp"
#include "systems/fragments/rigid_handoff.hpp"
#include "systems/fragments/rigid_shape.hpp"
#include "systems/fragments/strike_back.hpp"
#include "systems/rigid/body_id.hpp"

namespace cullet {
namespace {

// Siblings that start in touch, and a striker beside the shards it made, are not tested against each other for so long.
constexpr float kSiblingSeconds = 0.25f, kStrikerSeconds = 0.1f;
// Of Bodies.is_owed_births. The second: its drawn mesh found no room either and is that of before the hit.
constexpr uint8_t kOwedBirths = 1, kOwedDrawing = 2;
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
    const Row<Shells> before = state.bodies.shell[parent];
    const Row<Bodies> body = take_body(state);
    if (!body.exists()) {
        *full = "limits.bodies";
        return {};
    }
    state.bodies.shell[body] =
        make_piece(state, broken, part, static_cast<uint8_t>(state.shells.generation[broken] + 1), full, before);
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

// One break while it is planned. `broken` may be the body's own shell, or a task's that has the same cells.
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
    Range points = {};        // for the hulls of what is left
    bool is_refused = false;  // some part stays for want of room

    bool leaves(uint32_t part) const { return child[part].exists() || is_crumb[part]; }
    bool is_broken() const {
        for (uint32_t p = 0; p < parts.size(); ++p)
            if (leaves(p)) return true;
        return false;
    }
    void stay(Births& births, uint32_t part, const char* setting) {
        births.refused.push(refused_event(state.bodies, body, setting));
        is_refused = true;
        join_parts(ShellView(state, broken), parts, part, largest);
        join_motions(motions[largest], motions[part]);
    }
};

Plan plan_of(Births& births, Row<Bodies> body, Row<Shells> broken, std::span<FragmentPart> parts) {
    Arena& arena = births.arena;
    return {births.state,
            body,
            broken,
            parts,
            arena.take<PartMotion>(parts.size()),
            arena.take<uint32_t>(parts.size()),
            arena.take<Row<Bodies>>(parts.size()),
            arena.take<uint8_t>(parts.size())};
}

// Room that the rest needs whatever leaves. False: none, and nothing else is to change.
bool reserve_points(Births& births, Plan& plan) {
    const uint32_t rows = births.state.shells.cells[plan.broken].count * kMostCellPoints;
    if (take_points(births.state, rows, plan.points)) return true;
    births.refused.push(refused_event(births.state.bodies, plan.body, "limits.vertices"));
    return false;
}

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

// Room for the rest's drawn mesh. Where there is none the lightest pieces give their rows back and stay, and in the end
// the crumbs do. False when even then there is none: the mesh that was drawn last stands.
bool reserve_view(Births& births, Plan& plan) {
    State& state = births.state;
    const auto count = static_cast<uint32_t>(plan.order.size());
    uint32_t lightest = count;
    while (!take_view(state, plan.body, ShellView(state, plan.broken), plan.parts[plan.largest])) {
        do {
            if (--lightest == 0) {
                for (uint32_t i = 1; i < count; ++i) {
                    if (!plan.is_crumb[plan.order[i]]) continue;
                    plan.is_crumb[plan.order[i]] = 0;
                    plan.stay(births, plan.order[i], "limits.view_vertices");
                }
                if (take_view(state, plan.body, ShellView(state, plan.broken), plan.parts[plan.largest])) return true;
                births.refused.push(refused_event(state.bodies, plan.body, "limits.view_vertices"));
                return false;
            }
        } while (!plan.child[plan.order[lightest]].exists());
        const uint32_t p = plan.order[lightest];
        free_body(state, plan.child[p]);
        plan.child[p] = {};
        plan.stay(births, p, "limits.view_vertices");
    }
    return true;
}

// Hits that wait for the body go on to the piece that owns the nearest vertex; a crumb takes its own along.
void hand_on_hits(State& state, const Plan& plan) {
    const ShellView shell(state, plan.broken);
    QueuedHits& queued = state.queued_hits;
    for (uint32_t q = 0; q < queued.size(); ++q) {
        if (!queued.is_used[q] || queued.body[q] != plan.body) continue;
        float least = 1e30f;
        uint32_t owner = plan.largest;
        for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
            const uint32_t row = shell.vertex(v), element = state.vertices.element[row];
            if (element == kNone) continue;
            const Vec3 away = state.vertices.rest[row] - queued.point[q];
            if (dot(away, away) >= least) continue;
            least = dot(away, away);
            owner = state.elements.part[shell.element(element)];
        }
        if (plan.is_crumb[owner])
            queued.clear_rows(q, 1);
        else if (plan.child[owner].exists())
            queued.body[q] = plan.child[owner];
    }
}

// The smaller sides have moved (design section 3): the rest keeps its rows, those of the pieces die. What rows the body
// had before tell which hulls are as they were.
void keep_rest(Births& births, Plan& plan) {
    State& state = births.state;
    const ShellView shell(state, plan.broken), before(state, state.bodies.shell[plan.body]);
    const Range points = state.shells.points[before.row], old_points = state.shells.points[shell.row];
    state.shells.points[shell.row] = plan.points;
    hand_on_hits(state, plan);
    const ShellSums whole = sums_of(shell);
    ShellSums left;
    uint32_t left_elements = 0;
    for (uint32_t p = 0; p < plan.parts.size(); ++p) {
        if (!plan.leaves(p)) continue;
        const FragmentPart& part = plan.parts[p];
        left_elements += part.element_count;
        if (plan.child[p].exists())
            left = left + sums_of(ShellView(state, state.bodies.shell[plan.child[p]]));
        else
            for (uint32_t e = part.first_element; e != kNone; e = state.elements.next[shell.element(e)])
                left = left + element_sums(shell, e);
        shed_part(shell, part);
    }
    ++state.shells.generation[shell.row];
    clear_run(shell, false);
    measure_rest(shell, whole, left, left_elements);
    renew_hulls(shell, points, before);
    state.pools.points.give_back(old_points.first, old_points.capacity);
    adopt_shell(state, plan.body, shell.row);
}

// New pieces start in touch with each other, and with what struck them.
void part_siblings(Births& births, const Plan& plan, std::span<const Bounds> bounds) {
    const auto count = static_cast<uint32_t>(plan.parts.size());
    for (uint32_t p = 0; p < count; ++p)
        for (uint32_t q = p + 1; q < count; ++q)
            if (plan.child[p].exists() && plan.child[q].exists() && bounds[p].is_near(bounds[q]))
                births.rigid.ignore_pair(plan.child[p], plan.child[q], kSiblingSeconds, true);
}

void part_strikers(Births& births, Row<Tasks> task, const Plan& plan, bool is_late) {
    State& state = births.state;
    const auto count = static_cast<uint32_t>(plan.parts.size());
    const uint32_t first = state.tasks.first_contact[task];
    for (uint32_t p = 0; p < count; ++p) {
        if (!plan.child[p].exists()) continue;
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
    const auto pieces = convex_pieces(state, bodies.shell[child], births.arena, body);
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
    births.born.push({body_id(bodies, child), body_id(bodies, body), bodies.user_data[body],
                      to_world(moment.pose, bodies.centre[child].to_float()), motion, bodies.mass[child],
                      state.shells.generation[bodies.shell[child]]});
}

// Children first: their hulls are found among the body's, which change last.
void make_births_of(Births& births, Plan& plan, const Moment& moment) {
    State& state = births.state;
    const auto count = static_cast<uint32_t>(plan.parts.size());
    for (uint32_t i = 1; i < count; ++i) {
        const uint32_t p = plan.order[i];
        if (!plan.is_crumb[p]) continue;
        make_debris(births, ShellView(state, plan.broken), plan.parts[p], world_motion(moment, plan.motions[p]), moment,
                    plan.body, plan.motions[p].centre);
    }
    plan.child[plan.largest] = plan.body;
    const auto bounds = births.arena.take<Bounds>(count);
    for (uint32_t i = 1; i <= count; ++i) {
        const uint32_t p = plan.order[i % count];
        if (plan.child[p].exists()) make_birth(births, plan, p, moment, bounds[p]);
    }
    part_siblings(births, plan, bounds);
}

// What frees no piece changes no velocity: the body keeps its cracks, and its loose pieces until there is room.
void stay_whole(Births& births, Plan& plan) {
    State& state = births.state;
    const ShellView shell(state, plan.broken), before(state, state.bodies.shell[plan.body]);
    if (before.row == shell.row || !keep_hulls(shell, before)) return;
    clear_run(shell, true);
    adopt_shell(state, plan.body, shell.row);
}

// Plans and reserves; what is refused asks again in the next frame. True: something leaves.
bool reserve_births(Births& births, Plan& plan) {
    State& state = births.state;
    uint8_t& owed = state.bodies.is_owed_births[plan.body];
    plan_births(births, plan);
    const bool is_drawn = reserve_view(births, plan), was_drawn = owed != kOwedDrawing;
    owed = !is_drawn ? kOwedDrawing : plan.is_refused ? kOwedBirths : 0;
    if (plan.is_broken()) return true;
    const bool is_new = plan.broken != state.bodies.shell[plan.body];
    state.pools.points.give_back(plan.points.first, plan.points.capacity);
    if (is_drawn && (is_new || !was_drawn)) births.changed.push({plan.body});
    stay_whole(births, plan);
    return false;
}

// Every piece goes on with the body's own motion, about the centres that the rigid world knows, so that momentum and
// angular momentum are kept to rounding.
void move_with_body(State& state, Plan& plan) {
    const Bodies& bodies = state.bodies;
    const Quat to_body_axes = conjugate(bodies.orientation[plan.body]);
    const Vec3d velocity(rotate(to_body_axes, bodies.velocity[plan.body])),
        spin(rotate(to_body_axes, bodies.spin[plan.body]));
    const ShellView shell(state, plan.broken);
    for (uint32_t p = 0; p < plan.parts.size(); ++p) {
        Moments sum;
        for (uint32_t e = plan.parts[p].first_element; e != kNone; e = state.elements.next[shell.element(e)])
            sum = sum + element_moments(shell, e);
        const MassProperties own = mass_properties(sum);
        PartMotion& m = plan.motions[p];
        m = {};
        m.mass = own.mass;
        m.centre = own.centre;
        m.inertia = own.inertia;
        m.is_static = plan.parts[p].has_pins;
        if (m.is_static) continue;
        m.spin = spin;
        m.velocity = velocity + cross(spin, own.centre - bodies.centre[plan.body]);
        m.momentum = own.mass * m.velocity;
    }
}

}  // namespace

void break_body(Births& births, Row<Tasks> task) {
    State& state = births.state;
    const Row<Bodies> body = state.tasks.body[task];
    const Row<Shells> broken = state.tasks.shell[task];
    const ShellView shell(state, broken);
    Plan plan =
        plan_of(births, body, broken,
                std::span(state.fragments.part.data() + size_t{task} * kMostParts, state.tasks.part_count[task]));
    if (!reserve_points(births, plan)) return;
    const HandoffReport report =
        rigid_handoff(shell,
                      {Vec3d(state.tasks.start_velocity[task]), Vec3d(state.tasks.start_spin[task]),
                       state.shells.centre[broken], state.tasks.approach_speed[task]},
                      plan.parts, plan.motions);
    find_changed_cells(shell, ShellView(state, state.bodies.shell[body]));
    if (!reserve_births(births, plan)) return;
    keep_rest(births, plan);
    births.counts.clamped += report.speed_clamps + report.spin_clamps;
    const Moment moment = moment_of(state, task, plan.motions);
    if (!moment.is_late) strike_back(births, task, moment.pose, plan.motions, plan.largest);
    make_births_of(births, plan, moment);
    part_strikers(births, task, plan, moment.is_late);
}

void ask_again(Births& births, Row<Bodies> body) {
    State& state = births.state;
    const ShellView shell(state, state.bodies.shell[body]);
    const std::span slot(state.fragments.part.data() + size_t{state.tasks.limit()} * kMostParts, kMostParts);
    const uint32_t count = group_fragments(shell, slot);
    if (count > kMostParts) return;
    Plan plan = plan_of(births, body, shell.row, slot.first(count));
    if (!reserve_points(births, plan)) return;
    move_with_body(state, plan);
    find_changed_cells(shell, shell);
    if (!reserve_births(births, plan)) return;
    keep_rest(births, plan);
    make_births_of(births, plan, {pose_of(state.bodies, body), {}, {}, {}, false});
}

void keep_cracks(Births& births, Row<Tasks> task) {
    State& state = births.state;
    const Row<Bodies> body = state.tasks.body[task];
    const ShellView shell(state, state.tasks.shell[task]), before(state, state.bodies.shell[body]);
    const FragmentPart& whole = state.fragments.part[size_t{task} * kMostParts];
    const char* full = nullptr;
    if (!take_view(state, body, shell, whole))
        full = "limits.view_vertices";
    else if (!keep_hulls(shell, before))
        full = "limits.vertices";
    if (full) {
        births.refused.push(refused_event(state.bodies, body, full));
        return;
    }
    clear_run(shell, true);
    adopt_shell(state, body, shell.row);
    births.changed.push({body});
}

}  // namespace cullet
