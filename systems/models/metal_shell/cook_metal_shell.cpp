#include "systems/models/metal_shell/cook_metal_shell.hpp"

#include "systems/models/metal_shell/cook/metal_rows.hpp"
#include "systems/models/metal_shell/cook/turn_outwards.hpp"
#include "systems/structures/shell/cook/shell_of_surface.hpp"
#include "systems/structures/shell/cook/thin_fans.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet::metal_shell {
namespace {

constexpr float kLeastSpeed = 0.5f;  // m/s, of an impact that is looked at
constexpr float kWakeShare = 0.3f;   // of the first-crack speed, a task opens (thresholds.hpp)
constexpr float kNoForce = 1e12f;    // N: what lies on metal does not break it

MetalCookSettings wanted_rows(const Cooking& from) {
    const MetalShellSettings& given = from.settings.metal_shell;
    MetalCookSettings wanted;
    wanted.crush_pressure = given.crush_pressure;
    wanted.body_pressure = from.material.settings.crush_pressure;
    wanted.cells.count = given.sub_shells;
    wanted.dual.link_distance = static_cast<double>(given.link_distance);
    if (given.adjacency == MetalChoice::Paper) wanted.dual.distance = FaceDistance::Paper;
    if (given.seeds == MetalChoice::Paper) wanted.cells.seeding = Seeding::Paper;
    if (given.representatives == MetalChoice::Paper) wanted.cells.representatives = Representatives::Centroid;
    const std::pair<MetalChoice, PublishedChoice> choices[] = {
        {given.contact, kPublishedContact}, {given.depth, kPublishedDepth},     {given.shape, kPublishedShape},
        {given.cells, kPublishedCells},     {given.borders, kPublishedBorders}, {given.springs, kPublishedSprings},
        {given.limit, kPublishedLimit}};
    for (const auto& [choice, bit] : choices)
        if (choice == MetalChoice::Paper) wanted.published = static_cast<uint8_t>(wanted.published | bit);
    wanted.impulse_time = given.impulse_time;
    wanted.tear_strain = given.tear_strain;
    return wanted;
}

}  // namespace

float edge_share(const CookSettings& settings) {
    return settings.metal_shell.edge_split;
}

Result<std::shared_ptr<Model::Contents>> cook_metal_shell(Cooking& from) {
    if (from.material.settings.kind != MaterialKind::Ductile)
        return Error{"metal_shell dents what is ductile, and " + from.settings.material + " is " +
                     name_of(from.material.settings.kind) + "; give another model, or steel."};
    thin_fans(from.fine, kMostRing);
    Result<Surface> surface = prepare_surface(from.fine, from.welding);
    if (!surface) return Error{surface.error()};
    if (turn_outwards(from.fine, *surface) > 0) surface = prepare_surface(from.fine, from.welding);
    if (!surface) return Error{surface.error()};
    from.tell(0.1f);
    const Result<Extrusion> extrusion = extrude(*surface, from.settings.thickness);
    if (!extrusion) return Error{extrusion.error()};
    from.tell(0.4f);
    Result<std::shared_ptr<Model::Contents>> made = shell_of_surface(from, *surface, *extrusion);
    if (!made) return made;
    Workbench& rows = (*made)->state;
    const Row<Structures> structure = (*made)->shell;
    const Result<MetalReport> metal = make_metal_rows(rows, structure, wanted_rows(from));
    if (!metal) return Error{metal.error()};
    from.tell(1);
    const ShellView shell(rows, structure);
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) rows.vertices.strength_factor[shell.vertex(v)] = 1;
    Structures& structures = rows.structures;
    structures.intact_mass[structure] = structures.mass[structure];
    structures.first_crack_speed[structure] = kLeastSpeed / kWakeShare;
    structures.first_crack_force[structure] = kNoForce;
    rows.shells.time_step[shell.row] = 1e-3f;
    ModelReport& report = (*made)->report;
    report.vertices = shell.vertex_count();
    report.elements = shell.element_count();
    report.cells = shell.cells().count;
    report.mass = structures.mass[structure];
    report.mean_thickness = rows.shells.thickness[shell.row];
    report.first_crack_speed = structures.first_crack_speed[structure];
    report.first_crack_force = structures.first_crack_force[structure];
    return made;
}

}  // namespace cullet::metal_shell
