#include "systems/births/plan_break.hpp"

#include <algorithm>
#include <memory>

#include "components/body_id.hpp"
#include "systems/births/hand_on.hpp"
#include "systems/births/limit_energy.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/body_rows.hpp"
#include "systems/bodies/thresholds.hpp"
#include "systems/models.hpp"
#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/crack_touches.hpp"
#include "systems/structures/shell/make_piece.hpp"
#include "systems/structures/shell/piece_shape.hpp"
#include "systems/structures/shell/redraw_body.hpp"
#include "systems/structures/shell/rest_of_body.hpp"
#include "systems/structures/shell/waiting_pieces.hpp"

namespace cullet {
namespace {

// Cuts have no last generation: more are not told apart.

// A piece that found no room stays part of another and moves with it, as one that keeps momentum and angular momentum.
void join_motions(PartMotion& motion, PartMotion& joined) {
    const double mass = motion.mass + joined.mass;
    if (!(mass > 0)) return;
    const bool is_static = motion.is_static || joined.is_static;
    const Vec3d centre = (1 / mass) * (motion.mass * motion.centre + joined.mass * joined.centre);
    Sym3d inertia;
    Vec3d turning;
    for (const PartMotion* m : {&motion, &joined}) {
        const Vec3d arm = m->centre - centre;
        inertia = inertia + m->inertia + m->mass * inertia_of(outer(arm));
        turning += m->inertia * m->spin + cross(arm, m->momentum);
    }
    motion.mass = mass;
    motion.centre = centre;
    motion.inertia = inertia;
    motion.is_static = is_static;
    motion.momentum = is_static ? Vec3d{} : motion.momentum + joined.momentum;
    motion.velocity = (1 / mass) * motion.momentum;
    const double scale = trace(inertia);
    if (is_static)
        motion.spin = {};
    else if (determinant(inertia) > 1e-12 * scale * scale * scale)
        motion.spin = inverse(inertia) * turning;
    joined = {};
}

// Rows, shell and drawn mesh of a new body, or a row that does not exist and the name of the limit.
Row<Bodies> reserve_body(Planning& planning, Row<Bodies> parent, Row<Structures> broken, const FragmentPart& part,
                         const char** full) {
    BodyRows& state = planning.state;
    const Row<Bodies> body = take_body(state);
    if (!body.exists()) {
        *full = "limits.bodies";
        return {};
    }
    state.bodies.structure[body] = reserve_piece(
        state, broken, part,
        static_cast<uint8_t>(std::min<uint32_t>(state.structures.generation[broken], kMostGenerations - 1) + 1), full);
    if (state.bodies.structure[body].exists() && take_view(state, body, ShellView(state, broken), part)) {
        Bodies& b = state.bodies;
        b.model[body] = b.model[parent];
        b.parent[body] = parent;
        for (auto* column : {&b.friction, &b.restitution, &b.rolling_friction, &b.strength_scale})
            (*column)[body] = (*column)[parent];
        b.layer[body] = b.layer[parent];
        b.mask[body] = b.mask[parent];
        b.user_data[body] = b.user_data[parent];
        b.is_breakable[body] = b.is_breakable[parent];
        if (part.has_pins) b.pins[body] = b.pins[parent];
        planning.models.inherit(state, parent, body);
        return body;
    }
    if (state.bodies.structure[body].exists()) *full = "limits.view_vertices";
    free_body(state, body);
    return {};
}

// The limit that refuses one more piece, or null.
const char* full_of_births(const Planning& planning) {
    if (planning.fragments_left == 0) return "limits.fragments";
    return planning.births_left == 0 ? "limits.births_a_frame" : nullptr;
}

void count_births(Planning& planning, uint32_t born, uint32_t given_back) {
    planning.fragments_left += given_back - born;
    planning.births_left += given_back - born;
}

// Before parts are joined: the touches name them.
void settle(Break& plan) {
    if (plan.is_settled) return;
    settle_momenta(plan.handoff[0].start, plan.motions, plan.handoff[0].report);
    plan.is_settled = true;
}

void stay(Planning& planning, Break& plan, uint32_t part, const char* setting) {
    settle(plan);
    planning.refused.push(refused_event(planning.state.bodies, plan.body, setting));
    const ShellView shell(planning.state, plan.broken);
    if (!plan.is_torn) {
        if (plan.task.exists() && !plan.is_refused) forget_own_motions(shell);
        if (!plan.motions[part].is_static) keep_own_motion(shell, plan.parts[part], plan.motions[part]);
    }
    plan.is_refused = true;
    join_parts(ShellView(planning.state, plan.broken), plan.parts, part, plan.largest);
    join_motions(plan.motions[plan.largest], plan.motions[part]);
}

Break break_of(Planning& planning, Row<Tasks> task, Row<Bodies> body, Row<Structures> broken,
               std::span<FragmentPart> parts) {
    Arena& arena = planning.arena;
    Break plan;
    plan.task = task;
    plan.body = body;
    plan.broken = broken;
    plan.before = planning.state.bodies.structure[body];
    plan.parts = parts;
    plan.motions = arena.take<PartMotion>(parts.size());
    plan.order = arena.take<uint32_t>(parts.size());
    plan.child = arena.take<Row<Bodies>>(parts.size());
    plan.debris = arena.take<uint32_t>(parts.size());
    std::fill(plan.debris.begin(), plan.debris.end(), kNone);
    plan.is_crumb = arena.take<uint8_t>(parts.size());
    const ShellView before(planning.state, plan.before);
    plan.margin = hull_margin(before);
    plan.had_cells = shape_of(before) == ShapeKind::Cells;
    return plan;
}

// Which cells pieces may leave, beside those that cracked.
void mark_left_cells(const Break& plan, const ShellView& shell) {
    const Elements& elements = shell.state.elements;
    const uint32_t first_cell = shell.cells().first, rest = largest_part(plan.parts);
    for (uint32_t p = 0; p < plan.parts.size(); ++p)
        for (uint32_t e = p == rest ? kNone : plan.parts[p].first_element; e != kNone;
             e = elements.next[shell.element(e)])
            shell.state.cells.is_changed[first_cell + elements.cell[shell.element(e)]] |= kLeft;
}

// Room that the rest needs whatever leaves. False: none, and nothing else is to change.
bool reserve_points(Planning& planning, Break& plan) {
    const ShellView broken(planning.state, plan.broken);
    find_changed_cells(broken, ShellView(planning.state, plan.before));
    mark_left_cells(plan, broken);
    plan.chooses_shape = !plan.is_torn && broken.element_count() <= kMostWholeElements;
    plan.keeps_hulls = plan.broken == plan.before && !plan.is_torn && plan.had_cells && !plan.chooses_shape &&
                       has_room_to_renew(broken);
    if (plan.keeps_hulls) return true;
    const uint32_t rows = most_points(broken.cells().count, broken.element_count());
    if (take_points(planning.state, rows, plan.points)) return true;
    planning.refused.push(refused_event(planning.state.bodies, plan.body, "limits.vertices"));
    return false;
}

// Which pieces are crumbs, bodies, or stay; heaviest first, ties by number.
void choose_births(Planning& planning, Break& plan) {
    SoftRows& state = planning.state;
    const auto count = static_cast<uint32_t>(plan.parts.size());
    for (uint32_t i = 0; i < count; ++i) plan.order[i] = i;
    std::sort(plan.order.begin(), plan.order.end(), [&](uint32_t a, uint32_t b) {
        if (plan.is_torn && plan.parts[a].has_pins != plan.parts[b].has_pins) return plan.parts[a].has_pins;
        return plan.parts[a].mass != plan.parts[b].mass ? plan.parts[a].mass > plan.parts[b].mass : a < b;
    });
    plan.largest = plan.order[0];
    const double least_mass = planning.settings.debris_share * state.structures.intact_mass[plan.broken];
    for (uint32_t p = 0; p < count; ++p) {
        plan.child[p] = {};
        plan.is_crumb[p] = 0;
    }
    for (uint32_t i = 1; i < count; ++i) {
        const uint32_t p = plan.order[i];
        const FragmentPart& part = plan.parts[p];
        const char* full = full_of_births(planning);
        if (!part.has_pins && (part.mass < least_mass || part.element_count < planning.settings.debris_elements)) {
            if (planning.crumbs_left > 0) {
                --planning.crumbs_left;
                plan.is_crumb[p] = 1;
            } else {
                stay(planning, plan, p, "limits.debris");
            }
            continue;
        }
        if (!full) plan.child[p] = reserve_body(planning, plan.body, plan.broken, part, &full);
        if (plan.child[p].exists())
            count_births(planning, 1, 0);
        else
            stay(planning, plan, p, full);
    }
}

// The mesh that is drawn of the body is up to date, has room for what is new of the rest, and more of it stays than
// goes.
bool keeps_mesh(Planning& planning, const Break& plan) {
    SoftRows& state = planning.state;
    if (plan.is_torn || state.bodies.is_owed_births[plan.body] == kOwedDrawing) return false;
    uint32_t left = 0;
    for (uint32_t p = 0; p < plan.parts.size(); ++p)
        if (plan.leaves(p)) left += plan.parts[p].element_count;
    if (2 * left > state.structures.live_elements[plan.broken]) return false;
    const Range &vertices = state.bodies.view_vertices[plan.body], &indices = state.bodies.view_indices[plan.body];
    return rows_to_draw(state, plan.body, ShellView(state, plan.broken), plan.largest) <=
           std::min(vertices.capacity, indices.capacity);
}

// Room for the rest's drawn mesh. Where there is none the lightest pieces give their rows back and stay, and in the end
// the crumbs do. False when even then there is none: the mesh that was drawn last stands.
bool reserve_view(Planning& planning, Break& plan) {
    SoftRows& state = planning.state;
    const auto count = static_cast<uint32_t>(plan.order.size());
    uint32_t lightest = count;
    if (keeps_mesh(planning, plan)) return plan.keeps_mesh = true;
    list_part(ShellView(state, plan.broken), plan.parts, plan.largest);
    while (!take_rest_view(state, plan.body, ShellView(state, plan.broken), plan.parts[plan.largest])) {
        do {
            if (--lightest == 0) {
                for (uint32_t i = 1; i < count; ++i) {
                    if (!plan.is_crumb[plan.order[i]]) continue;
                    plan.is_crumb[plan.order[i]] = 0;
                    ++planning.crumbs_left;
                    stay(planning, plan, plan.order[i], "limits.view_vertices");
                }
                if (take_rest_view(state, plan.body, ShellView(state, plan.broken), plan.parts[plan.largest]))
                    return true;
                planning.refused.push(refused_event(state.bodies, plan.body, "limits.view_vertices"));
                return false;
            }
        } while (!plan.child[plan.order[lightest]].exists());
        const uint32_t p = plan.order[lightest];
        free_body(state, plan.child[p]);
        plan.child[p] = {};
        count_births(planning, 0, 1);
        stay(planning, plan, p, "limits.view_vertices");
    }
    return true;
}

// The body stays as it was: the task's cuts wait until there is room (close_blows).
void keep_cuts(Blows& blows, Row<Tasks> task) {
    for (uint32_t b = 0; b < blows.size() && task.exists(); ++b)
        if (blows.task[b] == task.index && is_kind(blows, b, BlowKind::Cut)) blows.goes_on[b] = 1;
}

// A contact is not solved where the striker breaks too, on time and at this body: what the touch takes is in the motion
// of the striker's pieces, in this frame or since one before it.
bool goes_to_striker(const Tasks& tasks, const TaskContacts& contacts, const Bodies& bodies, Row<Bodies> body,
                     uint32_t contact) {
    if (contacts.is_answered[contact]) return true;
    const Row<Bodies> striker = contacts.striker[contact];
    const uint32_t own = striker.exists() ? bodies.task[striker] : kNone;
    if (own == kNone || static_cast<TaskState>(tasks.state[own]) != TaskState::Broke || tasks.is_late[own])
        return false;
    const uint32_t first = tasks.first_contact[own], end = first + tasks.contact_count[own];
    for (uint32_t c = first; c < end; ++c)
        if (contacts.striker[c] == body) return true;
    return false;
}

// J that pieces may have beyond the body's motion where none of them left: what the contact that is solved now takes
// for certain, as half of what two bodies lose that meet without bouncing; of a late result what it has taken.
double lost_to_touch(const BodyRows& state, Row<Tasks> task) {
    if (state.tasks.is_late[task]) return owed_to_late(state, task);
    const TaskContacts& contacts = state.task_contacts;
    const Row<Bodies> body = state.tasks.body[task];
    const uint32_t first = state.tasks.first_contact[task], end = first + state.tasks.contact_count[task];
    double most = 0;
    for (uint32_t c = first; c < end; ++c) {
        if (goes_to_striker(state.tasks, contacts, state.bodies, body, c)) continue;
        const Vec3d point(contacts.point[c]), normal(contacts.normal[c]);
        const Vec3d arm = point - state.bodies.centre[body];
        const Vec3d moving = Vec3d(state.tasks.start_velocity[task]) + cross(Vec3d(state.tasks.start_spin[task]), arm);
        const double speed = double{contacts.start_speed[c]} - dot(moving, normal);
        const double inverse_mass =
            inverse_mass_at(state.bodies, body, point, normal) + double{contacts.striker_inverse_mass[c]};
        const Row<Bodies> striker = contacts.striker[c];
        const double bounce =
            striker.exists() ? double{state.bodies.restitution[body]} * state.bodies.restitution[striker] : 1;
        if (speed > 0 && inverse_mass > 0)
            most = std::max(most, 0.5 * (1 - bounce * bounce) * 0.5 * speed * speed / inverse_mass);
    }
    return most;
}

// What frees no piece changes no velocity: the body keeps its cracks, and its loose pieces until there is room.
void stay_whole(Planning& planning, Break& plan) {
    SoftRows& state = planning.state;
    const ShellView shell(state, plan.broken), before(state, state.bodies.structure[plan.body]);
    if (!plan.task.exists()) return;
    if (!keep_hulls(shell, before)) return keep_cuts(planning.blows, plan.task);
    clear_run(shell, true, shell.row != before.row, plan.is_refused);
    adopt_shell(state, plan.body, shell.structure);
    if (!plan.is_refused) return;
    // An explosion's energy comes from outside.
    if (has_explosion(planning.blows, plan.task))
        planning.counts.work_from_outside += waiting_energy(state, plan.body);
    else
        limit_waiting(state, plan.body, lost_to_touch(state, plan.task));
}

// What a hit changed in the body's own shell stays there. It is drawn, and its pieces go, when there is room.
void leave_cracked(BodyRows& state, Row<Bodies> body) {
    clear_run(ShellView(state, state.bodies.structure[body]), true, false);
    state.bodies.is_owed_births[body] = kOwedBirths;
}

// Plans and reserves; what is refused asks again in the next frame. True: something leaves.
bool reserve_births(Planning& planning, Break& plan) {
    SoftRows& state = planning.state;
    uint8_t& owed = state.bodies.is_owed_births[plan.body];
    choose_births(planning, plan);
    const bool is_drawn = reserve_view(planning, plan);
    if (plan.is_refused && !plan.is_torn) subtract_motion(ShellView(state, plan.broken), plan.motions[plan.largest]);
    const bool was_drawn = owed != kOwedDrawing;
    owed = !is_drawn ? kOwedDrawing : plan.is_refused ? kOwedBirths : 0;
    plan.lets_go = !plan.is_torn && state.bodies.has_pins[plan.body] && !plan.motions[plan.largest].is_static;
    if (plan.is_broken()) return true;
    const bool is_new = plan.task.exists();
    state.hull_points.pool.give_back(plan.points.first, plan.points.capacity);
    if (is_drawn && (is_new || !was_drawn)) planning.changed.push({plan.body, plan.keeps_mesh});
    stay_whole(planning, plan);
    return false;
}

// Every piece goes on with the body's own motion, about the centres that the rigid world knows, so that momentum and
// angular momentum are kept to rounding.
void move_with_body(BodyRows& state, Break& plan, Vec3d velocity, Vec3d spin) {
    const Bodies& bodies = state.bodies;
    const ShellView shell(state, plan.broken);
    for (uint32_t p = 0; p < plan.parts.size(); ++p) {
        list_part(shell, plan.parts, p);
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

// Something leaves: what is to be filled, heaviest first, so that the longest work begins first.
void order_births(Planning& planning, Break& plan) {
    SoftRows& state = planning.state;
    for (uint32_t p = 0; p < plan.parts.size(); ++p)
        if (plan.leaves(p)) plan.left_elements += plan.parts[p].element_count;
    plan.whole = sums_of(ShellView(state, plan.broken));
    if (plan.is_rest_smaller(state) || plan.chooses_shape)
        list_part(ShellView(state, plan.broken), plan.parts, plan.largest);
    hand_on_hits(planning, plan);
    hand_on_blows(planning, plan);
    const uint32_t of = planning.breaks.size();
    if (!plan.is_settled) planning.births.push({of, kNone});
    for (const uint32_t p : plan.order)
        if (p == plan.largest || plan.leaves(p)) planning.births.push({of, p});
    planning.breaks.push(plan);
}

}  // namespace

uint32_t free_debris(const Debris& debris) {
    uint32_t used = 0;
    for (uint32_t d = 0; d < debris.size(); ++d) used += debris.is_used[d];
    return debris.limit() - used;
}

uint32_t free_fragments(const FragmentAges& ages, const DamageSettings& settings) {
    uint32_t alive = 0;
    for (uint32_t b = 0; b < ages.size(); ++b) alive += ages.born[b] > 0;
    return settings.fragments - std::min(alive, settings.fragments);
}

void plan_break(Planning& planning, Row<Tasks> task) {
    SoftRows& state = planning.state;
    const Row<Bodies> body = state.tasks.body[task];
    const Row<Structures> broken = state.tasks.working[task];
    const ShellView shell(state, broken);
    Break plan =
        break_of(planning, task, body, broken,
                 std::span(planning.fragments.part.data() + size_t{task} * kMostParts, state.tasks.part_count[task]));
    if (!reserve_points(planning, plan)) {
        if (broken == plan.before) leave_cracked(state, body);
        return keep_cuts(planning.blows, task);
    }
    const Vec3d velocity(state.tasks.start_velocity[task]), spin(state.tasks.start_spin[task]);
    std::optional<RestMotion> rest;
    if (broken == plan.before) rest = planning.models.motion_of_rest(state, task);
    if (is_cut_task(planning.blows, task)) {
        move_with_body(state, plan, velocity, spin);  // nothing was run
    } else {
        HandoffStart start{velocity, spin, state.structures.centre[broken], state.tasks.approach_speed[task], rest};
        start.touches = plan.touches = crack_touches(shell, broken == plan.before, planning.arena);
        start.touching = planning.arena.take<Touching>(plan.parts.size());
        plan.handoff = planning.arena.take<Handoff>(1);
        std::construct_at(plan.handoff.data(), Handoff{start, gather_momenta(shell, start, plan.parts, plan.motions)});
        plan.is_settled = false;
    }
    if (reserve_births(planning, plan)) order_births(planning, plan);
}

// The slot serves one body after the other: the parts move into the arena.
void ask_again(Planning& planning, Row<Bodies> body) {
    SoftRows& state = planning.state;
    const ShellView shell(state, state.bodies.structure[body]);
    const std::span slot(planning.fragments.part.data() + size_t{state.tasks.limit()} * kMostParts, kMostParts);
    const uint32_t count = group_fragments(shell, slot);
    if (count > kMostParts) return;
    const auto parts = planning.arena.take<FragmentPart>(count);
    std::copy_n(slot.begin(), parts.size(), parts.begin());
    Break plan = break_of(planning, {}, body, shell.structure, parts);
    if (!reserve_points(planning, plan)) return;
    const Bodies& bodies = state.bodies;
    if (bodies.is_asleep[body]) forget_own_motions(shell);
    plan.waited = waiting_energy(state, body);
    const Quat to_body_axes = conjugate(bodies.orientation[body]);
    move_with_body(state, plan, Vec3d(rotate(to_body_axes, bodies.velocity[body])),
                   Vec3d(rotate(to_body_axes, bodies.spin[body])));
    take_own_motions(shell, plan.parts, plan.motions);
    plan.touches = crack_touches(shell, false, planning.arena);
    if (reserve_births(planning, plan)) order_births(planning, plan);
}

// The parts' velocities are those of their points, as at any hand-off; which hulls fit is not known any more.
void plan_tear(Planning& planning, Row<Bodies> body) {
    SoftRows& state = planning.state;
    const ShellView shell(state, state.bodies.structure[body]);
    const std::span slot(planning.fragments.part.data() + size_t{state.tasks.limit()} * kMostParts, kMostParts);
    const uint32_t count = group_fragments(shell, slot);
    if (count < 2 || count > kMostParts) return;
    const auto parts = planning.arena.take<FragmentPart>(count);
    std::copy_n(slot.begin(), parts.size(), parts.begin());
    Break plan = break_of(planning, {}, body, shell.structure, parts);
    plan.is_torn = true;
    const Range cells = state.structures.cells[shell.structure];
    for (uint32_t c = cells.first; c < cells.first + cells.count; ++c) state.cells.is_stale[c] = 1;
    if (!reserve_points(planning, plan)) return;
    planning.models.hand_off_torn(state, {plan.body, plan.order, plan.parts, plan.child}, plan.motions);
    measure_shell(shell);  // as it is shaped now: pieces are subtracted from it
    if (reserve_births(planning, plan)) order_births(planning, plan);
}

void keep_cracks(Planning& planning, Row<Tasks> task) {
    SoftRows& state = planning.state;
    const Row<Bodies> body = state.tasks.body[task];
    const ShellView shell(state, state.tasks.working[task]), before(state, state.bodies.structure[body]);
    const std::span parts(&planning.fragments.part[task * kMostParts], 1);
    const char* full = nullptr;
    find_changed_cells(shell, before);
    const Range &vertices = state.bodies.view_vertices[body], &indices = state.bodies.view_indices[body];
    const bool is_local = rows_to_draw(state, body, shell, kNone) <= std::min(vertices.capacity, indices.capacity) &&
                          state.bodies.is_owed_births[body] != kOwedDrawing;
    if (!is_local) list_part(shell, parts, 0);
    if (!is_local && !take_rest_view(state, body, shell, parts[0]))
        full = "limits.view_vertices";
    else if (!keep_hulls(shell, before))
        full = "limits.vertices";
    if (full) {
        planning.refused.push(refused_event(state.bodies, body, full));
        if (shell.row == before.row) leave_cracked(state, body);
        return keep_cuts(planning.blows, task);
    }
    clear_run(shell, true, shell.row != before.row);
    adopt_shell(state, body, shell.structure);
    planning.changed.push({body, is_local});
}

}  // namespace cullet
