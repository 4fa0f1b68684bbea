#include "systems/births/plan_break.hpp"

#include "components/body_id.hpp"
#include "systems/births/fragment_motions.hpp"
#include "systems/births/order_births.hpp"
#include "systems/births/reserve_births.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/body_rows.hpp"

namespace cullet {
namespace {

Break break_of(const Planning& planning, Row<Tasks> task, Row<Bodies> body, Row<Structures> broken,
               Rows<Fragments> fragments) {
    const Structures& structures = planning.state.structures;
    Break plan;
    plan.task = task;
    plan.body = body;
    plan.fragments = fragments;
    plan.largest = Row<Fragments>(fragments.first);
    plan.broken = broken;
    plan.before = planning.state.bodies.structure[body];
    plan.margin = structures.margin[plan.before];
    plan.had_cells = shape_of(structures, plan.before) == ShapeKind::Cells;
    return plan;
}

// What a hit changed in the body's own structure stays there. It is drawn, and its pieces go, when there is room.
void leave_cracked(Planning& planning, Row<Bodies> body) {
    auto& state = planning.state;
    const Row<Structures> own = state.bodies.structure[body];
    planning.calls(own).clear_run(state, own, {true, false});
    state.bodies.is_owed_births[body] = kOwedBirths;
}

// The hit waits as it is.
void refuse(Planning& planning, Row<Tasks> task) {
    const Row<Bodies> body = planning.state.tasks.body[task];
    if (planning.state.tasks.working[task] == planning.state.bodies.structure[body]) leave_cracked(planning, body);
    keep_cuts(planning.blows, task);
}

// Motions of the run, which are settled when births are filled, or when some fragment is to stay.
void hand_off(Planning& planning, Break& plan, const std::optional<RestMotion>& rest) {
    auto& state = planning.state;
    const StructureCalls& calls = planning.calls(plan);
    plan.start = {Vec3d(state.tasks.start_velocity[plan.task]), Vec3d(state.tasks.start_spin[plan.task]),
                  state.structures.centre[plan.broken], state.tasks.approach_speed[plan.task]};
    plan.start.touches = calls.find_touches(state, plan, plan.broken == plan.before, planning.touches, planning.arena);
    calls.sum_momenta(state, plan, planning.fragments, rest);
    plan.is_settled = false;
}

// Bodies that no task works on: as many rows as tasks may need stay free.
Rows<Fragments> list_anew(Planning& planning, Row<Structures> structure, bool is_reshaped = false) {
    const Fragments& f = planning.fragments;
    const uint32_t kept = planning.state.tasks.limit() * kMostParts + kMostParts;
    if (f.limit() - f.size() < kept) return {};
    const StructureCalls& calls = planning.calls(structure);
    return (is_reshaped ? calls.list_whole : calls.list_anew)(planning.state, structure, planning.fragments);
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
    auto& state = planning.state;
    const Row<Structures> broken = state.tasks.working[task];
    const Rows<Fragments> found = planning.calls(broken).list_found(state, task, planning.fragments);
    Break plan = break_of(planning, task, state.tasks.body[task], broken, found);
    // It tore, and nothing came off. Who stood on pins and has none any more falls, which is another thing.
    plan.is_reshaped =
        found.count == 1 && !state.bodies.has_pins[plan.body] == !planning.fragments.has_pins[found.first];
    if (found.count == 0 || !reserve_hulls(planning, plan)) return refuse(planning, task);
    std::optional<RestMotion> rest;
    if (broken == plan.before) rest = planning.models.motion_of_rest(state, task);
    if (is_cut_task(planning.blows, task))  // nothing was run
        move_with_body(planning, plan, Vec3d(state.tasks.start_velocity[task]), Vec3d(state.tasks.start_spin[task]));
    else
        hand_off(planning, plan, rest);
    if (reserve_births(planning, plan)) order_births(planning, plan);
}

void ask_again(Planning& planning, Row<Bodies> body) {
    auto& state = planning.state;
    const Bodies& bodies = state.bodies;
    const Row<Structures> own = bodies.structure[body];
    const bool is_reshaped = bodies.is_owed_births[body] == kOwedShape;
    const Rows<Fragments> found = list_anew(planning, own, is_reshaped);
    if (found.count == 0) return;
    Break plan = break_of(planning, {}, body, own, found);
    plan.is_reshaped = is_reshaped;
    if (!reserve_hulls(planning, plan)) return;
    const StructureCalls& calls = planning.calls(own);
    if (bodies.is_asleep[body]) calls.forget_waiting(state, own);
    plan.waited = calls.waiting_energy(state, body);
    const Quat to_body_axes = conjugate(bodies.orientation[body]);
    const Vec3d velocity(rotate(to_body_axes, bodies.velocity[body])), spin(rotate(to_body_axes, bodies.spin[body]));
    if (plan.is_reshaped)
        move_reshaped(planning, plan, velocity, spin);
    else
        move_with_body(planning, plan, velocity, spin);
    calls.take_waiting(state, plan, planning.fragments);
    plan.start.touches = calls.find_touches(state, plan, false, planning.touches, planning.arena);
    if (reserve_births(planning, plan)) order_births(planning, plan);
}

// Fragments' velocities are those of their points, as at any hand-off; which hulls fit is not known any more.
void plan_tear(Planning& planning, Row<Bodies> body) {
    auto& state = planning.state;
    const Row<Structures> own = state.bodies.structure[body];
    const Rows<Fragments> found = list_anew(planning, own);
    if (found.count < 2) return;
    Break plan = break_of(planning, {}, body, own, found);
    plan.is_torn = true;
    const Range cells = state.structures.cells[own];
    for (uint32_t c = cells.first; c < cells.first + cells.count; ++c) state.cells.is_stale[c] = 1;
    if (!reserve_hulls(planning, plan)) return;
    planning.models.hand_off_torn(state, plan, planning.fragments);
    planning.calls(own).measure(state, own);  // as it is shaped now: pieces are subtracted from it
    if (reserve_births(planning, plan)) order_births(planning, plan);
}

void keep_cracks(Planning& planning, Row<Tasks> task) {
    auto& state = planning.state;
    const Row<Bodies> body = state.tasks.body[task];
    const Row<Structures> cracked = state.tasks.working[task], before = state.bodies.structure[body];
    const StructureCalls& calls = planning.calls(cracked);
    calls.find_changes(state, cracked, before);
    const bool is_local = has_room_to_redraw(planning, body, cracked);
    const char* full = nullptr;
    if (!is_local && !take_spare_view_rows(state, body, calls.view_rows(state, cracked)))
        full = "limits.view_vertices";
    else if (!calls.keep_hulls(state, cracked, before))
        full = "limits.vertices";
    if (full) {
        planning.refused.push(refused_event(state.bodies, body, full));
        return refuse(planning, task);
    }
    calls.clear_run(state, cracked, {true, cracked != before});
    calls.adopt(state, body, cracked);
    if (static_cast<TaskState>(state.tasks.state[task]) == TaskState::Reshaped)
        state.bodies.is_owed_births[body] = kOwedShape;
    planning.changed.push({body, is_local});
}

}  // namespace cullet
