#include "systems/models/lattice/cook_lattice.hpp"

#include <algorithm>

#include "systems/cook/materials.hpp"
#include "systems/models/lattice/crack/break_run.hpp"
#include "systems/models/lattice/shared/brittle.hpp"
#include "systems/structures/tetrahedra/skin.hpp"
#include "systems/structures/tetrahedra/solid_hulls.hpp"
#include "systems/structures/tetrahedra/solid_rows.hpp"

namespace cullet::lattice {
namespace {

constexpr double kRoundness = 0.5;  // radius of a struck place, of the cube root of the volume

SolidSettings settings_of(const Cooking& from) {
    const LatticeSettings& given = from.settings.lattice;
    SolidSettings wanted;
    wanted.cells = given.cells, wanted.most_cells = given.most_cells;
    wanted.element_edges = given.element_edges >= 4 ? 4 : 2;
    wanted.jitter = double{given.jitter};
    wanted.largest_filled = double{given.largest_filled};
    wanted.weld_tolerance = double{from.settings.weld_tolerance};
    return wanted;
}

/// Room for the solid and a few of its copies: rows of a solid follow from both limits (components/shell_rows.hpp).
Limits limits_for(const CookedSolid& cooked, size_t hulls) {
    const Solid& solid = cooked.solid;
    const size_t listed =
        std::max({solid.lattice.points.size(), cooked.windings.list.size(), solid.lattice.fine.size(),
                  4 * solid.lattice.coarse.size(), 2 * solid.cells.size(), cooked.raw.size(), solid.moments.size(),
                  solid.bonds.size(), solid.patches.size(), cooked.mesh.triangles.size()});
    const size_t points = std::max(cooked.mesh.positions.size(), 16 * hulls);
    return cooking_limits(static_cast<uint32_t>(points), static_cast<uint32_t>(listed));
}

/// Of blows against a floor at the ends of the box: the least speed and force that crack it.
struct Threshold {
    double speed = 1e12, force = 1e12;
};
Threshold measure_threshold(const BreakableSolid& body, const BrittleSolid& brittle, double mass) {
    Arena arena(break_bytes(body));
    BreakRun run = take_break(arena, body);
    CrackRules rules;
    rules.most_cracks = 0;
    Threshold least;
    for (const Vec3d way :
         {Vec3d(1, 0, 0), Vec3d(-1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, -1, 0), Vec3d(0, 0, 1), Vec3d(0, 0, -1)}) {
        SolidBlow blow;
        double farthest = -1e300;
        for (const SurfacePatch& patch : body.solid.patches)
            if (const double far = dot(patch.centroid, way); far > farthest)
                farthest = far, blow.point = patch.centroid;
        blow.push = -1 * way;
        blow.speed = 1;
        blow.effective_mass = mass;
        blow.radius = kRoundness * power(body.solid.volume, 1.0 / 3);
        blow.striker = brittle.elastic;
        begin_break(body, brittle, blow, rules, {}, run);
        while (!advance_break(body, run, uint64_t{1} << 24)) {
        }
        if (!(run.gate > 0)) continue;
        least.force = std::min(least.force, threshold_force(run));
        least.speed = std::min(least.speed, blow.speed * power(1 / run.gate, 5.0 / 6));  // Hertz: F goes by v^(6/5)
    }
    return least;
}

}  // namespace

Result<std::shared_ptr<Model::Contents>> cook_lattice(Cooking& from) {
    if (from.material.settings.kind != MaterialKind::Brittle)
        return Error{"lattice breaks what is brittle, and " + from.settings.material + " is " +
                     name_of(from.material.settings.kind) + "; give another model, or stone."};
    const LatticeSettings& given = from.settings.lattice;
    const Result<CookedSolid> cooked = cook_solid(from.mesh, settings_of(from));
    if (!cooked) return Error{cooked.error()};
    from.tell(0.4f);
    const std::vector<Triangle>& triangles = cooked->mesh.triangles;
    HalvingSettings halving;
    halving.most_excess = double{given.hull_excess};
    ScratchMemory scratch;
    const List<SolidHull> hulls = convex_pieces(scratch, cooked->mesh.positions, triangles, halving);
    from.tell(0.6f);

    const auto contents = std::make_shared<Model::Contents>(limits_for(*cooked, hulls.size()));
    Workbench& state = contents->state;
    fill_materials(state.materials);
    const char* full = "";
    const Row<Structures> structure = write_solid(state, *cooked, from.mesh, &full);
    if (!structure.exists()) return Error{std::string("its solid does not fit ") + full + "."};
    Structures& structures = state.structures;
    structures.material[structure] = material_row({state.materials, state.material_traits, state.structures},
                                                  from.material.settings, from.material.grain);
    uint32_t points = 0;
    for (const SolidHull& hull : hulls) points += static_cast<uint32_t>(hull.points.size());
    if (!state.cells.take(static_cast<uint32_t>(hulls.size()), structures.cells[structure]) ||
        !state.hull_points.take(points, structures.points[structure]))
        return Error{"its " + std::to_string(hulls.size()) + " convex pieces do not fit limits.vertices."};
    write_hulls(state, structure, hulls, cooked->solid.thickness);
    measure_solid(state, structure);
    structures.intact_mass[structure] = structures.mass[structure];
    const Row<CookedSolids> row = state.solids.cooked[solid_of(structures, structure)];
    state.cooked_solids.strength_modulus[row] = given.strength_modulus;
    state.cooked_solids.strength_seed[row] = from.settings.seed;

    BreakableSolid body = make_breakable(cooked->solid);
    if (given.strength_modulus > 0) scatter_strength(body, double{given.strength_modulus}, from.settings.seed);
    const Threshold least = measure_threshold(body, brittle_of(state.materials, structures.material[structure]),
                                              structures.mass[structure]);
    structures.first_crack_speed[structure] = static_cast<float>(least.speed);
    structures.first_crack_force[structure] = static_cast<float>(least.force);
    from.tell(1);

    contents->shell = structure;
    ModelReport& report = contents->report;
    report.vertices = static_cast<uint32_t>(cooked->mesh.positions.size());
    report.elements = static_cast<uint32_t>(cooked->solid.cells.size());
    report.cells = static_cast<uint32_t>(hulls.size());
    report.mass = structures.mass[structure];
    report.mean_thickness = cooked->solid.thickness;
    report.first_crack_speed = structures.first_crack_speed[structure];
    report.first_crack_force = structures.first_crack_force[structure];
    report.repairs = cooked->notes;
    return contents;
}

}  // namespace cullet::lattice
