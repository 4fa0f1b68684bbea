// The game has seen enough of the oldest fragments.
#include <cmath>

#include "components/body_id.hpp"
#include "engine/host_scope.hpp"
#include "systems/api/checks.hpp"
#include "systems/api/cost.hpp"
#include "systems/api/remove_body.hpp"
#include "systems/bodies/rigid_shape.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/models.hpp"
#include "systems/tasks/take_out.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

Result<void> check(const RetireSettings& settings) {
    if (settings.how > Retirement::Merge)
        return Error{"retire: how is " + std::to_string(static_cast<int>(settings.how)) +
                     "; use Remove, Freeze or Merge."};
    if (!(settings.least_seconds >= 0 && settings.least_seconds <= 1e9f))
        return Error{"retire: least_seconds is " + std::to_string(settings.least_seconds) + "; use 0 to 1e9."};
    return {};
}

// A hit is being worked off on it, or it is the striker of one.
bool is_in_a_hit(const State& state, Row<Bodies> body) {
    if (state.bodies.task[body] != kNone || state.bodies.hold_count[body]) return true;
    for (uint32_t t = 0; t < state.tasks.size(); ++t) {
        if (static_cast<TaskState>(state.tasks.state[t]) == TaskState::Free) continue;
        const uint32_t first = state.tasks.first_contact[t];
        for (uint32_t c = first; c < first + state.tasks.contact_count[t]; ++c)
            if (state.task_contacts.striker[c] == body) return true;
    }
    return false;
}

// Its shape is still to change.
bool is_changing(const DamageModels& models, const State& state, Row<Bodies> body) {
    return state.bodies.is_owed_births[body] || models.is_moving(state, body);
}

// Scenery is its drawn mesh: the rows that it was made of serve others.
void give_back_rows(State& state, Row<Structures> structure) {
    if (state.structures.users[structure] > 1) return;
    calls_of(state.structures, structure).empty(state, structure);
}

void stand_still(WorldData& d, Row<Bodies> body, BodyKind kind) {
    Bodies& bodies = d.state.bodies;
    drop_hits({d.state.queued_hits, d.state.blows}, body);
    d.damage_models->release(d.state, body);
    if (kind == BodyKind::Scenery) d.rigid->remove(body);
    bodies.kind[body] = static_cast<uint8_t>(kind);
    bodies.is_breakable[body] = 0;
    bodies.is_asleep[body] = 0;
    bodies.velocity.set(body, {});
    bodies.spin.set(body, {});
    d.state.fragment_ages.born[body] = 0;
    if (kind == BodyKind::Scenery) give_back_rows(d.state, bodies.structure[body]);
    if (kind == BodyKind::Static) {
        d.arena.reset();
        d.rigid->replace(body, describe_rigid(d.state.bodies, d.state.structures, body,
                                              convex_pieces(d.state, bodies.structure[body], d.arena)));
    }
    d.query_index->touch(bodies, body);
}

}  // namespace

Result<uint32_t> World::retire(const RetireSettings& settings) {
    const HostScope call(contents_->host);
    if (const Result<void> valid = check(settings); !valid) return Error{valid.error()};
    if (contents_->recorder) contents_->recorder->retire(settings);
    WorldData& d = contents_->data;
    const auto least_frames = static_cast<uint64_t>(std::ceil(settings.least_seconds / d.step_info.dt));
    const bool is_removed = settings.how == Retirement::Remove;
    uint32_t count = 0;
    for (const Row<Bodies> body : fragments_by_age(d.state)) {
        const bool is_old = d.step_info.frame - d.state.fragment_ages.born[body] >= least_frames;
        if (count == settings.count || !is_old) break;
        if (settings.only_asleep && !d.state.bodies.is_asleep[body]) continue;
        if (is_in_a_hit(d.state, body) || (!is_removed && is_changing(*d.damage_models, d.state, body))) continue;
        if (is_removed)
            remove_body(d, body);
        else
            stand_still(d, body, settings.how == Retirement::Freeze ? BodyKind::Static : BodyKind::Scenery);
        ++count;
    }
    d.counts.retired += count;
    return count;
}

}  // namespace cullet
