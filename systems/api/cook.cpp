// A stranger's mesh is looked at, cleaned and cut finer; the damage model does the rest.
#include <algorithm>
#include <new>

#include "engine/host_scope.hpp"
#include "engine/memory.hpp"
#include "engine/mesh_file.hpp"
#include "systems/api/with_models.hpp"
#include "systems/cook/clean_mesh.hpp"
#include "systems/cook/crease_normals.hpp"
#include "systems/cook/materials.hpp"
#include "systems/cook/mesh_of_view.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/cook/tessellate.hpp"
#include "systems/settings/check.hpp"

namespace cullet {
namespace {

constexpr double kEdgeShare = 0.025;  // of the diagonal, where neither game nor model says how long edges may be

Result<CookedMaterial> material_of(const CookSettings& settings) {
    static const MaterialTable compiled;
    Result<MaterialSettings> found = (settings.materials ? *settings.materials : compiled).find(settings.material);
    if (!found) return Error{found.error()};
    if (settings.fracture) found->fracture = *settings.fracture;
    if (const Result<void> valid = check_material(*found); !valid) return Error{valid.error()};
    if (found->across_young_modulus == 0) return CookedMaterial{*found, {}};
    const Vec3d grain(settings.grain);
    const double squared = dot(grain, grain);
    if (!(squared > 1e-30 && squared < 1e30))
        return Error{"grain is (" + std::to_string(grain.x) + ", " + std::to_string(grain.y) + ", " +
                     std::to_string(grain.z) + "); give a direction along the fibres of " + settings.material + "."};
    return CookedMaterial{*found, ((1 / std::sqrt(squared)) * grain).to_float()};
}

double diagonal_of(const Mesh& mesh) {
    Vec3d low(mesh.positions[0]), high = low;
    for (const Vec3 p : mesh.positions) {
        low = {std::min<double>(low.x, p.x), std::min<double>(low.y, p.y), std::min<double>(low.z, p.z)};
        high = {std::max<double>(high.x, p.x), std::max<double>(high.y, p.y), std::max<double>(high.z, p.z)};
    }
    return length(high - low);
}

// Some triangle is more than a line: area above 1e-12 of the diagonal squared, as in prepare_surface.
bool has_area(const Mesh& mesh, double diagonal) {
    for (const auto& triangle : mesh.triangles) {
        const Vec3d a(mesh.positions[triangle[0]]), b(mesh.positions[triangle[1]]), c(mesh.positions[triangle[2]]);
        if (0.5 * length(cross(b - a, c - a)) > 1e-12 * diagonal * diagonal) return true;
    }
    return false;
}

// Cutting edges multiplies what is named twice, and so does its cost: 466 times the same triangle became a million.
void drop_triangles(Mesh& mesh, std::span<const uint32_t> dropped) {
    if (dropped.empty()) return;
    size_t kept = 0, next = 0;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (next < dropped.size() && dropped[next] == t) {
            ++next;
            continue;
        }
        mesh.triangles[kept] = mesh.triangles[t];
        for (size_t k = 0; k < 3; ++k) {
            if (!mesh.corner_normals.empty())
                mesh.corner_normals[3 * kept + k] = mesh.corner_normals[3 * size_t{t} + k];
            if (!mesh.corner_uvs.empty()) mesh.corner_uvs[3 * kept + k] = mesh.corner_uvs[3 * size_t{t} + k];
        }
        if (!mesh.materials.empty()) mesh.materials[kept] = mesh.materials[t];
        ++kept;
    }
    mesh.triangles.resize(kept);
    if (!mesh.corner_normals.empty()) mesh.corner_normals.resize(3 * kept);
    if (!mesh.corner_uvs.empty()) mesh.corner_uvs.resize(3 * kept);
    if (!mesh.materials.empty()) mesh.materials.resize(kept);
}

Result<const DamageModel*> model_of(const DamageModels& models, const CookSettings& settings,
                                    const MaterialSettings& material) {
    const std::string& wanted = settings.model.empty() ? material.model : settings.model;
    const std::optional<uint8_t> number = wanted.empty() ? uint8_t{0} : models.find(wanted);
    if (!number)
        return Error{(settings.model.empty() ? "material \"" + settings.material + "\": " : "") + "model is \"" +
                     wanted + "\"; use one of " + models.names() + "."};
    const DamageModel& model = models[*number];
    if (!model.calls().cook) return Error{"model is \"" + model.name() + "\", which cooks nothing."};
    return &model;
}

Result<void> check_lengths(const CookSettings& settings, double diagonal) {
    if (!(settings.thickness > 0 && settings.thickness < diagonal))
        return Error{"thickness " + std::to_string(settings.thickness) + " m is not between 0 and the diagonal, " +
                     std::to_string(diagonal) + " m; give the wall's thickness in metres."};
    if (!(settings.longest_edge >= 0))
        return Error{"longest_edge is " + std::to_string(settings.longest_edge) +
                     " m; give metres, or 0 for what suits the thickness."};
    if (!(settings.weld_tolerance >= 0 && settings.weld_tolerance <= 0.01f))
        return Error{"weld_tolerance is " + std::to_string(settings.weld_tolerance) +
                     " of the diagonal; give 0 to 0.01, or 1e-7 for a soup with noise."};
    return {};
}

/// Repairs the mesh, and says what was wrong with it. Counted on the mesh as it was given: a triangle that is flipped
/// is one, however often it is cut later.
Result<SurfaceRepairs> clean(Cooking& cooking) {
    const Result<Surface> given = prepare_surface(cooking.mesh, cooking.welding);
    if (!given) return Error{given.error()};
    if (const uint32_t parts = given->repairs.unorientable_components; parts > 0)
        return Error{std::to_string(parts) + (parts == 1 ? " part is" : " parts are") +
                     " one-sided, like a Moebius strip, so nothing is inside. Cut each along a line, or remove it."};
    cooking.has_made_normals = cooking.mesh.corner_normals.empty();
    if (cooking.has_made_normals) give_crease_normals(cooking.mesh, given.value());
    SurfaceRepairs unused;
    const Result<CleanMesh> cleaned = clean_mesh(cooking.mesh, cooking.welding, unused);
    if (!cleaned) return Error{cleaned.error()};
    drop_triangles(cooking.mesh, cleaned->repeated);
    return given->repairs;
}

Result<void> split_long_edges(Cooking& cooking, double diagonal, const DamageModel& model) {
    const CookSettings& settings = cooking.settings;
    const double share =
        model.calls().edge_share ? static_cast<double>(model.calls().edge_share(settings)) : kEdgeShare;
    TessellationSettings tessellation;
    tessellation.longest_edge =
        settings.longest_edge > 0 ? settings.longest_edge : std::max(2.0 * settings.thickness, share * diagonal);
    Result<Mesh> fine = tessellate(cooking.mesh, tessellation);
    if (!fine) return Error{fine.error()};
    if (fine->triangles.size() >= 2 * cooking.mesh.triangles.size()) cooking.longest_edge = tessellation.longest_edge;
    cooking.fine = std::move(*fine);
    return {};
}

Result<Model> cook_mesh(const DamageModels& models, Mesh mesh, const CookSettings& settings) {
    const Result<CookedMaterial> material = material_of(settings);
    if (!material) return Error{material.error()};
    const Result<const DamageModel*> model = model_of(models, settings, material->settings);
    if (!model) return Error{model.error()};
    if (const Result<void> valid = check_settings((*model)->cook_settings(), settings); !valid)
        return Error{valid.error()};
    const double diagonal = diagonal_of(mesh);
    if (const Result<void> valid = check_lengths(settings, diagonal); !valid) return Error{valid.error()};
    if (!has_area(mesh, diagonal))
        return Error{"no triangle has an area; all of its points lie on a line. Give a surface."};
    Cooking cooking{settings, *material, {.weld_tolerance = settings.weld_tolerance}, std::move(mesh), {}};
    const Result<SurfaceRepairs> repaired = clean(cooking);
    if (!repaired) return Error{repaired.error()};
    if (const Result<void> split = split_long_edges(cooking, diagonal, **model); !split) return Error{split.error()};
    const auto cooked = (*model)->calls().cook(cooking);
    if (!cooked) return Error{cooked.error()};
    Model::Contents& contents = **cooked;
    contents.name = cooking.mesh.name;
    contents.material = settings.material;
    contents.damage_model = (*model)->name();
    std::string& repairs = contents.report.repairs;
    if (!repaired->is_clean()) repairs = describe(*repaired) + (repairs.empty() ? "" : " " + repairs);
    Model made;
    made.contents = *cooked;
    return made;
}

}  // namespace

Result<Model> cook_with(const ModelList& models, const MeshView& view, const CookSettings& settings) try {
    static const Host no_host;
    const Host& host = settings.host ? *settings.host : no_host;
    if (const Result<void> valid = check_host(host); !valid) return Error{valid.error()};
    const HostScope call(host);
    const MemoryScope memory(host.allocator);
    Result<Mesh> mesh = mesh_of_view(view);
    if (!mesh) return Error{mesh.error()};
    const std::string name = mesh->name;
    Result<Model> cooked = cook_mesh(*models, std::move(*mesh), settings);
    if (!cooked) return Error{name + ": " + cooked.error()};
    return cooked;
} catch (const std::bad_alloc&) {
    return Error{std::string(view.name ? view.name : "mesh") + ": no memory to cook its " +
                 std::to_string(view.triangle_count) + " triangles. Free memory or simplify the mesh."};
}

Result<Model> cook(const MeshView& view, const CookSettings& settings) {
    return cook_with(damage_models(), view, settings);
}

std::vector<std::string> damage_model_names() {
    std::vector<std::string> names;
    for (const DamageModel& model : *damage_models()) names.push_back(model.name());
    return names;
}

Result<std::string> damage_model_of(const CookSettings& settings) {
    const Result<CookedMaterial> material = material_of(settings);
    if (!material) return Error{material.error()};
    const Result<const DamageModel*> model = model_of(*damage_models(), settings, material->settings);
    if (!model) return Error{model.error()};
    return (*model)->name();
}

std::vector<SettingGroup<CookSettings>> cook_settings_of(const std::string& damage_model) {
    const std::optional<uint8_t> number = damage_models()->find(damage_model);
    if (!number) return {};
    return (*damage_models())[*number].cook_settings();
}

std::vector<SettingGroup<SpawnSettings>> spawn_settings_of(const std::string& damage_model) {
    const std::optional<uint8_t> number = damage_models()->find(damage_model);
    if (!number) return {};
    return (*damage_models())[*number].spawn_settings();
}

const ModelReport& Model::report() const {
    static const ModelReport empty;
    return contents ? contents->report : empty;
}

MeshData::MeshData() : contents(std::make_unique<Contents>()) {}
MeshData::~MeshData() = default;
MeshData::MeshData(MeshData&&) noexcept = default;
MeshData& MeshData::operator=(MeshData&&) noexcept = default;

MeshView MeshData::view() const {
    const Mesh& mesh = contents->mesh;
    MeshView view;
    view.positions = mesh.positions.data();
    view.position_count = mesh.positions.size();
    view.indices = contents->indices.data();
    view.triangle_count = mesh.triangles.size();
    view.corner_normals = mesh.corner_normals.empty() ? nullptr : mesh.corner_normals.data();
    view.corner_uvs = mesh.corner_uvs.empty() ? nullptr : mesh.corner_uvs.data();
    view.materials = mesh.materials.empty() ? nullptr : mesh.materials.data();
    view.name = mesh.name.c_str();
    return view;
}

Result<MeshData> read_mesh(const std::string& path) {
    Result<Mesh> mesh = read_mesh_file(path);
    if (!mesh) return Error{mesh.error()};
    MeshData data;
    data.contents->mesh = std::move(mesh).value();
    for (const auto& triangle : data.contents->mesh.triangles)
        data.contents->indices.insert(data.contents->indices.end(), triangle.begin(), triangle.end());
    return data;
}

}  // namespace cullet
