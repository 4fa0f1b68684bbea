#include "systems/api/cost.hpp"

#include <algorithm>

#include "components/body_id.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

std::vector<Row<Bodies>> fragments_by_age(const State& state) {
    const FragmentAges& ages = state.fragment_ages;
    std::vector<Row<Bodies>> rows;
    for (uint32_t b = 0; b < ages.size(); ++b)
        if (ages.born[b] > 0) rows.emplace_back(b);
    std::stable_sort(rows.begin(), rows.end(),
                     [&](Row<Bodies> a, Row<Bodies> b) { return ages.born[a] < ages.born[b]; });
    return rows;
}

// step_info.frame is the next step's number: a hit of the last step is one frame old.
void report_cost(const WorldData& d, StepReport& report) {
    const State& state = d.state;
    uint64_t oldest = d.step_info.frame;
    for (uint32_t b = 0; b < state.fragment_ages.size(); ++b) report.fragments += state.fragment_ages.born[b] > 0;
    for (uint32_t b = 0; b < state.bodies.size(); ++b) report.waiting_bodies += state.bodies.is_owed_births[b] > 0;
    for (uint32_t t = 0; t < state.tasks.size(); ++t)
        if (static_cast<TaskState>(state.tasks.state[t]) != TaskState::Free)
            oldest = std::min(oldest, state.tasks.opened_frame[t]);
    for (uint32_t q = 0; q < state.queued_hits.size(); ++q) {
        if (!state.queued_hits.is_used[q]) continue;
        ++report.waiting_hits;
        oldest = std::min(oldest, state.queued_hits.frame[q]);
    }
    for (uint32_t b = 0; b < state.blows.size(); ++b) report.waiting_hits += state.blows.task[b] == kNone;
    report.oldest_hit_frames = d.step_info.frame - oldest;
    report.retired = d.counts.retired;
    report.faded = d.counts.faded;
}

uint32_t World::fragments(FragmentAge* out, uint32_t capacity) const {
    const WorldData& d = contents_->data;
    const Bodies& bodies = d.state.bodies;
    const std::vector<Row<Bodies>> rows = fragments_by_age(d.state);
    for (uint32_t i = 0; i < rows.size() && i < capacity; ++i) {
        const Row<Bodies> b = rows[i];
        out[i] = {body_id(bodies, b), d.step_info.frame - d.state.fragment_ages.born[b], bodies.mass[b],
                  bodies.is_asleep[b] != 0};
    }
    return static_cast<uint32_t>(rows.size());
}

}  // namespace cullet
