#include "systems/births/order_births.hpp"

#include "systems/births/hand_on.hpp"

namespace cullet {

void order_births(Planning& planning, Break& plan) {
    Fragments& f = planning.fragments;
    for (const Row<Fragments> row : plan.fragments)
        if (leaves(f, row)) plan.left_elements += f.element_count[row];
    if (plan.is_rest_smaller(planning.state.structures) || plan.chooses_shape)
        planning.calls(plan).list_rest(planning.state, plan, f);
    hand_on_hits(planning, plan);
    hand_on_blows(planning, plan);
    const uint32_t of = planning.breaks.size();
    if (!plan.is_settled) planning.births.push({of, {}});
    for (uint32_t i = 0; i < plan.fragments.count; ++i) {
        const Row<Fragments> row = plan.in_order(f, i);
        if (row == plan.largest || leaves(f, row)) planning.births.push({of, row});
    }
    planning.breaks.push(plan);
}

}  // namespace cullet
