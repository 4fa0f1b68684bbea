#include <algorithm>
#include <new>

#include "engine/host_scope.hpp"
#include "engine/memory.hpp"
#include "engine/mesh_file.hpp"
#include "systems/cook/clean_mesh.hpp"
#include "systems/cook/crease_normals.hpp"
#include "systems/cook/materials.hpp"
#include "systems/cook/mesh_of_view.hpp"
#include "systems/cook/model_contents.hpp"
#include "systems/cook/surface.hpp"
#include "systems/cook/tessellate.hpp"
#include "systems/models/thick_shell/cook/hit_advice.hpp"
#include "systems/models/thick_shell/hidden/run_cost.hpp"
#include "systems/models/thick_shell/hidden/strength_factors.hpp"
#include "systems/models/thick_shell/run_hit.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/structures/shell/cook/build_shell.hpp"
#include "systems/structures/shell/cook/extrude.hpp"
#include "systems/structures/shell/cook/join_walls.hpp"
#include "systems/structures/shell/cook/thin_fans.hpp"
#include "systems/structures/shell/group_fragments.hpp"
#include "systems/structures/shell/ring.hpp"
#include "systems/tasks/step_limits.hpp"

namespace cullet {
namespace {

constexpr uint32_t kThresholdPlaces = 4;
// Of the force that a blow may pass, so much is borne for long: hidden runs give a wall twice the strength that the
// table has for seconds (thick shell note, B7).
constexpr float kForLong = 0.5f;
// Of a hit: beyond the first a threshold is estimated, since measuring it would take minutes (a wall of 1,600 stones
// takes half of that); beyond the second a hit would.
constexpr uint64_t kMostMeasuredUnits = 2'000'000'000, kMostUnits = 20'000'000'000;

/// What the settings say of the material, looked at.
struct CookedMaterial {
    MaterialSettings settings;
    Vec3 grain;  // unit, or zero
};
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

// The surface's corners and triangles with the mesh's attributes found again.
struct SourceArrays {
    std::vector<Vec3> normals;
    std::vector<Vec2> uvs;
    std::vector<uint16_t> materials;
};
// Normals that cooking made itself follow a sheet that was turned since.
SourceArrays attributes_of(const Surface& surface, const Mesh& mesh, bool has_made_normals) {
    SourceArrays arrays;
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        const uint32_t source = surface.source_triangles[t];
        const Triangle& c = surface.triangles[t];
        const Vec3d flat =
            cross(surface.positions[c[1]] - surface.positions[c[0]], surface.positions[c[2]] - surface.positions[c[0]]);
        for (int k = 0; k < 3; ++k) {
            const size_t corner = 3 * size_t{source} + surface.source_corners[t][static_cast<size_t>(k)];
            if (!mesh.corner_normals.empty()) arrays.normals.push_back(mesh.corner_normals[corner]);
            if (has_made_normals && dot(Vec3d(arrays.normals.back()), flat) < 0)
                arrays.normals.back() = -arrays.normals.back();
            if (!mesh.corner_uvs.empty()) arrays.uvs.push_back(mesh.corner_uvs[corner]);
        }
        if (!mesh.materials.empty()) arrays.materials.push_back(mesh.materials[source]);
    }
    return arrays;
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

// Springs, limits, rows and time step. The rows' room is known only when the springs are: the shell moves to ranges
// that have it.
Result<void> make_stiff(RunRows& state, Row<Shells>& shell) {
    const ShellView soft(state, shell);
    assemble_springs(soft);
    measure_limits(soft);
    limit_all_stiffness(soft);
    Shells& s = state.shells;
    s.intact_mass[shell] = s.mass[shell];
    ShellRoom room = stiffness_room(soft, 0);
    room.vertices = std::max(room.vertices, s.vertices[shell].count);
    room.elements = s.elements[shell].count;
    room.hinges = s.hinges[shell].count;
    room.cells = s.cells[shell].count;
    room.points = s.points[shell].count;
    const char* full = "";
    const Row<Shells> stiff = make_shell(state, room, &full);
    if (!stiff.exists()) return Error{std::string("no room to assemble the stiffness (") + full + ")."};
    copy_shell_rows(state, state, shell, stiff, false);
    release_shell(state, shell);
    shell = stiff;
    const ShellView view(state, shell);
    if (!assemble_stiffness(view))
        return Error{"the stiffness does not fit the room that was asked for it; please report this mesh."};
    s.time_step[shell] = stable_time_step(view);
    if (!(s.time_step[shell] > 0))
        return Error{"nothing holds the mesh together: no two triangles share an edge. Weld it first."};
    const float run = run_seconds(state, s.material[shell], s.area[shell]);
    if (!(s.time_step[shell] >= kShortestStep && run <= kMostSteps * s.time_step[shell]))
        return Error{"a hit would take more than " + std::to_string(static_cast<int>(kMostSteps / 1e6f)) +
                     " million steps: some edges are far too short for its size. Weld them, or scale it."};
    return {};
}

void measure_thresholds(RunRows& state, Row<Shells> shell, const CookSettings& settings) {
    float speeds[kThresholdPlaces], forces[kThresholdPlaces];
    for (uint32_t place = 0; place < kThresholdPlaces; ++place) {
        const FirstCrack crack = first_crack(state, shell, seeded_direction(settings.seed, place));
        speeds[place] = crack.speed;
        forces[place] = crack.force;
        if (settings.progress)
            settings.progress(settings.progress_user, 0.4f + 0.6f * static_cast<float>(place + 1) / kThresholdPlaces);
    }
    std::sort(speeds, speeds + kThresholdPlaces);
    std::sort(forces, forces + kThresholdPlaces);
    state.shells.first_crack_speed[shell] = 0.5f * (speeds[1] + speeds[2]);
    state.shells.first_crack_force[shell] = kForLong * 0.5f * (forces[1] + forces[2]);
}

// (2/3) sigma_t h^2: what a square of the wall bears in its middle that lies on two of its edges.
float estimated_force(const RunRows& state, Row<Shells> shell) {
    const float h = state.shells.thickness[shell];
    return 0.667f * state.materials.tensile_strength[state.shells.material[shell]] * h * h;
}

// 0.1 sigma_d / (rho c): what a wave in a bar carries; only where nothing was measured. 0 of what does not crack.
float estimated_threshold(const RunRows& state, Row<Shells> shell) {
    const uint32_t m = state.shells.material[shell];
    const Materials& materials = state.materials;
    return 0.2f * materials.tensile_strength[m] / std::sqrt(materials.young_modulus[m] * materials.density[m]);
}

void estimate_thresholds(RunRows& state, Row<Shells> shell) {
    state.shells.first_crack_speed[shell] = estimated_threshold(state, shell);
    state.shells.first_crack_force[shell] =
        state.shells.first_crack_speed[shell] > 0 ? estimated_force(state, shell) : 0;
}

// Of a large body whose cracks stay near the hit those of the part that it begins on.
uint64_t units_of_a_hit(const RunRows& state, Row<Shells> shell) {
    const Shells& s = state.shells;
    const bool is_local = is_for_cut_outs(state, shell, false);
    const uint32_t vertices = is_local ? kWholeCopyVertices : s.vertices[shell].count;
    const float run = run_seconds(state, s.material[shell], s.area[shell]);
    const auto steps = static_cast<uint64_t>(run / s.time_step[shell]) + 1;
    return steps * units_a_step(vertices + vertices / 10, 64) + 300 * kUnitsCut +
           vertices * (kUnitsOpen + (is_local ? kUnitsAssemble : 0));  // a blow that breaks grows it by a tenth
}

/// Of all triangles, an edge between two of them twice.
double mean_edge_of(const Mesh& mesh) {
    double sum = 0;
    for (const auto& triangle : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            sum += length(Vec3d(mesh.positions[triangle[(k + 1) % 3]]) - Vec3d(mesh.positions[triangle[k]]));
    return mesh.triangles.empty() ? 0 : sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

/// What to do about hits that will be late. `longest_edge`: the setting where it made the edges what they are, or 0.
std::string advice_on(const RunRows& state, Row<Shells> shell, uint64_t units, const Mesh& mesh, double longest_edge) {
    const Shells& s = state.shells;
    const HitOfModel hit{units,
                         s.vertices[shell].count,
                         is_for_cut_outs(state, shell, false),
                         s.mean_edge[shell],
                         s.thickness[shell],
                         longest_edge};
    return hit_advice(hit, [&mesh](double length) {
        TessellationSettings tessellation;
        tessellation.longest_edge = length;
        const Result<Mesh> fine = tessellate(mesh, tessellation);
        return fine ? mean_edge_of(*fine) : 0;
    });
}

ModelReport report_on(const RunRows& state, Row<Shells> shell, const SurfaceRepairs& repairs,
                      const Extrusion& extrusion) {
    const Shells& s = state.shells;
    ModelReport report;
    report.vertices = s.vertices[shell].count;
    report.elements = s.elements[shell].count;
    report.cells = s.cells[shell].count;
    report.degenerate_elements = extrusion.statistics.degenerate_elements;
    report.collisions = extrusion.statistics.collisions;
    report.inverted_elements = extrusion.statistics.inverted_elements;
    report.crossings = extrusion.statistics.crossings;
    report.mass = s.mass[shell];
    report.mean_thickness = s.thickness[shell];
    report.first_crack_speed = s.first_crack_speed[shell];
    report.first_crack_force = s.first_crack_force[shell];
    report.units_of_a_hit = units_of_a_hit(state, shell);
    if (!repairs.is_clean()) report.repairs = describe(repairs);
    return report;
}

}  // namespace

Limits cooking_limits(uint32_t vertices, uint32_t elements) {
    Limits limits;
    limits.bodies = limits.models = limits.debris = 1;
    limits.shells = 8;
    limits.tasks = 1;
    limits.vertices = 5 * vertices + 8192;
    limits.elements = 5 * elements + 16384;
    limits.view_vertices = 64;
    return limits;
}

Row<Shells> import_shell(ShellRows& to, const ShellRows& from, Row<Shells> shell, const char** full) {
    const ShellRoom room = room_of(from, shell);
    const Row<Shells> copy = make_shell(to, room, full);
    if (copy.exists()) copy_shell_rows(to, from, shell, copy, room.blocks > 0);
    return copy;
}

Result<Model> cook(const MeshView& view, const CookSettings& settings) try {
    static const Host no_host;
    const Host& host = settings.host ? *settings.host : no_host;
    if (const Result<void> valid = check_host(host); !valid) return Error{valid.error()};
    const HostScope call(host);
    const MemoryScope memory(host.allocator);
    Result<Mesh> mesh = mesh_of_view(view);
    if (!mesh) return Error{mesh.error()};
    const std::string name = mesh->name;
    const Result<CookedMaterial> material = material_of(settings);
    if (!material) return Error{name + ": " + material.error()};
    const double diagonal = diagonal_of(*mesh);
    if (!(settings.thickness > 0 && settings.thickness < diagonal))
        return Error{name + ": thickness " + std::to_string(settings.thickness) +
                     " m is not between 0 and the diagonal, " + std::to_string(diagonal) +
                     " m; give the wall's thickness in metres."};
    if (!(settings.longest_edge >= 0))
        return Error{name + ": longest_edge is " + std::to_string(settings.longest_edge) +
                     " m; give metres, or 0 for what suits the thickness."};
    if (!(settings.weld_tolerance >= 0 && settings.weld_tolerance <= 0.01f))
        return Error{name + ": weld_tolerance is " + std::to_string(settings.weld_tolerance) +
                     " of the diagonal; give 0 to 0.01, or 1e-7 for a soup with noise."};
    if (!has_area(*mesh, diagonal))
        return Error{name + ": no triangle has an area; all of its points lie on a line. Give a surface."};
    const SurfaceSettings welding{.weld_tolerance = settings.weld_tolerance};
    // Counted on the mesh as it was given: a triangle that is flipped is one, however often it is cut later.
    const Result<Surface> given = prepare_surface(*mesh, welding);
    if (!given) return Error{name + ": " + given.error()};
    if (const uint32_t parts = given->repairs.unorientable_components; parts > 0)
        return Error{name + ": " + std::to_string(parts) + (parts == 1 ? " part is" : " parts are") +
                     " one-sided, like a Moebius strip, so nothing is inside. Cut each along a line, or remove it."};
    const bool makes_normals = mesh->corner_normals.empty();
    if (makes_normals) give_crease_normals(*mesh, given.value());
    SurfaceRepairs unused;
    const Result<CleanMesh> clean = clean_mesh(*mesh, welding, unused);
    if (!clean) return Error{name + ": " + clean.error()};
    drop_triangles(*mesh, clean->repeated);
    TessellationSettings tessellation;
    tessellation.longest_edge =
        settings.longest_edge > 0 ? settings.longest_edge : std::max(2.0 * settings.thickness, 0.025 * diagonal);
    Result<Mesh> fine = tessellate(*mesh, tessellation);
    if (!fine) return Error{name + ": " + fine.error()};
    // Whether the setting made the edges what they are, or cut a few long ones.
    const double cut_at = fine->triangles.size() >= 2 * mesh->triangles.size() ? tessellation.longest_edge : 0;
    const uint32_t thinned = thin_fans(*fine, kMostRing);
    Result<Surface> surface = prepare_surface(*fine, welding);
    if (!surface) return Error{name + ": " + surface.error()};
    if (settings.progress) settings.progress(settings.progress_user, 0.1f);
    std::optional<JoinedWalls> joined;
    if (settings.joins_walls) joined = join_walls(*surface, *fine, settings.thickness);
    InnerSkin skin;
    if (joined) {
        *fine = std::move(joined->outer);
        surface = prepare_surface(*fine, welding);
        if (!surface) return Error{name + ": " + surface.error()};
        skin = skin_for(*joined, *surface);
    }
    ExtrusionSettings extruding;
    extruding.propagation = settings.propagation;
    const Result<Extrusion> extrusion =
        extrude(surface.value(), settings.thickness, extruding, joined ? &skin : nullptr);
    if (!extrusion) return Error{name + ": " + extrusion.error()};
    if (settings.progress) settings.progress(settings.progress_user, 0.3f);

    const auto vertices = static_cast<uint32_t>(surface->positions.size());
    const auto elements = static_cast<uint32_t>(surface->triangles.size());
    const auto contents = std::make_shared<Model::Contents>(cooking_limits(vertices, elements));
    Workbench& state = contents->state;
    fill_materials(state.materials);
    const SourceArrays arrays = attributes_of(surface.value(), *fine, makes_normals);
    ShellSource source;
    source.position = surface->positions;
    source.inward = extrusion->direction;
    source.depth = extrusion->depth;
    source.corner = surface->triangles;
    source.neighbour = surface->neighbours;
    source.corner_normal = arrays.normals;
    source.corner_uv = arrays.uvs;
    source.drawn_material = arrays.materials;
    source.is_degenerate = extrusion->is_degenerate_element;
    source.wanted_depth = settings.thickness;
    const Result<Row<Shells>> shell = build_shell(
        state, source,
        material_row({state.materials, state.material_traits, state.shells}, material->settings, material->grain));
    if (!shell) return Error{name + ": " + shell.error()};
    contents->shell = shell.value();
    contents->name = name;
    contents->material = settings.material;
    group_fragments(ShellView(state, contents->shell), {});  // numbers the parts, for find_parts
    fill_strength_factors(ShellView(state, contents->shell), settings.seed);
    if (const Result<void> ready = make_stiff(state, contents->shell); !ready)
        return Error{name + ": " + ready.error()};
    const uint64_t units = units_of_a_hit(state, contents->shell);
    if (units > kMostUnits)
        return Error{name + ": a hit would take " + std::to_string(units / 1'000'000) + " million units, more than " +
                     std::to_string(kMostUnits / 1'000'000) +
                     " million. Its shortest edges are far too short for its size: weld them, or use fewer triangles."};
    const bool measures =
        settings.measures_threshold && units <= kMostMeasuredUnits && material->settings.kind == MaterialKind::Brittle;
    if (measures)
        measure_thresholds(state, contents->shell, settings);
    else
        estimate_thresholds(state, contents->shell);
    if (settings.progress && !measures) settings.progress(settings.progress_user, 1);
    contents->report = report_on(state, contents->shell, given->repairs, extrusion.value());
    // A hit on a ductile or elastic body is no hidden run.
    if (material->settings.kind == MaterialKind::Brittle)
        contents->report.advice = advice_on(state, contents->shell, units, *mesh, cut_at);
    if (joined) contents->report.walls = describe(*joined, *surface, *extrusion);
    if (thinned > 0)
        contents->report.repairs += (contents->report.repairs.empty() ? "" : " ") + std::string("Thinned ") +
                                    std::to_string(thinned) + (thinned == 1 ? " fan" : " fans") + " of more than " +
                                    std::to_string(kMostRing) + " triangles.";
    Model model;
    model.contents = contents;
    return model;
} catch (const std::bad_alloc&) {
    return Error{std::string(view.name ? view.name : "mesh") + ": no memory to cook its " +
                 std::to_string(view.triangle_count) + " triangles. Free memory or simplify the mesh."};
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
