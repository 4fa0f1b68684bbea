#include <algorithm>

#include "systems/damage/thresholds.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

bool is_fragile(const Bodies& bodies, const Shells& shells, const DamageSettings& settings, uint32_t b) {
    const Row<Shells> shell = bodies.shell[b];
    return shell.exists() && bodies.is_breakable[b] && may_break_again(shells, shell, settings);
}

// Whoever strikes the body in its open task goes on striking the same blow.
bool is_striking(const Tasks& tasks, const TaskContacts& contacts, uint32_t task, Row<Bodies> striker) {
    for (uint32_t c = tasks.first_contact[task]; c < tasks.first_contact[task] + tasks.contact_count[task]; ++c)
        if (contacts.striker[c] == striker) return true;
    return false;
}

}  // namespace

// The approach speed leaves out this step's gravity, so a body at rest on another never opens a task.
void predict_impacts(Serial, Step step, const RigidWorld& rigid, const Bodies& bodies, const Shells& shells,
                     const Tasks& tasks, const TaskContacts& contacts, const DamageSettings& settings,
                     Events<Impact>& impacts) {
    impacts.clear();
    for (const RigidContact& c : rigid.contacts()) {
        for (int side = 0; side < 2; ++side) {
            const Row<Bodies> body(side == 0 ? c.a : c.b), striker(side == 0 ? c.b : c.a);
            if (!is_fragile(bodies, shells, settings, body)) continue;
            if (c.approach_speed <= wake_speed(shells, bodies.shell[body], bodies.strength_scale[body])) continue;
            if (bodies.hold_count[striker]) continue;  // stands still: no blow
            if (const uint32_t task = bodies.task[body]; task != kNone) {
                if (is_striking(tasks, contacts, task, striker)) continue;
            } else if (bodies.hold_count[body] || step.frame < bodies.retry_frame[body]) {
                continue;
            }
            impacts.push({body, striker, c.point, side == 0 ? c.normal : -c.normal, c.approach_speed});
        }
    }
    const auto all = impacts.all();
    std::sort(all.begin(), all.end(), [](const Impact& a, const Impact& b) {
        if (a.body.index != b.body.index) return a.body.index < b.body.index;
        if (a.approach_speed != b.approach_speed) return a.approach_speed > b.approach_speed;
        if (a.striker.index != b.striker.index) return a.striker.index < b.striker.index;
        if (a.point.x != b.point.x) return a.point.x < b.point.x;
        if (a.point.y != b.point.y) return a.point.y < b.point.y;
        return a.point.z < b.point.z;
    });
}

}  // namespace cullet
