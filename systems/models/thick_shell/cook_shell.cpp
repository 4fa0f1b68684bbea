#include "systems/models/thick_shell/cook_shell.hpp"

#include <algorithm>

#include "systems/cook/tessellate.hpp"
#include "systems/models/thick_shell/cook/hit_advice.hpp"
#include "systems/models/thick_shell/hidden/strength_factors.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/models/thick_shell/thresholds.hpp"
#include "systems/structures/shell/cook/join_walls.hpp"
#include "systems/structures/shell/cook/shell_of_surface.hpp"
#include "systems/structures/shell/cook/thin_fans.hpp"
#include "systems/structures/shell/ring.hpp"
#include "systems/tasks/step_limits.hpp"

namespace cullet {
namespace {

// Of a hit: above this it would take minutes.
constexpr uint64_t kMostUnits = 20'000'000'000;

// Springs, limits, rows and time step. The rows' room is known only when the springs are: the shell moves to ranges
// that have it.
Result<void> make_stiff(RunRows& state, Row<Structures>& shell) {
    const ShellView soft(state, shell);
    assemble_springs(soft);
    measure_limits(soft);
    limit_all_stiffness(soft);
    state.structures.intact_mass[shell] = state.structures.mass[shell];
    ShellRoom room = stiffness_room(soft, 0);
    room.vertices = std::max(room.vertices, soft.vertex_count());
    room.elements = soft.element_count();
    room.hinges = soft.hinge_count();
    room.cells = soft.cells().count;
    room.points = soft.points().count;
    const char* full = "";
    const Row<Structures> stiff = make_shell(state, room, &full);
    if (!stiff.exists()) return Error{std::string("no room to assemble the stiffness (") + full + ")."};
    copy_shell_rows(state, state, shell, stiff, false);
    release_shell(state, shell);
    shell = stiff;
    const ShellView view(state, shell);
    if (!assemble_stiffness(view))
        return Error{"the stiffness does not fit the room that was asked for it; please report this mesh."};
    float& step = state.shells.time_step[view.row];
    step = stable_time_step(view);
    if (!(step > 0)) return Error{"nothing holds the mesh together: no two triangles share an edge. Weld it first."};
    const float run = run_seconds(state, state.structures.material[shell], state.structures.area[shell]);
    if (!(step >= kShortestStep && run <= kMostSteps * step))
        return Error{"a hit would take more than " + std::to_string(static_cast<int>(kMostSteps / 1e6f)) +
                     " million steps: some edges are far too short for its size. Weld them, or scale it."};
    return {};
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
std::string advice_on(const RunRows& state, Row<Structures> shell, uint64_t units, const Mesh& mesh,
                      double longest_edge) {
    const Shells& s = state.shells;
    const Row<Shells> row = state.shell_of(shell);
    const HitOfModel hit{
        units,       s.vertices[row].count, is_for_cut_outs(state, shell, false), s.mean_edge[row], s.thickness[row],
        longest_edge};
    return hit_advice(hit, [&mesh](double length) {
        TessellationSettings tessellation;
        tessellation.longest_edge = length;
        const Result<Mesh> fine = tessellate(mesh, tessellation);
        return fine ? mean_edge_of(*fine) : 0;
    });
}

ModelReport report_on(const RunRows& state, Row<Structures> shell, const Extrusion& extrusion) {
    const Structures& s = state.structures;
    const Row<Shells> row = state.shell_of(shell);
    ModelReport report;
    report.vertices = state.shells.vertices[row].count;
    report.elements = state.shells.elements[row].count;
    report.cells = s.cells[shell].count;
    report.degenerate_elements = extrusion.statistics.degenerate_elements;
    report.collisions = extrusion.statistics.collisions;
    report.inverted_elements = extrusion.statistics.inverted_elements;
    report.crossings = extrusion.statistics.crossings;
    report.mass = s.mass[shell];
    report.mean_thickness = state.shells.thickness[row];
    report.first_crack_speed = s.first_crack_speed[shell];
    report.first_crack_force = s.first_crack_force[shell];
    report.units_of_a_hit = units_of_a_hit(state, shell);
    return report;
}

std::string thinned(uint32_t fans) {
    if (fans == 0) return {};
    return "Thinned " + std::to_string(fans) + (fans == 1 ? " fan" : " fans") + " of more than " +
           std::to_string(kMostRing) + " triangles.";
}

}  // namespace

Result<std::shared_ptr<Model::Contents>> cook_thick_shell(Cooking& from) {
    const CookSettings& settings = from.settings;
    const MaterialKind kind = from.material.settings.kind;
    const uint32_t fans = thin_fans(from.fine, kMostRing);
    Result<Surface> surface = prepare_surface(from.fine, from.welding);
    if (!surface) return Error{surface.error()};
    from.tell(0.1f);
    std::optional<JoinedWalls> joined;
    if (settings.thick_shell.joins_walls) joined = join_walls(*surface, from.fine, settings.thickness);
    InnerSkin skin;
    if (joined) {
        from.fine = std::move(joined->outer);
        surface = prepare_surface(from.fine, from.welding);
        if (!surface) return Error{surface.error()};
        skin = skin_for(*joined, *surface);
    }
    ExtrusionSettings extruding;
    extruding.propagation = settings.thick_shell.propagation;
    const Result<Extrusion> extrusion = extrude(*surface, settings.thickness, extruding, joined ? &skin : nullptr);
    if (!extrusion) return Error{extrusion.error()};
    from.tell(0.3f);

    Result<std::shared_ptr<Model::Contents>> made = shell_of_surface(from, *surface, *extrusion);
    if (!made) return made;
    Model::Contents& contents = **made;
    Workbench& state = contents.state;
    fill_strength_factors(ShellView(state, contents.shell), settings.seed);
    if (const Result<void> ready = make_stiff(state, contents.shell); !ready) return Error{ready.error()};
    const uint64_t units = units_of_a_hit(state, contents.shell);
    if (units > kMostUnits)
        return Error{"a hit would take " + std::to_string(units / 1'000'000) + " million units, more than " +
                     std::to_string(kMostUnits / 1'000'000) +
                     " million. Its shortest edges are far too short for its size: weld them, or use fewer triangles."};
    const bool measures =
        settings.thick_shell.measures_threshold && units <= kMostMeasuredUnits && kind == MaterialKind::Brittle;
    if (measures)
        measure_thresholds(state, contents.shell, from);
    else
        estimate_thresholds(state, contents.shell);
    if (!measures) from.tell(1);
    contents.report = report_on(state, contents.shell, *extrusion);
    // A hit on a ductile or elastic body is no hidden run.
    if (kind == MaterialKind::Brittle)
        contents.report.advice = advice_on(state, contents.shell, units, from.mesh, from.longest_edge);
    if (joined) contents.report.walls = describe(*joined, *surface, *extrusion);
    contents.report.repairs = thinned(fans);
    return made;
}

}  // namespace cullet
