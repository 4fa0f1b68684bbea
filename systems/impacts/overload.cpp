#include "systems/impacts/overload.hpp"

#include <algorithm>
#include <cmath>

#include "engine/principal_axes.hpp"

namespace cullet {
namespace {

// A body that has cracks bears half, as for blows (kWakeShare).
constexpr double kCrackedShare = 0.5;
// Below it two that close on a body stand still, m/s; opposite to each other is what is within 37 degrees of it.
constexpr double kDrivenSpeed = 1e-3, kOpposite = -0.8;
// What falls and lands is stopped by contacts on one side for some steps, and is no beam under a load: in a heap that
// comes down slabs broke once more. Of a load the other contacts bear all but the body's own weight.
constexpr double kBalancedShare = 0.3;
// What is less slender does not bend before it is crushed.
constexpr double kSlender = 3;

double strength(const State& state, Row<Bodies> body) {
    const Row<Shells> shell = state.bodies.shell[body];
    const double whole =
        double{state.bodies.strength_scale[body]} * state.materials.tensile_strength[state.shells.material[shell]];
    return state.shells.has_cracks[shell] ? kCrackedShare * whole : whole;
}
double solid_volume(const State& state, Row<Bodies> body) {
    return state.bodies.mass[body] / state.materials.density[state.shells.material[state.bodies.shell[body]]];
}

bool is_supported(const Bodies& bodies, Row<Bodies> body) {
    return static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Static;
}

/// N along and against a direction: what pushes, and what could be borne.
struct Sides {
    double along = 0, against = 0, bears_along = 0, bears_against = 0;
    double squeeze() const { return std::max(std::min(along, bears_against), std::min(against, bears_along)); }
};

void squeeze(bool is_pinned, std::span<const BodyLoad> loads, double borne, Overload& worst) {
    for (const BodyLoad& of : loads) {
        if (!(of.force > 0)) continue;
        Sides s;
        if (is_pinned) s.bears_along = s.bears_against = kBearsAll;
        for (const BodyLoad& l : loads) {
            const double c = dot(of.push, l.push);
            (c > 0 ? s.along : s.against) += std::abs(c) * l.force;
            (c > 0 ? s.bears_along : s.bears_against) += std::abs(c) * l.bears;
        }
        const double force = s.squeeze();
        worst.load = std::max(worst.load, force);
        if (force > worst.share * borne) worst.share = force / borne;
    }
}

bool are_closing(bool is_pinned, std::span<const BodyLoad> loads) {
    for (const BodyLoad& a : loads) {
        if (is_pinned && a.driven_speed > kDrivenSpeed) return true;
        for (const BodyLoad& b : loads)
            if (a.driven_speed > kDrivenSpeed && b.stands && dot(a.push, b.push) < kOpposite &&
                a.driven_speed + b.driven_speed > kDrivenSpeed)
                return true;
    }
    return false;
}

/// The body along its principal axes.
struct Beam {
    double low[3], high[3], modulus[3][3];  // m from the centre; m3 of sections across i, bent along j
    Vec3d axis[3];

    Beam(const State& state, Row<Bodies> body) {
        const PrincipalAxes principal = principal_axes(state.bodies.inertia[body]);
        const Vec3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int i = 0; i < 3; ++i) axis[i] = Vec3d(rotate(principal.axes, unit[i])), low[i] = 1e30, high[i] = -1e30;
        const Range vertices = state.shells.vertices[state.bodies.shell[body]];
        for (uint32_t v = vertices.first; v < vertices.first + vertices.count; ++v) {
            if (state.vertices.element[v] == kNone) continue;
            const Vec3d outer = Vec3d(state.vertices.rest[v]) - state.bodies.centre[body];
            const Vec3d inner = outer + double{state.vertices.depth[v]} * Vec3d(state.vertices.inward[v]);
            for (int i = 0; i < 3; ++i) {
                const double p = dot(axis[i], outer), q = dot(axis[i], inner);
                low[i] = std::min({low[i], p, q}), high[i] = std::max({high[i], p, q});
            }
        }
        const double moment[3] = {principal.moments.x, principal.moments.y, principal.moments.z};
        const double volume = solid_volume(state, body), sum = moment[0] + moment[1] + moment[2];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const double square = std::max(0.0, (0.5 * sum - moment[j]) / state.bodies.mass[body]);
                modulus[i][j] = volume * square / (length(i) * std::max(high[j], -low[j]));
            }
    }
    double length(int i) const { return std::max(high[i] - low[i], 1e-9); }
};

// Free: the loads to one side of a section, and the even rest; its largest values are at loads.
double free_moment(const Beam& beam, int i, int j, std::span<const BodyLoad> loads) {
    double sum = 0, most = 0;
    for (const BodyLoad& l : loads) sum += l.force * dot(beam.axis[j], l.push);
    for (const BodyLoad& at : loads) {
        const double x = dot(beam.axis[i], at.place), way = std::max(0.0, x - beam.low[i]);
        double moment = -0.5 * sum / beam.length(i) * way * way;
        for (const BodyLoad& l : loads) {
            const double arm = x - dot(beam.axis[i], l.place);
            if (arm > 0) moment += arm * l.force * dot(beam.axis[j], l.push);
        }
        most = std::max(most, std::abs(moment));
    }
    return most;
}

/// Along the axis, m: how far the nearest pins are from a place, to both sides.
struct Span {
    double before = 1e30, behind = 1e30;
    double moment(double force) const {
        if (before < 1e29 && behind < 1e29)
            return before + behind > 0 ? force * before * behind / (before + behind) : 0;
        const double arm = std::min(before, behind);
        return arm < 1e29 ? force * arm : 0;
    }
};
double pinned_moment(const State& state, Row<Bodies> body, const Beam& beam, int i, int j,
                     std::span<const BodyLoad> loads) {
    const Range vertices = state.shells.vertices[state.bodies.shell[body]];
    double moment = 0;
    for (const BodyLoad& l : loads) {
        const double force = l.force * dot(beam.axis[j], l.push), x = dot(beam.axis[i], l.place);
        Span span;
        for (uint32_t v = vertices.first; v < vertices.first + vertices.count; ++v) {
            if (state.vertices.element[v] == kNone || !state.vertices.is_pinned[v]) continue;
            const double to = dot(beam.axis[i], Vec3d(state.vertices.rest[v]) - state.bodies.centre[body]) - x;
            if (to >= 0) span.behind = std::min(span.behind, to);
            if (to <= 0) span.before = std::min(span.before, -to);
        }
        moment += span.moment(force);
    }
    return std::abs(moment);
}

void bend(const State& state, Row<Bodies> body, bool is_pinned, std::span<const BodyLoad> loads, Overload& worst) {
    const Beam beam(state, body);
    const double stress = strength(state, body);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            if (i == j || beam.length(i) < kSlender * beam.length(j)) continue;
            const double moment =
                is_pinned ? pinned_moment(state, body, beam, i, j, loads) : free_moment(beam, i, j, loads);
            const double bearable = stress * beam.modulus[i][j];
            if (moment > worst.share * bearable) worst.share = moment / bearable;
        }
}

}  // namespace

double force_borne(const State& state, Row<Bodies> body) {
    const Row<Shells> shell = state.bodies.shell[body];
    const double whole = double{state.bodies.strength_scale[body]} * state.shells.first_crack_force[shell];
    return state.shells.has_cracks[shell] ? kCrackedShare * whole : whole;
}

// In the middle of a span of its whole size: 4 M / L with the modulus of a flat sheet of its wall, V h / (6 L). All
// shapes of that wall and size are stiffer.
double least_bending_force(const State& state, Row<Bodies> body) {
    const double size = std::max(2 * double{state.bodies.radius[body]}, 1e-9);
    return 4 * strength(state, body) * solid_volume(state, body) * state.shells.thickness[state.bodies.shell[body]] /
           (6 * size * size);
}

Overload overload_of(const State& state, Row<Bodies> body, std::span<const BodyLoad> loads) {
    Overload worst;
    double most = -1;
    for (const BodyLoad& l : loads) {
        // Where the blow that stands for the load is to fall: by whom drives, else by the hardest push.
        const double rank = l.driven_speed > kDrivenSpeed ? kBearsAll : l.force;
        if (rank <= most) continue;
        most = rank;
        worst.contact = l.contact;
    }
    const bool is_pinned = is_supported(state.bodies, body);
    squeeze(is_pinned, loads, force_borne(state, body), worst);
    double sum = 0;
    Vec3d net;
    for (const BodyLoad& l : loads) sum += l.force, net += l.force * l.push;
    const bool is_at_rest = is_pinned || length(net) < kBalancedShare * sum;
    if (is_at_rest && sum > least_bending_force(state, body)) bend(state, body, is_pinned, loads, worst);
    worst.is_driven = are_closing(is_pinned, loads);
    return worst;
}

}  // namespace cullet
