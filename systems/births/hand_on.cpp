#include "systems/births/hand_on.hpp"

#include "components/body_id.hpp"

namespace cullet {
namespace {

// A push goes to the piece that owns the nearest vertex; debris takes it along. False: the row is gone.
bool hand_on_push(Planning& planning, const Break& plan, uint32_t row) {
    Blows& blows = planning.blows;
    const Fragments& f = planning.fragments;
    const Row<Fragments> owner = planning.calls(plan).nearest(planning.state, plan, blows.point[row]);
    if (f.is_debris[owner]) {
        remove_blow(blows, row);
        return false;
    }
    if (f.child[owner].exists()) blows.body[row] = f.child[owner];
    return true;
}

// What the body got, by mass: events tell the energy by it.
void share_impulse(Blows& blows, uint32_t row, double share) {
    blows.impulse.set(row, share * blows.impulse[row]);
    blows.turning.set(row, share * blows.turning[row]);
}

}  // namespace

void hand_on_blows(Planning& planning, const Break& plan) {
    const Bodies& bodies = planning.state.bodies;
    const Fragments& f = planning.fragments;
    Blows& blows = planning.blows;
    double mass = 0, left = 0;
    for (const Row<Fragments> row : plan.fragments) {
        mass += f.mass[row];
        if (leaves(f, row)) left += f.mass[row];
    }
    uint32_t end = blows.size();
    for (uint32_t b = 0; b < end; ++b) {
        if (blows.body[b] != plan.body || (blows.task[b] != kNone && !blows.goes_on[b])) continue;
        if (is_kind(blows, b, BlowKind::Push)) {
            if (!hand_on_push(planning, plan, b)) --b, --end;
            continue;
        }
        for (uint32_t i = 0; i < plan.fragments.count; ++i) {
            const Row<Fragments> piece = plan.in_order(f, i);
            if (!f.child[piece].exists()) continue;
            const uint32_t made = blows.append(1);
            if (made == kNone) {
                planning.refused.push(refused_event(bodies, plan.body, "limits.queued_hits"));
                break;
            }
            blows.copy_rows(blows, b, made, 1);
            blows.body[made] = f.child[piece];
            blows.task[made] = kNone;
            blows.goes_on[made] = 0;
            blows.is_paid[made] = 1;
            share_impulse(blows, made, f.mass[piece] / mass);
        }
        share_impulse(blows, b, (mass - left) / mass);
    }
}

void hand_on_hits(Planning& planning, const Break& plan) {
    const Fragments& f = planning.fragments;
    QueuedHits& queued = planning.queued;
    for (uint32_t q = 0; q < queued.size(); ++q) {
        if (!queued.is_used[q] || queued.body[q] != plan.body) continue;
        const Row<Fragments> owner = planning.calls(plan).nearest(planning.state, plan, queued.point[q]);
        // What pressed on the whole is weighed anew on its parts.
        if (f.is_debris[owner] || queued.load[q] > 0)
            queued.clear_rows(q, 1);
        else if (f.child[owner].exists())
            queued.body[q] = f.child[owner];
    }
}

}  // namespace cullet
