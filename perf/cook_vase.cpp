#include "perf/cook_vase.hpp"

#include "sample_game/meshes.hpp"
#include "systems/cook/materials.hpp"
#include "systems/cook/model_contents.hpp"

namespace cullet::perf {

Result<Model> cook_vase(float edge, float height, std::optional<FractureKind> fracture) {
    const Mesh mesh = make_vase(height, edge);
    MeshView view;
    view.positions = mesh.positions.data(), view.position_count = mesh.positions.size();
    view.indices = mesh.triangles[0].data(), view.triangle_count = mesh.triangles.size();
    CookSettings settings;
    settings.longest_edge = 100;  // the mesh has the edges that it should have
    settings.thick_shell.measures_threshold = false;
    settings.fracture = fracture;
    return cook(view, settings);
}

CookedVase::CookedVase(const Model& model)
    : state(cooking_limits(3 * model.contents->report.vertices, 3 * model.contents->report.elements)) {
    fill_materials(state.materials);
    const char* full = nullptr;
    shell = import_shell(state, model.contents->state, model.contents->shell, &full);
}

}  // namespace cullet::perf
