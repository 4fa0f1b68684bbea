// Models come into a world and go.
#include "systems/models.hpp"
#include "engine/host_scope.hpp"
#include "systems/api/checks.hpp"
#include "systems/api/model_row.hpp"
#include "systems/bodies/model_mesh.hpp"
#include "systems/cook/materials.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/structure_calls.hpp"
#include "systems/tasks/hold_units.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

Result<ModelId> World::add_model(const Model& model) {
    if (!model.contents) return Error{"the model is empty; cook or read one first."};
    State& state = contents_->data.state;
    const HostScope call(contents_->host);
    if (contents_->recorder) contents_->recorder->add_model(model);
    const DamageModels& models = *contents_->data.damage_models;
    const std::optional<uint8_t> breaks = models.find(model.contents->damage_model);
    if (!breaks)
        return Error{model.contents->name + ": is cooked for the damage model " + model.contents->damage_model +
                     "; this world has " + models.names() + "."};
    uint32_t row = 0;
    while (row < state.models.size() && state.models.is_used[row]) ++row;
    if (row == state.models.size() && state.models.append(1) == kNone)
        return Error{"limits.models is reached (" + std::to_string(state.models.limit()) +
                     "); raise it or remove a model."};
    const Workbench& cooked = model.contents->state;
    const Row<Materials> own = cooked.structures.material[model.contents->shell];
    const Row<Materials> material = material_row({state.materials, state.material_traits, state.structures},
                                                 material_settings(cooked, own), material_traits(cooked, own).grain);
    if (!material.exists())
        return Error{model.contents->name + ": the world holds " + std::to_string(kMostMaterials) +
                     " materials already; remove models and bodies of one of them."};
    const char* full = "";
    const StructureCalls& calls = calls_of(cooked.structures, model.contents->shell);
    const Row<Structures> structure = calls.import(state, cooked, model.contents->shell, &full);
    if (!structure.exists()) return Error{model.contents->name + ": no room for the model; raise " + full + "."};
    state.structures.material[structure] = material;
    state.structures.damage_model[structure] = *breaks;
    state.models.is_used[row] = 1;
    state.models.structure[row] = structure;
    state.models.mesh[row] = {};
    const DamageSettings& damage = contents_->data.damage_settings;
    contents_->log.advise(contents_->host, *model.contents,
                          hold_units(damage.units_a_frame, damage.hold_seconds, contents_->data.step_info.dt));
    const uint32_t generation = ++state.models.generation[row];
    return ModelId{row, generation};
}

Row<Models> model_row(const Models& models, ModelId id) {
    const bool is_alive = id.generation != 0 && id.index < models.size() && models.is_used[id.index] &&
                          models.generation[id.index] == id.generation;
    return is_alive ? Row<Models>(id.index) : Row<Models>();
}

Result<void> World::remove_model(ModelId id) {
    State& state = contents_->data.state;
    const Row<Models> model = model_row(state.models, id);
    if (!model.exists()) return stale("model", id.index);
    const HostScope call(contents_->host);
    if (contents_->recorder) contents_->recorder->remove_model(id);
    const Row<Structures> structure = state.models.structure[model];
    calls_of(state.structures, structure).release(state, structure);
    if (const Row<ModelMeshes> mesh = state.models.mesh[model]; mesh.exists()) release_model_mesh(state, mesh);
    state.models.mesh[model] = {};
    state.models.is_used[model] = 0;
    return {};
}

}  // namespace cullet
