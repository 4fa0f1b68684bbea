#include "perf/cook_vase.hpp"

#include "sample_game/meshes.hpp"

namespace cullet::perf {

Result<Model> cook_vase(float edge) {
    const Mesh mesh = make_vase(0.30f, edge);
    MeshView view;
    view.positions = mesh.positions.data(), view.position_count = mesh.positions.size();
    view.indices = mesh.triangles[0].data(), view.triangle_count = mesh.triangles.size();
    CookSettings settings;
    settings.longest_edge = 100;  // the mesh has the edges that it should have
    settings.measures_threshold = false;
    return cook(view, settings);
}

}  // namespace cullet::perf
