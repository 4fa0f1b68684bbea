#include <algorithm>

#include "components/body_id.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/soft/systems.hpp"

namespace cullet {
namespace {

// A brittle body that works off a hit of this one takes it for rigid.
bool is_striking(const Tasks& tasks, const TaskContacts& contacts, Row<Bodies> body) {
    for (uint32_t t = 0; t < tasks.size(); ++t) {
        if (static_cast<TaskState>(tasks.state[t]) != TaskState::Running || tasks.is_late[t] || is_ahead(tasks, t))
            continue;
        for (uint32_t c = tasks.first_contact[t]; c < tasks.first_contact[t] + tasks.contact_count[t]; ++c)
            if (contacts.striker[c] == body) return true;
    }
    return false;
}

bool moves(const Bodies& bodies, uint32_t b) {
    const auto kind = static_cast<BodyKind>(bodies.kind[b]);
    return kind == BodyKind::Dynamic || kind == BodyKind::Kinematic;
}

/// What the contacts of this step say about one body that is not awake.
struct Touches {
    float fastest = 0;
    uint32_t met = 0;     // partners of its frozen self that still touch it, a bit each
    bool is_new = false;  // something that moves touches it that is no partner
};

Touches touches_of(const SoftRows& state, const RigidWorld& rigid, uint32_t s) {
    const SoftBodies& soft = state.soft_bodies;
    const uint32_t body = soft.body[s];
    Touches touches;
    for (const RigidContact& c : rigid.contacts()) {
        if (c.a != body && c.b != body) continue;
        const uint32_t other = c.a == body ? c.b : c.a;
        if (!state.bodies.hold_count[other]) touches.fastest = std::max(touches.fastest, c.approach_speed);
        bool is_partner = false;
        for (uint32_t p = 0; p < soft.partner_count[s]; ++p) {
            if (soft.partners[s][p] != other) continue;
            is_partner = true;
            touches.met |= 1u << p;
        }
        touches.is_new = touches.is_new || (!is_partner && moves(state.bodies, other));
    }
    return touches;
}

// What is held by pins bears loads: when one comes or goes, its shape is not that of rest any more.
bool wakes(const SoftRows& state, const RigidWorld& rigid, uint32_t s) {
    const SoftBodies& soft = state.soft_bodies;
    if (soft.is_called[s]) return true;
    const Touches touches = touches_of(state, rigid, s);
    if (touches.fastest > soft.wake_speed[s]) return true;
    const bool is_hung = soft.is_elastic[s] && state.bodies.has_pins[soft.body[s]];
    return is_hung && (touches.is_new || touches.met != (1u << soft.partner_count[s]) - 1);
}

}  // namespace

void freeze_soft_bodies(Serial, SoftRows& rows, RigidWorld& rigid, Arena& arena) {
    for (uint32_t s = 0; s < rows.soft_bodies.size(); ++s)
        if (rows.soft_bodies.is_used[s] && rows.soft_bodies.is_awake[s] &&
            rows.soft_bodies.quiet_seconds[s] >= kQuietSeconds)
            freeze_soft(rows, rigid, Row<SoftBodies>(s), arena);
}

void wake_soft_bodies(Serial, SoftRows& rows, RigidWorld& rigid) {
    if (!rigid.knows_surfaces()) return;
    for (uint32_t s = 0; s < rows.soft_bodies.size(); ++s) {
        if (!rows.soft_bodies.is_used[s] || rows.soft_bodies.is_awake[s]) continue;
        const Row<Bodies> body = rows.soft_bodies.body[s];
        if (rows.bodies.hold_count[body] || !wakes(rows, rigid, s)) continue;
        if (is_striking(rows.tasks, rows.task_contacts, body)) continue;
        wake_soft(rows, rigid, Row<SoftBodies>(s));
    }
}

}  // namespace cullet
