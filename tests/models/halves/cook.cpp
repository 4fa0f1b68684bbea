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
    Shells& shells = (*made)->state.shells;
    const Row<Shells> shell = (*made)->shell;
    const Range vertices = shells.vertices[shell];
    for (uint32_t v = 0; v < vertices.count; ++v) (*made)->state.vertices.strength_factor[vertices.first + v] = 1;
    shells.intact_mass[shell] = shells.mass[shell];
    shells.time_step[shell] = kStep;
    shells.first_crack_speed[shell] = kBreakingSpeed;
    shells.first_crack_force[shell] = kBreakingForce;
    ModelReport& report = (*made)->report;
    report.vertices = shells.vertices[shell].count;
    report.elements = shells.elements[shell].count;
    report.cells = shells.cells[shell].count;
    report.mass = shells.mass[shell];
    report.mean_thickness = shells.thickness[shell];
    report.first_crack_speed = kBreakingSpeed;
    report.first_crack_force = kBreakingForce;
    return made;
}

}  // namespace cullet::halves
