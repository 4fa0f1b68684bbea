#include "systems/births/reserve_births.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "systems/births/choose_births.hpp"
#include "systems/births/fragment_motions.hpp"
#include "systems/bodies/blows.hpp"
#include "systems/bodies/body_rows.hpp"
#include "systems/bodies/thresholds.hpp"

namespace cullet {
namespace {

// Cuts have no last generation: more are not told apart.
uint8_t next_generation(const Structures& structures, Row<Structures> broken) {
    return static_cast<uint8_t>(std::min<uint32_t>(structures.generation[broken], kMostGenerations - 1) + 1);
}

void inherit(Planning& planning, Row<Bodies> parent, Row<Bodies> body, bool has_pins) {
    Bodies& b = planning.state.bodies;
    b.model[body] = b.model[parent];
    b.parent[body] = parent;
    for (auto* column : {&b.friction, &b.restitution, &b.rolling_friction, &b.strength_scale})
        (*column)[body] = (*column)[parent];
    b.layer[body] = b.layer[parent];
    b.mask[body] = b.mask[parent];
    b.user_data[body] = b.user_data[parent];
    b.is_breakable[body] = b.is_breakable[parent];
    if (has_pins) b.pins[body] = b.pins[parent];
    planning.models.inherit(planning.state, parent, body);
}

// The mesh that is drawn of the body has room for what is new of the rest, and more of it stays than goes.
bool keeps_mesh(Planning& planning, const Break& plan) {
    const Fragments& f = planning.fragments;
    if (plan.is_torn) return false;
    uint32_t left = 0;
    for (const Row<Fragments> row : plan.fragments)
        if (leaves(f, row)) left += f.element_count[row];
    if (2 * left > planning.state.structures.live_elements[plan.broken]) return false;
    return has_room_to_redraw(planning, plan.body, plan.broken, plan.largest - plan.fragments.first);
}

bool take_rest_view(Planning& planning, const Break& plan) {
    const uint32_t rows = planning.calls(plan).piece_view_rows(planning.state, plan, planning.fragments, plan.largest);
    return take_spare_view_rows(planning.state, plan.body, rows);
}

void give_back_debris(Planning& planning, Break& plan) {
    for (uint32_t i = 1; i < plan.fragments.count; ++i) {
        const Row<Fragments> row = plan.in_order(planning.fragments, i);
        if (!planning.fragments.is_debris[row]) continue;
        planning.fragments.is_debris[row] = 0;
        ++planning.debris_left;
        stay(planning, plan, row, "limits.view_vertices");
    }
}

void give_back_body(Planning& planning, Break& plan, Row<Fragments> row) {
    free_body(planning.state, planning.fragments.child[row]);
    planning.fragments.child[row] = {};
    count_births(planning, 0, 1);
    stay(planning, plan, row, "limits.view_vertices");
}

// Room for the rest's drawn mesh. Where there is none the lightest pieces give their rows back and stay, and in the end
// the debris does. False when even then there is none: the mesh that was drawn last stands.
bool reserve_view(Planning& planning, Break& plan) {
    if (keeps_mesh(planning, plan)) return plan.keeps_mesh = true;
    uint32_t lightest = plan.fragments.count;
    while (!take_rest_view(planning, plan)) {
        do --lightest;
        while (lightest > 0 && !planning.fragments.child[plan.in_order(planning.fragments, lightest)].exists());
        if (lightest > 0) {
            give_back_body(planning, plan, plan.in_order(planning.fragments, lightest));
            continue;
        }
        give_back_debris(planning, plan);
        if (take_rest_view(planning, plan)) return true;
        planning.refused.push(refused_event(planning.state.bodies, plan.body, "limits.view_vertices"));
        return false;
    }
    return true;
}

// What frees no piece changes no velocity: the body keeps its cracks, and its loose pieces until there is room.
void stay_whole(Planning& planning, Break& plan) {
    auto& state = planning.state;
    if (!plan.task.exists()) return;
    const StructureCalls& calls = planning.calls(plan);
    const Row<Structures> own = state.bodies.structure[plan.body];
    if (!calls.keep_hulls(state, plan.broken, own)) return keep_cuts(planning.blows, plan.task);
    calls.clear_run(state, plan.broken, {true, plan.broken != own, plan.is_refused});
    calls.adopt(state, plan.body, plan.broken);
    if (!plan.is_refused) return;
    // An explosion's energy comes from outside.
    if (has_explosion(planning.blows, plan.task))
        planning.counts.work_from_outside += calls.waiting_energy(state, plan.body);
    else
        calls.limit_waiting(state, plan.body, lost_to_touch(state, plan.task));
}

}  // namespace

Row<Bodies> reserve_body(Planning& planning, const Break& plan, Row<Fragments> fragment, const char** full) {
    auto& state = planning.state;
    const Row<Bodies> body = take_body(state);
    if (!body.exists()) {
        *full = "limits.bodies";
        return {};
    }
    const StructureCalls& calls = planning.calls(plan);
    const Row<Structures> piece = calls.reserve_piece(state, plan, planning.fragments, fragment,
                                                      next_generation(state.structures, plan.broken), full);
    state.bodies.structure[body] = piece;
    if (piece.exists() &&
        take_view_rows(state, body, calls.piece_view_rows(state, plan, planning.fragments, fragment))) {
        inherit(planning, plan.body, body, planning.fragments.has_pins[fragment]);
        return body;
    }
    if (piece.exists()) *full = "limits.view_vertices";
    free_body(state, body);
    return {};
}

bool reserve_hulls(Planning& planning, Break& plan) {
    if (planning.calls(plan).reserve_hulls(planning.state, planning.fragments, plan)) return true;
    planning.refused.push(refused_event(planning.state.bodies, plan.body, "limits.vertices"));
    return false;
}

bool reserve_births(Planning& planning, Break& plan) {
    auto& state = planning.state;
    uint8_t& owed = state.bodies.is_owed_births[plan.body];
    choose_births(planning, plan);
    const bool is_drawn = reserve_view(planning, plan);
    if (plan.is_refused && !plan.is_torn) planning.calls(plan).subtract_body(state, plan, planning.fragments);
    const bool was_drawn = owed != kOwedDrawing;
    owed = !is_drawn ? kOwedDrawing : plan.is_refused ? kOwedBirths : 0;
    plan.lets_go = !plan.is_torn && state.bodies.has_pins[plan.body] && !planning.fragments.has_pins[plan.largest];
    bool is_broken = plan.lets_go || plan.is_reshaped;
    for (const Row<Fragments> row : plan.fragments) is_broken = is_broken || leaves(planning.fragments, row);
    if (is_broken) return true;
    const bool is_new = plan.task.exists();
    state.hull_points.pool.give_back(plan.points.first, plan.points.capacity);
    if (is_drawn && (is_new || !was_drawn)) planning.changed.push({plan.body, plan.keeps_mesh});
    stay_whole(planning, plan);
    return false;
}

bool has_room_to_redraw(Planning& planning, Row<Bodies> body, Row<Structures> structure, uint32_t part) {
    auto& state = planning.state;
    if (state.bodies.is_owed_births[body] == kOwedDrawing || state.bodies.model_mesh[body].exists()) return false;
    const Range &vertices = state.bodies.view_vertices[body], &indices = state.bodies.view_indices[body];
    return planning.calls(structure).rows_to_redraw(state, body, structure, part) <=
           std::min(vertices.capacity, indices.capacity);
}

void keep_cuts(Blows& blows, Row<Tasks> task) {
    for (uint32_t b = 0; b < blows.size() && task.exists(); ++b)
        if (blows.task[b] == task.index && is_kind(blows, b, BlowKind::Cut)) blows.goes_on[b] = 1;
}

}  // namespace cullet
