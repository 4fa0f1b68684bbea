#include "systems/births/make_break.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "systems/births/limit_energy.hpp"
#include "systems/births/make_pieces.hpp"
#include "systems/births/part_siblings.hpp"
#include "systems/births/strike_back.hpp"
#include "systems/bodies/blows.hpp"

namespace cullet {
namespace {

// What was pushed in lies higher, or turns faster: by the work of the dent, which its contact took in the step before.
void book_dent(Births& births, Row<Bodies> body, Vec3 middle_before, double energy_before) {
    const Bodies& bodies = births.state.bodies;
    const double lifted =
        -bodies.mass[body] * double{dot(births.step.gravity, centre_of(bodies, body) - middle_before)};
    births.counts.work_from_outside += std::max(0.0, lifted + rigid_energy(bodies, body) - energy_before);
}

// Nothing struck: pieces go as they were planned.
void make_without_task(Births& births, const Break& plan) {
    auto& state = births.state;
    const double allowed = rigid_energy(state.bodies, plan.body) + plan.waited;
    const Vec3 middle = centre_of(state.bodies, plan.body);
    const double moving = rigid_energy(state.bodies, plan.body);
    make_pieces(births, plan, {pose_of(state.bodies, plan.body), {}, {}, {}, false});
    if (plan.is_reshaped) book_dent(births, plan.body, middle, moving);
    if (plan.is_torn) return births.models.keep_torn(state, births.rigid, plan.body);
    const double goes_on_waiting = births.calls(plan.broken).waiting_energy(state, plan.body);
    if (plan.waited > 0) limit_energy(births, plan, allowed - goes_on_waiting);
}

// What settling the motions did.
void count_settled(const Fragments& f, const Break& plan, DamageCounts& counts) {
    for (const Row<Fragments> row : plan.fragments) {
        counts.clamped += f.is_speed_clamped[row];
        counts.clamped += f.is_spin_clamped[row];
        counts.crushing_energy += f.crushed_energy[row];
    }
}

}  // namespace

void make_break(Births& births, const Break& plan) {
    auto& state = births.state;
    if (plan.is_torn) births.models.give_torn(state, plan, births.fragments);
    if (!plan.task.exists()) return make_without_task(births, plan);
    count_settled(births.fragments, plan, births.counts);
    const Moment moment = moment_of(state, births.fragments, plan);
    // Late, the rigid solver has passed the blow's impulse, and what it took by it comes back; an explosion's energy
    // comes from outside.
    const bool comes_from_outside = has_explosion(births.blows, plan.task);
    const double before = rigid_energy(state.bodies, plan.body);
    const double allowed =
        moment.is_late ? before + owed_to_late(state, plan.task) : strike_back(births, plan, moment.pose);
    make_pieces(births, plan, moment);
    if (moment.is_late || !comes_from_outside) limit_energy(births, plan, allowed);
    if (!moment.is_late && !comes_from_outside) share_with_strikers(births, plan, allowed);
    double energy = pieces_energy(state.bodies, births.debris, births.fragments, plan);
    if (plan.is_refused) {
        const StructureCalls& calls = births.calls(plan.broken);
        energy += comes_from_outside ? calls.waiting_energy(state, plan.body)
                                     : calls.limit_waiting(state, plan.body, std::max(0.0, allowed - energy));
    }
    if (moment.is_late || comes_from_outside)
        births.counts.work_from_outside += std::max(0.0, energy - (moment.is_late ? before : allowed));
    part_strikers(births, plan, moment.is_late);
}

}  // namespace cullet
