#include "systems/cook/mesh_of_view.hpp"

#include "engine/mesh_file.hpp"

namespace cullet {

Result<Mesh> mesh_of_view(const MeshView& view) {
    Mesh mesh;
    mesh.name = view.name ? view.name : "mesh";
    if (!view.positions || !view.indices || view.position_count == 0 || view.triangle_count == 0)
        return Error{mesh.name + ": has no triangles; give positions and indices."};
    mesh.positions.assign(view.positions, view.positions + view.position_count);
    mesh.triangles.resize(view.triangle_count);
    for (size_t t = 0; t < view.triangle_count; ++t)
        mesh.triangles[t] = {view.indices[3 * t], view.indices[3 * t + 1], view.indices[3 * t + 2]};
    if (view.corner_normals)
        mesh.corner_normals.assign(view.corner_normals, view.corner_normals + 3 * view.triangle_count);
    if (view.corner_uvs) mesh.corner_uvs.assign(view.corner_uvs, view.corner_uvs + 3 * view.triangle_count);
    if (view.materials) mesh.materials.assign(view.materials, view.materials + view.triangle_count);
    if (const Result<void> valid = validate_mesh(mesh, mesh.name); !valid) return Error{valid.error()};
    return mesh;
}

}  // namespace cullet
