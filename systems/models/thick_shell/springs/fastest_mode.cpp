#include "systems/models/thick_shell/springs/fastest_mode.hpp"

#include <algorithm>

#include "systems/models/thick_shell/springs/edge_stiffness.hpp"
#include "systems/structures/shell/ring.hpp"

namespace cullet {
namespace {

constexpr int kIterations = 24;

/// The points of one element: outer corners, then inner ones.
using Field = Vec3d[6];

double area_of(const SpringView& view, uint32_t e) {
    const auto [a, b, c] = view.state.elements.corner[view.shell.element(e)];
    const Vec3d o = outer_rest(view, a);
    return 0.5 * length(cross(outer_rest(view, b) - o, outer_rest(view, c) - o));
}

/// One element cut out of its shell.
struct LoneElement {
    struct Edge {
        uint32_t a, b;
        double outer, inner, mid, cross;  // N/m
    };
    Field rest;
    Edge edge[3];
    double through[3] = {};  // of the internal springs
    uint32_t points;
    bool is_crossed;
    double inverse_mass;  // of each point that is free
    bool is_free[6] = {};

    LoneElement(const SpringView& view, uint32_t e) {
        const ShellRows& s = view.state;
        const uint32_t row = view.shell.element(e);
        const double area = area_of(view, e), mass = s.elements.mass[row];
        points = view.has_layers() ? 6 : 3;
        is_crossed = view.layout() == SpringLayout::Crossed;
        inverse_mass = mass > 0 ? points / mass : 0;
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t v = s.elements.corner[row][k], other = s.elements.neighbour[row][k];
            rest[k] = outer_rest(view, v);
            is_free[k] = is_free[3 + k] = !s.vertices.is_pinned[view.shell.vertex(v)];
            const double beside = other == kNone ? 0 : area_of(view, other);
            take_edge(view, e, k, area + beside > 0 ? area / (area + beside) : 1);
            if (!view.has_layers()) continue;
            rest[3 + k] = inner_rest(view, v);
            through[k] = twin_share(view, v, area);
        }
    }

    void take_edge(const SpringView& view, uint32_t e, uint32_t k, double share) {
        const ShellRows& s = view.state;
        const uint32_t spring = s.element_springs.spring[view.edges(e)][k];
        edge[k] = {k, (k + 1) % 3, 0, 0, 0, 0};
        if (spring >= view.spring_count()) return;
        edge[k].outer = share * double{s.springs.stiffness[view.spring(spring)]};
        if (!view.has_layers()) return;
        const uint32_t layer = view.layer(spring);
        edge[k].inner = share * double{s.layer_springs.inner_stiffness[layer]};
        edge[k].mid = share * double{s.layer_springs.mid_stiffness[layer]};
        edge[k].cross = share * double{s.layer_springs.cross_stiffness[layer]};
    }

    /// Of the internal spring, by area.
    static double twin_share(const SpringView& view, uint32_t v, double area) {
        const Twins& twins = view.state.twins;
        Ring ring;
        walk_ring(view.shell, v, ring);
        double all = 0;
        for (uint32_t i = 0; i < ring.count; ++i) all += area_of(view, ring.element[i]);
        const double k = double{twins.stiffness_rest[view.twin(v)]} * twins.inverse_rest[view.twin(v)];
        return all > 0 ? k * std::min(1.0, area / all) : k;
    }

    void add_spring(double k, uint32_t a, uint32_t b, const Field& u, Field& force) const {
        const Vec3d n = normalised(rest[b] - rest[a]), f = (k * dot(n, u[b] - u[a])) * n;
        force[a] += f;
        force[b] += -f;
    }
    /// Between the middles of two pairs: each point moves its own by half.
    void add_mid(const Edge& g, const Field& u, Field& force) const {
        const uint32_t a = g.a, b = g.b, c = 3 + a, d = 3 + b;
        const Vec3d n = normalised(rest[b] + rest[d] - rest[a] - rest[c]);
        const Vec3d f = (0.25 * g.mid * dot(n, u[b] + u[d] - u[a] - u[c])) * n;
        force[a] += f, force[c] += f;
        force[b] += -f, force[d] += -f;
    }
    /// Energy k / 2 (e1 - e2)^2 over the elongations of both diagonals.
    void add_shear(const Edge& g, const Field& u, Field& force) const {
        const uint32_t a = g.a, b = g.b, c = 3 + a, d = 3 + b;
        const Vec3d n = normalised(rest[b] - rest[c]), m = normalised(rest[d] - rest[a]);
        const double f = g.cross * (dot(n, u[b] - u[c]) - dot(m, u[d] - u[a]));
        force[b] += -f * n, force[c] += f * n;
        force[d] += f * m, force[a] += -f * m;
    }
    void add_forces(const Field& u, Field& force) const {
        for (const Edge& g : edge) {
            add_spring(g.outer, g.a, g.b, u, force);
            if (points == 3) continue;
            add_spring(g.inner, 3 + g.a, 3 + g.b, u, force);
            add_mid(g, u, force);
            if (!is_crossed) {
                add_shear(g, u, force);
                continue;
            }
            add_spring(g.cross, g.a, 3 + g.b, u, force);
            add_spring(g.cross, g.b, 3 + g.a, u, force);
        }
        for (uint32_t k = 0; k < 3 && points == 6; ++k) add_spring(through[k], k, 3 + k, u, force);
    }

    /// u <- K u, all masses being the same; the energy of u over its square grows to the largest eigenvalue. What is
    /// pinned does not move.
    double fastest() const {
        // Along no mode's symmetry.
        Field u = {{0.31, 0.93, -0.28}, {0.48, 0.52, 0.59}, {0.65, -0.71, 0.3},
                   {0.82, -0.71, 1.17}, {0.99, 0.52, 0.01}, {-1.16, 0.93, 0.88}};
        double found = 0;
        for (uint32_t i = 0; i < 6; ++i)
            if (!is_free[i]) u[i] = {};
        for (int k = 0; k < kIterations; ++k) {
            Field force = {};
            add_forces(u, force);
            double work = 0, square = 0, next = 0;
            for (uint32_t i = 0; i < points; ++i) {
                if (!is_free[i]) continue;
                work -= dot(u[i], force[i]);
                square += dot(u[i], u[i]);
                next += dot(force[i], force[i]);
            }
            if (!(next > 0)) return found;
            found = work / square;
            const double scale = -1 / std::sqrt(next);
            for (uint32_t i = 0; i < points; ++i) u[i] = is_free[i] ? scale * force[i] : Vec3d{};
        }
        return found * inverse_mass;
    }
};

}  // namespace

double fastest_mode(const SpringView& view) {
    double most = 0;
    for (uint32_t e = 0; e < view.shell.element_count(); ++e)
        if (!(view.state.elements.flags[view.shell.element(e)] & kDead))
            most = std::max(most, LoneElement(view, e).fastest());
    return most;
}

}  // namespace cullet
