#include "systems/births/choose_births.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "systems/births/fragment_motions.hpp"
#include "systems/births/reserve_births.hpp"

namespace cullet {
namespace {

void put_in_order(Fragments& f, Break& plan) {
    Row<Fragments>* const order = f.order.data() + plan.fragments.first;
    for (const Row<Fragments> row : plan.fragments) f.order[row] = row;
    std::sort(order, order + plan.fragments.count, [&](Row<Fragments> a, Row<Fragments> b) {
        if (plan.is_torn && f.has_pins[a] != f.has_pins[b]) return f.has_pins[a] != 0;
        return f.mass[a] != f.mass[b] ? f.mass[a] > f.mass[b] : a < b;
    });
    plan.largest = order[0];
}

bool is_small(const Planning& planning, const Break& plan, Row<Fragments> row) {
    const Fragments& f = planning.fragments;
    const double least_mass = planning.settings.debris_share * planning.state.structures.intact_mass[plan.broken];
    return !f.has_pins[row] && (f.mass[row] < least_mass || f.element_count[row] < planning.settings.debris_elements);
}

void choose_debris(Planning& planning, Break& plan, Row<Fragments> row) {
    if (planning.debris_left == 0) return stay(planning, plan, row, "limits.debris");
    --planning.debris_left;
    planning.fragments.is_debris[row] = 1;
}

void choose_body(Planning& planning, Break& plan, Row<Fragments> row) {
    const char* full = full_of_births(planning);
    Row<Bodies>& child = planning.fragments.child[row];
    if (!full) child = reserve_body(planning, plan, row, &full);
    if (child.exists())
        count_births(planning, 1, 0);
    else
        stay(planning, plan, row, full);
}

}  // namespace

void choose_births(Planning& planning, Break& plan) {
    put_in_order(planning.fragments, plan);
    for (uint32_t i = 1; i < plan.fragments.count; ++i) {
        const Row<Fragments> row = plan.in_order(planning.fragments, i);
        if (is_small(planning, plan, row))
            choose_debris(planning, plan, row);
        else
            choose_body(planning, plan, row);
    }
}

void stay(Planning& planning, Break& plan, Row<Fragments> fragment, const char* setting) {
    settle(planning, plan);
    auto& state = planning.state;
    Fragments& f = planning.fragments;
    const StructureCalls& calls = planning.calls(plan);
    planning.refused.push(refused_event(state.bodies, plan.body, setting));
    if (!plan.is_torn) {
        if (plan.task.exists() && !plan.is_refused) calls.forget_waiting(state, plan.broken);
        if (!f.has_pins[fragment]) calls.keep_waiting(state, plan, f, fragment);
    }
    plan.is_refused = true;
    join_motions(f, plan.largest, fragment);
    calls.join(state, plan, f, fragment);
}

}  // namespace cullet
