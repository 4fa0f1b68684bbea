#include "systems/bodies/model_mesh.hpp"

namespace cullet {

Row<ModelMeshes> give_model_mesh(BodyRows& state, Row<Bodies> b) {
    Bodies& bodies = state.bodies;
    ModelMeshes& meshes = state.model_meshes;
    const uint32_t row = meshes.pool.take(1);
    if (row == kNone) return {};
    if (row >= meshes.size()) meshes.append(row + 1 - meshes.size());
    meshes.clear_rows(row, 1);
    const Row<ModelMeshes> mesh(row);
    meshes.users[mesh] = 1;
    meshes.vertices[mesh] = bodies.view_vertices[b];
    meshes.indices[mesh] = bodies.view_indices[b];
    meshes.run_indices[mesh] = bodies.run_indices[b];
    meshes.drawn_materials[mesh] = bodies.drawn_materials[b];
    meshes.drawn_box[mesh] = bodies.drawn_box[b];
    show_model_mesh(state, b, mesh);
    return mesh;
}

void show_model_mesh(BodyRows& state, Row<Bodies> b, Row<ModelMeshes> mesh) {
    Bodies& bodies = state.bodies;
    ModelMeshes& meshes = state.model_meshes;
    ++meshes.users[mesh];
    bodies.model_mesh[b] = mesh;
    bodies.view_vertices[b] = {meshes.vertices[mesh].first, meshes.vertices[mesh].count, 0};
    bodies.view_indices[b] = {meshes.indices[mesh].first, meshes.indices[mesh].count, 0};
    bodies.run_indices[b] = meshes.run_indices[mesh];
    bodies.drawn_materials[b] = meshes.drawn_materials[mesh];
    bodies.drawn_box[b] = meshes.drawn_box[mesh];
    bodies.redrawn[b] = {0, meshes.indices[mesh].count / 3};
    bodies.view_stamp[b] = 1;
}

void leave_model_mesh(BodyRows& state, Row<Bodies> b) {
    const Row<ModelMeshes> mesh = state.bodies.model_mesh[b];
    if (!mesh.exists()) return;
    state.bodies.model_mesh[b] = {};
    state.bodies.view_vertices[b] = state.bodies.view_indices[b] = {};
    release_model_mesh(state, mesh);
}

void release_model_mesh(BodyRows& state, Row<ModelMeshes> mesh) {
    ModelMeshes& meshes = state.model_meshes;
    if (--meshes.users[mesh] > 0) return;
    state.view_vertices.give_back(meshes.vertices[mesh]);
    state.view_indices.give_back(meshes.indices[mesh]);
    meshes.clear_rows(mesh, 1);
    meshes.pool.give_back(mesh, 1);
}

}  // namespace cullet
