#include "systems/births/hand_on.hpp"

#include "components/body_id.hpp"

namespace cullet {
namespace {

uint32_t owner_of(const ShellView& shell, Vec3 point, uint32_t otherwise) {
    const ShellRows& state = shell.state;
    float least = 1e30f;
    uint32_t owner = otherwise;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v), element = state.vertices.element[row];
        if (element == kNone) continue;
        const Vec3 away = state.vertices.rest[row] - point;
        if (dot(away, away) >= least) continue;
        least = dot(away, away);
        owner = state.elements.part[shell.element(element)];
    }
    return owner;
}

// A push goes to the piece that owns the nearest vertex; a crumb takes it along. False: the row is gone.
bool hand_on_push(Planning& planning, const Break& plan, uint32_t row) {
    Blows& blows = planning.blows;
    const uint32_t owner = owner_of(ShellView(planning.state, plan.broken), blows.point[row], plan.largest);
    if (plan.is_crumb[owner]) {
        remove_blow(blows, row);
        return false;
    }
    if (plan.child[owner].exists()) blows.body[row] = plan.child[owner];
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
    Blows& blows = planning.blows;
    double mass = 0, left = 0;
    for (uint32_t p = 0; p < plan.parts.size(); ++p) {
        mass += plan.parts[p].mass;
        if (plan.leaves(p)) left += plan.parts[p].mass;
    }
    uint32_t end = blows.size();
    for (uint32_t b = 0; b < end; ++b) {
        if (blows.body[b] != plan.body || (blows.task[b] != kNone && !blows.goes_on[b])) continue;
        if (is_kind(blows, b, BlowKind::Push)) {
            if (!hand_on_push(planning, plan, b)) --b, --end;
            continue;
        }
        for (const uint32_t p : plan.order) {
            if (!plan.child[p].exists()) continue;
            const uint32_t made = blows.append(1);
            if (made == kNone) {
                planning.refused.push(refused_event(bodies, plan.body, "limits.queued_hits"));
                break;
            }
            blows.copy_rows(blows, b, made, 1);
            blows.body[made] = plan.child[p];
            blows.task[made] = kNone;
            blows.goes_on[made] = 0;
            blows.is_paid[made] = 1;
            share_impulse(blows, made, plan.parts[p].mass / mass);
        }
        share_impulse(blows, b, (mass - left) / mass);
    }
}

void hand_on_hits(Planning& planning, const Break& plan) {
    const ShellView shell(planning.state, plan.broken);
    QueuedHits& queued = planning.queued;
    for (uint32_t q = 0; q < queued.size(); ++q) {
        if (!queued.is_used[q] || queued.body[q] != plan.body) continue;
        const uint32_t owner = owner_of(shell, queued.point[q], plan.largest);
        // What pressed on the whole is weighed anew on its parts.
        if (plan.is_crumb[owner] || queued.load[q] > 0)
            queued.clear_rows(q, 1);
        else if (plan.child[owner].exists())
            queued.body[q] = plan.child[owner];
    }
}

}  // namespace cullet
