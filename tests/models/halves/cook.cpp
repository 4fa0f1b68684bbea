#include "tests/models/halves/cook.hpp"

#include "systems/structures/shell/cook/shell_of_surface.hpp"
#include "systems/structures/shell/cook/thin_fans.hpp"
#include "systems/structures/shell/ring.hpp"
#include "tests/models/halves/loop.hpp"

namespace cullet::halves {

constexpr float kBreakingSpeed = 1;     // m/s
constexpr float kBreakingForce = 1e6f;  // N

Result<std::shared_ptr<Model::Contents>> cook_halves(Cooking& from) {
    thin_fans(from.fine, kMostRing);
    const Result<Surface> surface = prepare_surface(from.fine, from.welding);
    if (!surface) return Error{surface.error()};
    const Result<Extrusion> extrusion = extrude(*surface, from.settings.thickness);
    if (!extrusion) return Error{extrusion.error()};
    Result<std::shared_ptr<Model::Contents>> made = shell_of_surface(from, *surface, *extrusion);
    if (!made) return made;
    ShellRows& rows = (*made)->state;
    const ShellView shell(rows, (*made)->shell);
    Structures& structures = rows.structures;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) rows.vertices.strength_factor[shell.vertex(v)] = 1;
    structures.intact_mass[shell.structure] = structures.mass[shell.structure];
    structures.first_crack_speed[shell.structure] = kBreakingSpeed;
    structures.first_crack_force[shell.structure] = kBreakingForce;
    rows.shells.time_step[shell.row] = kStep;
    ModelReport& report = (*made)->report;
    report.vertices = shell.vertex_count();
    report.elements = shell.element_count();
    report.cells = shell.cells().count;
    report.mass = structures.mass[shell.structure];
    report.mean_thickness = rows.shells.thickness[shell.row];
    report.first_crack_speed = kBreakingSpeed;
    report.first_crack_force = kBreakingForce;
    return made;
}

}  // namespace cullet::halves
