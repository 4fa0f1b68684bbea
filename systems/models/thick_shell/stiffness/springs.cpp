// Coupled springs and hinges from the rest shape (thick shell note B3).
#include <algorithm>

#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/models/thick_shell/stiffness/element_stiffness.hpp"

namespace cullet {
namespace {

double least_depth(const ShellView& shell) {
    const double floor = shell.shells().depth_floor[shell.row];
    return floor > 0 ? floor : 0.05 * shell.shells().thickness[shell.row];
}

Vec3d rest(const ShellView& shell, uint32_t vertex) {
    return Vec3d(shell.state.vertices.rest[shell.vertex(vertex)]);
}

double depth(const ShellView& shell, uint32_t vertex) {
    return shell.state.vertices.depth[shell.vertex(vertex)];
}

double mean_depth(const ShellView& shell, uint32_t a, uint32_t b, uint32_t c) {
    return std::max((depth(shell, a) + depth(shell, b) + depth(shell, c)) / 3, least_depth(shell));
}

/// One side of a hinge: the triangle on edge 0-1 with the corner `o` opposite.
struct Flap {
    Vec3d slope;     // normal / altitude, 1/m
    double foot;     // of the altitude, 0 at vertex 0 and 1 at vertex 1
    double area;     // m2
    bool is_usable;  // has area
};
Flap make_flap(Vec3d p0, Vec3d p1, Vec3d o, double sign) {
    const Vec3d edge = p1 - p0, n = sign * cross(edge, o - p0);
    const double twice = length(n), squared = dot(edge, edge);
    if (!(twice > 0) || !(squared > 0)) return {{}, 0, 0, false};
    // altitude = twice / |edge|
    return {(std::sqrt(squared) / (twice * twice)) * n, dot(o - p0, edge) / squared, 0.5 * twice, true};
}

/// Share of one triangle, on edge 0-1 with the corner `o` opposite, in its hinge's own term: the diagonal of
/// BendingTerms, h^3/12 C_pp L^2/(4A) with p the edge's normal in the plane.
double grained_hinge(const ShellView& shell, const GrainModuli& grain, uint32_t v0, uint32_t v1, uint32_t o) {
    const Vec3d p0 = rest(shell, v0), edge = rest(shell, v1) - p0, side = rest(shell, o) - p0;
    const double squared = dot(edge, edge);
    const Vec3d along = (1 / std::sqrt(squared)) * edge, up = side - dot(side, along) * along;
    const double altitude = length(up);
    const double h = mean_depth(shell, v0, v1, o);
    const PlaneStiffness c = grain_stiffness(grain, (1 / altitude) * up, along);
    return h * h * h / 12 * c.c11 * std::sqrt(squared) / (2 * altitude);
}

}  // namespace

void assemble_element(ShellView shell, uint32_t element) {
    TriangleSprings& springs = shell.state.triangle_springs;
    const uint32_t row = shell.element(element);
    const auto [a, b, c] = shell.state.elements.corner[row];
    const Vec3d ab = rest(shell, b) - rest(shell, a), ac = rest(shell, c) - rest(shell, a);
    const Vec3d n = cross(ab, ac);
    const double l = length(ab), twice_area = length(n);
    springs.clear_rows(row, 1);
    springs.scale[row] = 1;
    springs.thickness[row] = static_cast<float>(mean_depth(shell, a, b, c));
    if (!(l > 0) || !(twice_area > 0)) return;
    const Vec3d x = (1 / l) * ab, y = cross((1 / twice_area) * n, x);
    const double cx = dot(ac, x), cy = dot(ac, y), area = 0.5 * twice_area;
    springs.axis_x.set(row, x.to_float());
    springs.axis_y.set(row, y.to_float());
    springs.inverse_edges.set(
        row, {static_cast<float>(1 / l), static_cast<float>(-cx / (l * cy)), static_cast<float>(1 / cy)});
    springs.area[row] = static_cast<float>(area);
    const auto altitude = [&](double dx, double dy) {
        return static_cast<float>(twice_area / std::sqrt(dx * dx + dy * dy));
    };
    springs.altitude.set(row, {altitude(l, 0), altitude(cx - l, cy), altitude(cx, cy)});
}

uint32_t assemble_hinge(ShellView shell, uint32_t hinge) {
    Hinges& hinges = shell.state.hinges;
    const uint32_t row = shell.hinge(hinge);
    const auto v = hinges.vertex[row];
    hinges.gradient[row] = {};
    hinges.stiffness[row] = 0;
    hinges.scale[row] = 1;
    if (v[0] == kNone) return hinge;
    const Vec3d p0 = rest(shell, v[0]), p1 = rest(shell, v[1]);
    const Flap one = make_flap(p0, p1, rest(shell, v[2]), 1), two = make_flap(p0, p1, rest(shell, v[3]), -1);
    if (!one.is_usable || !two.is_usable) return hinge;
    const Vec3d g1 = -(one.foot * one.slope + two.foot * two.slope);
    const Vec3d g0 = -(one.slope + two.slope + g1);
    const Vec3d gradient[4] = {g0, g1, one.slope, two.slope};
    for (uint32_t i = 0; i < 4; ++i)
        for (int k = 0; k < 3; ++k)
            hinges.gradient[row][3 * i + static_cast<uint32_t>(k)] = static_cast<float>(gradient[i][k]);
    const PlaneStress stress = plane_stress(shell.state, shell.structure);
    if (stress.has_grain) {
        hinges.stiffness[row] = static_cast<float>(grained_hinge(shell, stress.grain, v[0], v[1], v[2]) +
                                                   grained_hinge(shell, stress.grain, v[0], v[1], v[3]));
        return hinge;
    }
    const Row<Materials> material = shell.structures().material[shell.structure];
    const double e = shell.state.materials.young_modulus[material], nu = shell.state.materials.poisson_ratio[material];
    const double h = 0.5 * (mean_depth(shell, v[0], v[1], v[2]) + mean_depth(shell, v[0], v[1], v[3]));
    const double bending = e * h * h * h / (12 * (1 - nu * nu));
    hinges.stiffness[row] = static_cast<float>(bending * dot(p1 - p0, p1 - p0) / (one.area + two.area));
    return hinge;
}

void assemble_springs(ShellView shell) {
    const Elements& elements = shell.state.elements;
    Hinges& hinges = shell.state.hinges;
    for (uint32_t h = 0; h < shell.hinge_count(); ++h) hinges.vertex[shell.hinge(h)] = {kNone, kNone, kNone, kNone};
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        if (elements.flags[row] & kDead) continue;
        assemble_element(shell, e);
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t other = elements.neighbour[row][k], hinge = elements.hinge[row][k];
            if (hinge == kNone || other == kNone || other < e) continue;
            const auto& corner = elements.corner[row];
            const auto& theirs = elements.corner[shell.element(other)];
            const uint32_t from = corner[k], to = corner[(k + 1) % 3];
            uint32_t opposite = kNone;
            for (const uint32_t v : theirs)
                if (v != from && v != to) opposite = v;
            hinges.vertex[shell.hinge(hinge)] = {from, to, corner[(k + 2) % 3], opposite};
        }
    }
    for (uint32_t h = 0; h < shell.hinge_count(); ++h) assemble_hinge(shell, h);
}

}  // namespace cullet
