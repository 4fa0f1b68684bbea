#include "components/body_id.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"

namespace cullet {

void widen_regions(Serial, Owner own, BodyRows& rows, Events<TaskOpened>& opened, Events<RefusedEvent>& refused) {
    for (uint32_t t = 0; t < rows.region_rests.size(); ++t) {
        const Row<Tasks> task(t);
        if (static_cast<TaskState>(rows.tasks.state[t]) != TaskState::Running || rows.model_of(t) != own.number)
            continue;
        if (!is_hidden_region(rows, t)) continue;
        if (!rows.region_rests.wants_more[t]) continue;
        release_shell(rows, rows.tasks.working[t]);
        rows.tasks.working[t] = {};
        rows.hidden_runs.cut_elements[t] = 0;
        const char* full = nullptr;
        if (give_hidden_rows(rows, task, 2 * rows.region_rests.most_vertices[t], &full)) {
            opened.push({task, rows.model_of(task)});
        } else {
            rows.tasks.state[t] = static_cast<uint8_t>(TaskState::Dropped);
            refused.push(refused_event(rows.bodies, rows.tasks.body[t], full));
        }
    }
}

}  // namespace cullet
