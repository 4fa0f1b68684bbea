// What a game draws of a body.
#include "components/body_id.hpp"
#include "systems/api/checks.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

Result<BodyView> World::view(BodyId id) const {
    const State& state = contents_->data.state;
    const Bodies& bodies = state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    BodyView view;
    view.pose = pose_of(bodies, body);
    view.pose_before = {bodies.previous_position[body], bodies.previous_orientation[body]};
    if (!bodies.structure[body].exists()) return view;
    view.vertices = state.view_vertices.vertex.data() + bodies.view_vertices[body].first;
    view.vertex_count = bodies.view_vertices[body].count;
    view.indices = state.view_indices.index.data() + bodies.view_indices[body].first;
    view.index_count = bodies.view_indices[body].count;
    uint32_t first = 0;
    for (size_t run = 0; run < kMostRuns; ++run) {
        const uint32_t count = bodies.run_indices[body][run];
        const auto kind = static_cast<SurfaceKind>(run / kMostDrawnMaterials);
        const uint16_t material = bodies.drawn_materials[body][run % kMostDrawnMaterials];
        if (count > 0) view.runs[view.run_count++] = {kind, material, first, count};
        first += count;
    }
    if (const Row<Models> model = bodies.model[body];  // it may have gone
        bodies.model_mesh[body].exists() && state.models.mesh[model] == bodies.model_mesh[body])
        view.model = {model.index, state.models.generation[model]};
    view.stamp = bodies.view_stamp[body];
    // step_info.frame is the next step's number.
    if (bodies.drawn_frame[body] + 1 >= contents_->data.step_info.frame) {
        const auto [begin, end] = bodies.redrawn[body];
        view.dirty_vertices = view.dirty_indices = {3 * begin, 3 * (end - begin)};
    }
    return view;
}

}  // namespace cullet
