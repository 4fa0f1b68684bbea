#include "systems/world_data.hpp"

#include <algorithm>

#include "components/commit_ahead.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/models.hpp"
#include "systems/tasks/run_loops.hpp"

namespace cullet {
namespace {

Limits limits_of(const LimitSettings& l) {
    Limits limits;
    limits.bodies = l.bodies;
    limits.structures = l.bodies + l.models + 2 * l.open_hits;
    limits.vertices = l.vertices;
    limits.elements = l.elements;
    limits.tasks = l.open_hits;
    limits.models = l.models;
    limits.view_vertices = l.view_vertices;
    limits.debris = l.debris;
    limits.queued_hits = l.queued_hits;
    return limits;
}

constexpr size_t kArenaBytes = size_t{64} << 20;

}  // namespace

WorldData::WorldData(const Settings& settings)
    : state(limits_of(settings.limits)),
      view_boxes(state.view_indices.limit() / kViewGranule + 1),
      query_index(std::make_unique<QueryIndex>(settings.limits.bodies)),
      arena(kArenaBytes),
      between(queues_between(settings.limits, state)),
      told(queues_told(settings.limits, state)) {
    step_info.dt = settings.step_seconds;
    step_info.gravity = settings.gravity;
    damage_settings.units_a_frame = settings.units_a_frame;
    damage_settings.hold_seconds = settings.hold_seconds;
    damage_settings.frames_ahead = settings.frames_ahead;
    damage_settings.generations = settings.generations;
    damage_settings.break_share = settings.break_share;
    damage_settings.break_elements = settings.break_elements;
    damage_settings.debris_share = settings.debris_share;
    damage_settings.debris_elements = settings.debris_elements;
    damage_settings.debris_seconds = settings.debris_seconds;
    damage_settings.fragments = settings.limits.fragments;
    damage_settings.births_a_frame = settings.limits.births_a_frame;
}

WorldData::~WorldData() = default;

void WorldData::make_ready(const ShellRoom& shell) {
    for (auto rows : {&ShellRoom::vertices, &ShellRoom::elements, &ShellRoom::hinges, &ShellRoom::blocks,
                      &ShellRoom::links, &ShellRoom::cells})
        ready_for.*rows = std::max(ready_for.*rows, shell.*rows);
    commit_ahead(state, ready_for);
    state.fragments.commit_rows(kMostParts);
    state.touches.commit_rows(kMostParts);
}

}  // namespace cullet
