#include "systems/models/metal_shell/published/hit_cells.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr double kMostTurn = 1;      // rad
constexpr double kLeastSize = 1e-9;  // m, of a move that counts

struct Triangle3 {
    Vec3d p, q, r;
    Vec3d centroid() const { return (1.0 / 3) * (p + q + r); }
    double area() const { return 0.5 * length(cross(q - p, r - p)); }
};
Triangle3 element_at_start(const MetalView& metal, uint32_t e) {
    const auto& c = metal.corners(e);
    const MetalVertices& v = metal.vertices();
    return {Vec3d(v.start[metal.vertex(c[0])]), Vec3d(v.start[metal.vertex(c[1])]), Vec3d(v.start[metal.vertex(c[2])])};
}

// The impulse is shared out by how deep each triangle's middle is in the striker, as springs would.
double spread_impulse(const MetalView& metal, const Striker& striker, double reach) {
    SubShells& cells = metal.cells();
    for (uint32_t c = 0; c < metal.cell_count(); ++c) {
        cells.impulse.set(metal.cell(c), {}), cells.moment.set(metal.cell(c), {});
        cells.is_touched[metal.cell(c)] = 0;
    }
    double sum = 0, nearest = 1e300;
    uint32_t touched = kNone;
    const auto add = [&](uint32_t e, Vec3d at, double share) {
        const uint32_t row = metal.cell(metal.cell_of(e));
        const Vec3d impulse = share * striker.push;
        cells.impulse.set(row, cells.impulse[row] + impulse.to_float());
        cells.moment.set(row, cells.moment[row] + cross(at, impulse).to_float());
        cells.is_touched[row] = 1;
        sum += share;
    };
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        if (metal.is_dead(e)) continue;
        const Triangle3 t = element_at_start(metal, e);
        const Vec3d way = t.centroid() - striker.point;
        if (dot(way, way) < nearest) nearest = dot(way, way), touched = e;
        const double covered = reach > 0 ? striker.covers(t.centroid(), reach) : 0;
        if (covered > 0) add(e, t.centroid() - striker.point, t.area() * covered);
    }
    // Arms are from the touch, here as well: the touch itself has none.
    if (!(sum > 0) && touched != kNone) add(touched, {}, 1);
    return sum;
}

Vec3d turned(Vec3d arm, Vec3d turn) {
    const double angle = length(turn);
    if (!(angle > 0)) return arm;
    double sine = 0, cosine = 1;
    sine_cosine(angle, sine, cosine);
    const Vec3d axis = (1 / angle) * turn;
    return cosine * arm + sine * cross(axis, arm) + ((1 - cosine) * dot(axis, arm)) * axis;
}

// MetalVertices.mover: the lowest sub-shell that is hit and that the vertex is part of.
void choose_movers(const MetalView& metal) {
    MetalVertices& vertices = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) vertices.mover[metal.vertex(v)] = kNoMover;
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        const auto cell = static_cast<uint16_t>(metal.cell_of(e));
        if (metal.is_dead(e) || !metal.cells().is_touched[metal.cell(cell)]) continue;
        for (const uint32_t v : metal.corners(e))
            vertices.mover[metal.vertex(v)] = std::min(vertices.mover[metal.vertex(v)], cell);
    }
}

Vec3d moved_with(const MetalView& metal, uint32_t cell, Vec3d start) {
    const SubShells& cells = metal.cells();
    const uint32_t row = metal.cell(cell);
    const Vec3d centre(cells.place[row]);
    return turned(start - centre, Vec3d(cells.turn[row])) + centre + Vec3d(cells.moved[row]);
}

}  // namespace

CellMove move_of_cell(double mass, const Sym3d& inertia, Vec3d impulse, Vec3d moment, double time) {
    return {(time / mass) * impulse, time * (inverse(inertia) * moment)};
}

CellMass mass_of_cell(const MetalView& metal, uint32_t cell) {
    const Shells& shells = metal.shell.shells();
    const Row<Materials> material = metal.shell.structures().material[metal.shell.structure];
    const double thickness = double{shells.thickness[metal.shell.row]};
    const double sheet = double{metal.shell.state.materials.density[material]} * thickness;
    CellMass of;
    Sym3d second;
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        if (metal.is_dead(e) || metal.cell_of(e) != cell) continue;
        const Triangle3 t = element_at_start(metal, e);
        const double m = sheet * t.area();
        of.mass += m;
        of.centre += m * t.centroid();
        second = second + (m / 12) * (outer(t.p) + outer(t.q) + outer(t.r) + outer(t.p + t.q + t.r));
    }
    if (!(of.mass > 0)) return of;
    of.centre = (1 / of.mass) * of.centre;
    of.inertia = inertia_of(second - of.mass * outer(of.centre));
    // A flat one is as thick as its sheet.
    const double thin = of.mass * thickness * thickness / 12;
    of.inertia.xx += thin, of.inertia.yy += thin, of.inertia.zz += thin;
    return of;
}

void move_hit_cells(const MetalView& metal, const Striker& striker, const CellBlow& blow) {
    SubShells& cells = metal.cells();
    MetalVertices& vertices = metal.vertices();
    const double sum = spread_impulse(metal, striker, blow.reach);
    double most = 0;
    for (uint32_t c = 0; c < metal.cell_count(); ++c) {
        const uint32_t row = metal.cell(c);
        cells.moved.set(row, {}), cells.turn.set(row, {}), cells.place.set(row, {});
        if (!cells.is_touched[row]) continue;
        const CellMass of = mass_of_cell(metal, c);
        if (!(of.mass > 0) || !(sum > 0)) {
            cells.is_touched[row] = 0;
            continue;
        }
        cells.place.set(row, of.centre.to_float());
        CellMove move{blow.depth * striker.push, {}};
        if (blow.is_by_mass) {
            const double share = (blow.impulse > 0 ? blow.impulse : 1) / sum;
            const Vec3d impulse = share * Vec3d(cells.impulse[row]);
            const Vec3d moment = share * Vec3d(cells.moment[row]) - cross(of.centre - striker.point, impulse);
            move = move_of_cell(of.mass, of.inertia, impulse, moment, blow.time > 0 ? blow.time : 1);
        }
        cells.moved.set(row, move.way.to_float());
        cells.turn.set(row, move.turn.to_float());
        most = std::max(most, length(move.way));
    }
    const bool is_scaled = blow.is_by_mass && !(blow.time > 0) && most > 0;
    for (uint32_t c = 0; c < metal.cell_count(); ++c) {
        const uint32_t row = metal.cell(c);
        if (!cells.is_touched[row]) continue;
        const auto scale = static_cast<float>(is_scaled ? blow.depth / most : 1);
        cells.moved.set(row, scale * cells.moved[row]);
        const Vec3d turn(scale * cells.turn[row]);
        cells.turn.set(row, (length(turn) > kMostTurn ? (kMostTurn / length(turn)) * turn : turn).to_float());
    }
    choose_movers(metal);
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        vertices.field[row] = 0;
        if (metal.is_pinned(v)) continue;
        const Vec3d start(vertices.start[row]);
        Vec3d place = start;
        if (blow.is_by_lowest) {
            if (vertices.mover[row] != kNoMover) place = moved_with(metal, vertices.mover[row], start);
        } else {
            for (uint32_t k = 0; k < kBlended; ++k) {
                const uint32_t cell = vertices.cell[row][k];
                if (cells.is_touched[metal.cell(cell)])
                    place += double{vertices.weight[row][k]} * (moved_with(metal, cell, start) - start);
            }
        }
        if (!(length(place - start) > kLeastSize)) continue;
        vertices.place.set(row, place.to_float());
        vertices.field[row] = static_cast<float>(std::max(kLeastSize, dot(place - start, striker.push)));
    }
}

}  // namespace cullet
