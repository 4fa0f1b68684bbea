// A body goes, with the hits on it.
#include "systems/api/remove_body.hpp"

#include "components/body_id.hpp"
#include "engine/host_scope.hpp"
#include "systems/api/checks.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/tasks/take_out.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

void remove_body(WorldData& d, Row<Bodies> body) {
    State& state = d.state;
    take_out(state, {state.queued_hits, state.blows}, *d.rigid, *d.damage_models, body);
    d.query_index->touch(state.bodies, body);
}

Result<void> World::remove(BodyId id) {
    WorldData& d = contents_->data;
    const Row<Bodies> body = body_row(d.state.bodies, id);
    if (!body.exists()) return stale("body", id.index);
    const HostScope call(contents_->host);
    if (contents_->recorder) contents_->recorder->remove(id);
    remove_body(d, body);
    return {};
}

}  // namespace cullet
