#include "systems/models/metal_shell/dent/dent.hpp"

#include <algorithm>

#include "systems/models/metal_shell/dent/along_dent.hpp"
#include "systems/models/metal_shell/dent/fold_cells.hpp"
#include "systems/models/metal_shell/dent/limit_stretch.hpp"
#include "systems/models/metal_shell/dent/raise_body.hpp"
#include "systems/models/metal_shell/dent/raise_sheet.hpp"
#include "systems/models/metal_shell/dent/turn_normals.hpp"
#include "systems/models/metal_shell/published/hit_cells.hpp"
#include "systems/structures/shell/mass_properties.hpp"

namespace cullet {
namespace {

constexpr double kWidest = 0.59;       // of the support: from there on a blow on a closed shell crushes the body
constexpr double kTears = 1.25;        // of the strain at which the material breaks
constexpr double kPressedFold = 0.15;  // of half of the box diagonal: how far a slow press drags metal along, at least
constexpr double kSmallStriker = 0.1;  // of half of the box diagonal, to each side
constexpr double kFlatStriker = 0.25;  // of the box diagonal: what a flat striker is to a sheet that is open

void begin(const MetalView& metal, bool goes_on) {
    MetalVertices& vertices = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        const Vec3 rest = metal.shell.state.vertices.rest[metal.shell.vertex(v)];
        if (!goes_on) vertices.before.set(row, rest);
        const Vec3 start = vertices.before[row];
        vertices.start.set(row, start), vertices.place.set(row, start);
        vertices.field[row] = 0;
    }
    // A dent in a sheet has no folds, whatever an earlier crush left here.
    for (uint32_t c = 0; c < metal.cell_count(); ++c) metal.cells().fold[metal.cell(c)] = 0;
}

Striker round_striker(const MetalView& metal, Striker striker) {
    if (striker.shape == StrikerShape::Sphere) return striker;
    striker.radius = striker.ball_radius(kFlatStriker * 2 * double{metal.shells().half_diagonal[metal.row]});
    striker.shape = StrikerShape::Sphere;
    return striker;
}

// What is wider than the body, as a wall is, goes through nothing.
bool ends_within(const Striker& striker) {
    const bool is_front = striker.shape == StrikerShape::Front;
    return striker.shape == StrikerShape::Sphere || (is_front && striker.front.half_u > 0 && striker.front.half_v > 0);
}

// It meets the wall of a body and not the body: crushed by so little of it, a car would be pierced by a scrap of sheet.
bool is_small(const MetalView& metal, const Striker& striker) {
    if (striker.shape != StrikerShape::Front || !ends_within(striker)) return false;
    return std::max(striker.front.half_u, striker.front.half_v) <
           kSmallStriker * double{metal.shells().half_diagonal[metal.row]};
}

bool is_published(const MetalView& metal, PublishedChoice choice) {
    return metal.shells().published[metal.row] & choice;
}

// The published shape; reach: how far the striker has gone on when it hits.
void move_rigidly(const MetalView& metal, const Striker& striker, double depth, double reach) {
    CellBlow blow;
    blow.depth = depth, blow.reach = reach;
    blow.is_by_mass = is_published(metal, kPublishedDepth);
    blow.is_by_lowest = is_published(metal, kPublishedBorders);
    blow.impulse = striker.impulse, blow.time = double{metal.shells().impulse_time[metal.row]};
    move_hit_cells(metal, striker, blow);
}

// A hard hit gives back what the material says, a wide sheet more.
double plastic_share(const MetalView& metal, double sheet_restitution) {
    const ShellView& shell = metal.shell;
    const Row<Materials> material = shell.structures().material[shell.structure];
    const double e = std::max(double{shell.state.materials.restitution[material]}, sheet_restitution);
    return 1 - e * e;
}

void carry_creases(const MetalView& metal, double contact, bool folds) {
    if (is_published(metal, kPublishedCells)) return;
    if (is_published(metal, kPublishedBorders)) choose_lowest(metal);
    measure_cells(metal);
    if (folds) fold_cells(metal);
    crease_cells(metal, contact);
}

// Six rounds leave what folds and triangles that were turned back have drawn out. Nothing as published is mended.
bool mends(const MetalView& metal) {
    return metal.shells().published[metal.row] == 0;
}

// J of the blow that a sheet which is about to tear does not take.
double left_at_tear(const MetalView& metal, const Striker& striker, const SheetPlace& place, double energy) {
    SheetMetal sheet = sheet_metal(metal);
    const double own = double{metal.shells().tear_strain[metal.row]};
    sheet.break_strain = own > 0 ? own : kTears * sheet.break_strain;
    return plan_sheet(sheet, blow_at(place, striker, energy)).left;
}

Dent dent_sheet(const MetalView& metal, const Striker& striker, const SheetPlace& place, const SheetPlan& plan,
                double energy) {
    Dent dent{DentKind::Sheet, std::max(0.0, plan.depth - place.dent_depth), plan.contact, plan.left, plan.restitution,
              plan.is_puncture};
    dent.plastic = plastic_share(metal, plan.restitution) * (energy - plan.left);
    dent.deep = plan.depth, dent.support = place.support, dent.vertex = place.vertex;
    dent.striker = striker, dent.plan = plan;
    if (plan.is_puncture) dent.tearing = left_at_tear(metal, striker, place, energy);
    if (is_published(metal, kPublishedShape)) {
        move_rigidly(metal, striker, dent.depth, 0);
    } else {
        raise_sheet(metal, striker, place, plan);
        place_field(metal, striker.push);
    }
    carry_creases(metal, plan.contact, false);
    if (!is_published(metal, kPublishedShape)) clear_striker(metal, striker, dent.depth);
    const double most_stretch = sheet_metal(metal).break_strain;
    limit_stretch(metal, most_stretch, striker, dent.depth);
    if (mends(metal)) mend_edges(metal, most_stretch, striker, dent.depth);
    return dent;
}

Dent crush_body(const MetalView& metal, const Striker& striker, double energy) {
    const CrushPlan plan = plan_crush(metal, striker, energy);
    Dent dent{DentKind::Body, plan.depth, plan.depth, plan.left, 0, false};
    if (!(plan.depth > 0)) return {};
    dent.plastic = plastic_share(metal, 0) * (energy - plan.left);
    if (is_published(metal, kPublishedShape)) {
        move_rigidly(metal, striker, plan.depth, plan.depth);
    } else {
        raise_body(metal, striker, plan.depth, kCrushReach * plan.depth);
        place_field(metal, striker.push);
    }
    carry_creases(metal, plan.depth, true);
    if (!is_published(metal, kPublishedShape)) clear_striker(metal, striker, plan.depth);
    const double most_stretch = sheet_metal(metal).break_strain;
    limit_stretch(metal, most_stretch, striker, plan.depth);
    if (!is_published(metal, kPublishedSprings)) turn_back(metal);
    if (!is_published(metal, kPublishedShape)) clear_striker(metal, striker, plan.depth);
    if (mends(metal)) mend_edges(metal, most_stretch, striker, plan.depth);
    return dent;
}

// What is pressed has somebody on its far side, too: nothing of it goes farther that way than it reached.
void keep_before(const MetalView& metal, Vec3d push, double far_end) {
    MetalVertices& vertices = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        const Vec3d place(vertices.place[row]);
        const double over = dot(place, push) - far_end;
        if (over > 0 && !metal.is_pinned(v)) vertices.place.set(row, (place - over * push).to_float());
    }
}

}  // namespace

SheetMetal sheet_metal(const MetalView& view) {
    const ShellView& shell = view.shell;
    const MaterialRows& of = shell.state;
    const Row<Materials> material = shell.structures().material[shell.structure];
    SheetMetal metal;
    metal.thickness = double{shell.shells().thickness[shell.row]};
    if (material < of.material_traits.size()) {
        metal.yield_strain = double{of.material_traits.yield_strain[material]};
        metal.break_strain = double{of.material_traits.break_strain[material]};
    }
    // What is to tear before the material breaks is not stretched farther either.
    if (const double tears = view.row.exists() ? double{view.shells().tear_strain[view.row]} : 0; tears > 0)
        metal.break_strain = std::min(metal.break_strain, tears);
    metal.yield_stress = double{of.materials.young_modulus[material]} * metal.yield_strain;
    return metal;
}

bool is_elastic(const MetalView& metal, const Striker& striker, double energy) {
    if (striker.shape != StrikerShape::Sphere && metal.shells().crush_pressure[metal.row] > 0) return false;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)  // what find_sheet_place looks at
        metal.vertices().start.set(metal.vertex(v), metal.shell.state.vertices.rest[metal.shell.vertex(v)]);
    const Striker ball = along_dent(metal, round_striker(metal, striker));
    const SheetPlace place = find_sheet_place(metal, ball);
    return !plan_sheet(sheet_metal(metal), blow_at(place, ball, energy)).is_dent();
}

Dent work_dent(const MetalView& metal, const Striker& striker, double energy, bool goes_on) {
    begin(metal, goes_on);
    const bool is_closed = metal.shells().crush_pressure[metal.row] > 0;
    if (striker.shape != StrikerShape::Sphere && is_closed && !is_small(metal, striker))
        return crush_body(metal, striker, energy);
    const Striker ball = along_dent(metal, round_striker(metal, striker));
    const SheetPlace place = find_sheet_place(metal, ball);
    const SheetPlan plan = plan_sheet(sheet_metal(metal), blow_at(place, ball, energy));
    if (!plan.is_dent()) {
        Dent none;
        none.restitution = kMostBounce;
        return none;
    }
    if (is_closed && plan.contact > kWidest * place.support) return crush_body(metal, striker, energy);
    Dent dent = dent_sheet(metal, ball, place, plan, energy);
    if (!ends_within(striker) || !(ball.radius < place.support) || is_published(metal, kPublishedShape))
        dent.tearing = 0;
    return dent;
}

Dent press_dent(const MetalView& metal, const Striker& striker, double depth, double force) {
    begin(metal, false);
    Dent dent;
    const bool is_closed = metal.shells().crush_pressure[metal.row] > 0;
    if (force > 0 && is_closed) depth = std::min(depth, plan_crush(metal, striker, force * depth).depth);
    if (!(depth > 0)) return dent;
    dent.kind = is_closed ? DentKind::Body : DentKind::Sheet;
    dent.depth = dent.deep = depth;
    double far_end = -1e30;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        far_end = std::max(far_end, dot(Vec3d(metal.vertices().start[metal.vertex(v)]), striker.push));
    const double fold = kPressedFold * double{metal.shells().half_diagonal[metal.row]};
    raise_body(metal, striker, depth, std::max(kCrushReach * depth, fold));
    place_field(metal, striker.push);
    carry_creases(metal, depth, is_closed);
    clear_striker(metal, striker, depth);
    limit_stretch(metal, sheet_metal(metal).break_strain, striker, depth);
    if (!is_published(metal, kPublishedSprings)) turn_back(metal);
    clear_striker(metal, striker, depth);
    keep_before(metal, striker.push, far_end);
    return dent;
}

bool bake_dent(const MetalView& metal) {
    const ShellView& shell = metal.shell;
    Vertices& vertices = shell.state.vertices;
    const MetalVertices& own = metal.vertices();
    bool is_any = false;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        metal.vertices().start.set(metal.vertex(v), vertices.rest[shell.vertex(v)]);  // of what goes on it is not
        if (own.place[metal.vertex(v)] == own.start[metal.vertex(v)]) continue;
        vertices.rest.set(shell.vertex(v), own.place[metal.vertex(v)]);
        is_any = true;
    }
    if (!is_any) return false;
    turn_normals(metal);
    measure_shell(shell);
    return true;
}

}  // namespace cullet
