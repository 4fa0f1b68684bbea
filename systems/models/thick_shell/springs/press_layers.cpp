// Area and volume energies (thick shell note B4): E = kappa C^2 / 2 with C = (A - A0) / A0 of each triangle, outer and
// inner, and C = (V - V0) / V0 of each prism; F_i = -kappa C grad_i C. Without the damping kd dC/dt, for which the
// springs' own stands: it would need the neighbours' velocities while they are written.
#include "systems/models/thick_shell/springs/press_layers.hpp"

#include <algorithm>

#include "systems/models/thick_shell/springs/costs.hpp"
#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

/// B4: kappa_V <= 0.1 m h^2 / dt^2. And most of kappa sum |grad_i C|^2 dt^2 / m over an element's points, at rest and
/// now: what stretches far gets steeper, and cuts make slivers. An energy of more would blow the step up.
constexpr double kMostShare = 0.1, kMostSlope = 0.4;

struct Prism {
    Vec3d point[6];  // a, b, c, a', b', c'
};

double area_of(Vec3d i, Vec3d j, Vec3d k) {
    return 0.5 * length(cross(j - i, k - i));
}

/// Sum of |grad A|^2 over the corners, over `area` squared, 1/m2.
double area_slopes(Vec3d i, Vec3d j, Vec3d k, double area) {
    const Vec3d a = j - i, b = k - i, c = k - j;
    return (dot(a, a) + dot(b, b) + dot(c, c)) / (4 * area * area);
}

/// Gradient of the area of (i, j, k) over i; zero without area.
Vec3d area_gradient(Vec3d i, Vec3d j, Vec3d k) {
    const Vec3d a = j - i, b = k - i, n = normalised(cross(a, b));
    return -0.5 * (cross(b, n) + cross(n, a));
}

/// Corners of the prism's three tetrahedra (A7, as prism_tetrahedra cuts it), each in an order that gives its volume
/// the same sign: the sum is the prism's.
void tetrahedra_of(const std::array<uint32_t, 3>& corner, uint32_t (&tetrahedra)[3][4]) {
    uint32_t order[3] = {0, 1, 2};
    std::sort(order, order + 3, [&](uint32_t x, uint32_t y) { return corner[x] < corner[y]; });
    const auto [p, q, r] = order;
    const uint32_t all[3][4] = {{p, q, r, r + 3}, {p, q, r + 3, q + 3}, {p, p + 3, q + 3, r + 3}};
    std::copy(&all[0][0], &all[0][0] + 12, &tetrahedra[0][0]);
}

/// Six times the volume up to a sign that is the element's for good, and its gradient over the six points.
double volume_of(const Prism& prism, const uint32_t (&tetrahedra)[3][4], Vec3d (&gradient)[6]) {
    double six = 0;
    for (Vec3d& g : gradient) g = {};
    for (const auto& t : tetrahedra) {
        const Vec3d b = prism.point[t[1]] - prism.point[t[0]], c = prism.point[t[2]] - prism.point[t[0]],
                    d = prism.point[t[3]] - prism.point[t[0]];
        six += dot(b, cross(c, d));
        const Vec3d over[4] = {-(cross(c, d) + cross(d, b) + cross(b, c)), cross(c, d), cross(d, b), cross(b, c)};
        for (uint32_t k = 0; k < 4; ++k) gradient[t[k]] += over[k];
    }
    return six;
}

struct Presses {
    const SteppedView& view;
    int side;
    double dt, young, area_energy, volume_energy;

    Presses(const SteppedView& v, uint32_t current) : view(v), side(static_cast<int>(current)) {
        const ShellSprings& own = v.own();
        dt = own.time_step[v.row], young = own.young_modulus[v.row];
        area_energy = own.area_energy[v.row], volume_energy = own.volume_energy[v.row];
    }

    Vec3d now(uint32_t v) const {
        const Float4 p = view.state.vertices.probe.get(view.shell.vertex(v), side);
        return {p.x, p.y, p.z};
    }
    Vec3d twin_now(uint32_t v) const {
        const Float4 p = view.state.twins.position.get(view.twin(v), side);
        return {p.x, p.y, p.z};
    }

    /// Adds what the element does to corner k of it. What is asleep in a quick run does nothing.
    void add(uint32_t element, uint32_t k, Vec3d& outer, Vec3d& inner) const {
        if (view.state.element_springs.spring[view.edges(element)][0] == kAsleepSpring) return;
        const Elements& elements = view.state.elements;
        const uint32_t row = view.shell.element(element);
        const auto& corner = elements.corner[row];
        const bool has_layers = view.has_layers();
        Prism rest, moved;
        double depth = 0;
        for (uint32_t c = 0; c < 3; ++c) {
            rest.point[c] = outer_rest(view, corner[c]), moved.point[c] = now(corner[c]);
            depth += stiff_depth(view, corner[c]) / 3;
            if (has_layers) rest.point[c + 3] = inner_rest(view, corner[c]), moved.point[c + 3] = twin_now(corner[c]);
        }
        const double rest_area = area_of(rest.point[0], rest.point[1], rest.point[2]);
        if (!(rest_area > 0)) return;
        const double stiffness = young * depth * rest_area, mass = elements.mass[row] / (has_layers ? 6 : 3);
        const auto stretch = [&](uint32_t first, Vec3d& force) {
            const auto p = [&](const Prism& of, uint32_t c) { return of.point[first + (k + c) % 3]; };
            const double a0 = area_of(p(rest, 0), p(rest, 1), p(rest, 2));
            if (!(a0 > 0)) return;
            const double wanted = area_energy * stiffness * (has_layers ? 0.5 : 1);
            const double slopes = std::max(area_slopes(p(rest, 0), p(rest, 1), p(rest, 2), a0),
                                           area_slopes(p(moved, 0), p(moved, 1), p(moved, 2), a0));
            const double kappa = std::min(wanted, kMostSlope * mass / (dt * dt * slopes));
            const double c = area_of(p(moved, 0), p(moved, 1), p(moved, 2)) / a0 - 1;
            force += (-kappa * c / a0) * area_gradient(p(moved, 0), p(moved, 1), p(moved, 2));
        };
        if (area_energy > 0) stretch(0, outer);
        if (!has_layers) return;
        if (area_energy > 0) stretch(3, inner);
        if (!(volume_energy > 0) || (elements.flags[row] & kDegenerate)) return;
        uint32_t tetrahedra[3][4];
        tetrahedra_of(corner, tetrahedra);
        Vec3d gradient[6], gradient_at_rest[6];
        const double v0 = volume_of(rest, tetrahedra, gradient_at_rest), v = volume_of(moved, tetrahedra, gradient);
        if (!(v0 < 0 || v0 > 0)) return;
        double slopes = 0, slopes_at_rest = 0;
        for (uint32_t i = 0; i < 6; ++i)
            slopes += dot(gradient[i], gradient[i]), slopes_at_rest += dot(gradient_at_rest[i], gradient_at_rest[i]);
        const double height = depth * double{view.own().length_factor[view.row]};
        const double most =
            std::min(kMostShare * height * height, kMostSlope * v0 * v0 / std::max(slopes, slopes_at_rest));
        const double kappa = std::min(volume_energy * stiffness, most * mass / (dt * dt));
        const double pressure = -kappa * (v / v0 - 1) / v0;
        outer += pressure * gradient[k];
        inner += pressure * gradient[k + 3];
    }
};

}  // namespace

bool has_energies(const ShellSprings& springs, Row<ShellSprings> row) {
    return springs.area_energy[row] > 0 || springs.volume_energy[row] > 0;
}

uint64_t units_of_energies(const ShellSprings& springs, Row<ShellSprings> row) {
    const uint64_t edges = springs.springs[row].count, layers = springs.layers[row].capacity > 0 ? 2 : 1;
    return (springs.area_energy[row] > 0 ? layers * edges * kUnitsAreaEnergy : 0) +
           (springs.volume_energy[row] > 0 ? edges * kUnitsVolumeEnergy : 0);
}

void press_packs(const SteppedView& view, uint32_t side, uint32_t first_pack, uint32_t pack_count) {
    const Presses presses(view, side);
    Vertices& vertices = view.state.vertices;
    Twins& twins = view.state.twins;
    const uint32_t end = std::min((first_pack + pack_count) * kLanes, view.shell.vertex_count());
    Ring ring;
    for (uint32_t v = first_pack * kLanes; v < end; ++v) {
        walk_ring(view.shell, v, ring);
        Vec3d outer, inner;
        for (uint32_t i = 0; i < ring.count; ++i) presses.add(ring.element[i], ring.corner[i], outer, inner);
        const uint32_t row = view.shell.vertex(v);
        const double push =
            presses.dt * (view.has_layers() ? twins.inverse_mass[view.twin(v)] : vertices.inverse_mass[row]);
        vertices.velocity.set(row, vertices.velocity[row] + (push * outer).to_float());
        if (view.has_layers())
            twins.velocity.set(view.twin(v), twins.velocity[view.twin(v)] + (push * inner).to_float());
    }
}

}  // namespace cullet
