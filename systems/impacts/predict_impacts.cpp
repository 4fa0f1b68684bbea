#include <algorithm>

#include "systems/impacts/fragile.hpp"
#include "systems/systems.hpp"

namespace cullet {
namespace {

// Whoever strikes the body in its open task goes on striking the same blow.
bool is_striking(const Tasks& tasks, const TaskContacts& contacts, uint32_t task, Row<Bodies> striker) {
    for (uint32_t c = tasks.first_contact[task]; c < tasks.first_contact[task] + tasks.contact_count[task]; ++c)
        if (contacts.striker[c] == striker) return true;
    return false;
}

}  // namespace

bool comes_first(const Impact& a, const Impact& b) {
    if (a.body.index != b.body.index) return a.body.index < b.body.index;
    if (a.approach_speed != b.approach_speed) return a.approach_speed > b.approach_speed;
    if (a.striker.index != b.striker.index) return a.striker.index < b.striker.index;
    if (a.point.x != b.point.x) return a.point.x < b.point.x;
    if (a.point.y != b.point.y) return a.point.y < b.point.y;
    return a.point.z < b.point.z;
}

// The approach speed leaves out this step's gravity, so a body at rest on another never opens a task.
void predict_impacts(Serial, Step step, const RigidWorld& rigid, const Bodies& bodies, const Structures& structures,
                     RunsNow runs, const DamageSettings& settings, Events<Impact>& impacts) {
    impacts.clear();
    for (const RigidContact& c : rigid.contacts()) {
        for (int side = 0; side < 2; ++side) {
            const Impact impact = impact_of(c, side);
            if (!is_blow(impact, bodies, structures, settings)) continue;
            const uint32_t task = bodies.task[impact.body];
            if (task != kNone && !is_ahead(runs.tasks, task)) {
                if (is_striking(runs.tasks, runs.contacts, task, impact.striker)) continue;
            } else if (bodies.hold_count[impact.body] || step.frame < bodies.retry_frame[impact.body]) {
                continue;
            }
            impacts.push(impact);
        }
    }
    const auto all = impacts.all();
    std::sort(all.begin(), all.end(), comes_first);
}

}  // namespace cullet
