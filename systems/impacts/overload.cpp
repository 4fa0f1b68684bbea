#include "systems/impacts/overload.hpp"

#include <algorithm>
#include <cmath>

#include "engine/principal_axes.hpp"
#include "systems/impacts/balance.hpp"
#include "systems/impacts/closing.hpp"

namespace cullet {
namespace {

// A body that has cracks bears half, as for blows (kWakeShare).
constexpr double kCrackedShare = 0.5;
// Whoever lies deeper in it, as a share of its wall and of its size, closes on it however slowly it comes.
constexpr double kDeepInWall = 0.1, kDeepInAll = 0.01;
// What falls and lands is stopped by contacts on one side for some steps, and is no beam under a load: in a heap that
// comes down slabs broke once more. Of a load the other contacts bear all but the body's own weight.
constexpr double kBalancedShare = 0.3;
// Of a bracket's arm: how near to its pins it breaks.
constexpr double kOffPins = 0.95;
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

/// N m, the largest, and where it is along the axis, m from the centre.
struct Moment {
    double size = 0, at = 0;
};

// Free: the loads to one side of a section, and the even rest; its largest values are at loads.
Moment free_moment(const Beam& beam, int i, int j, std::span<const BodyLoad> loads) {
    Moment most;
    double sum = 0;
    for (const BodyLoad& l : loads) sum += l.force * dot(beam.axis[j], l.push);
    for (const BodyLoad& at : loads) {
        const double x = dot(beam.axis[i], at.place), way = std::max(0.0, x - beam.low[i]);
        double moment = -0.5 * sum / beam.length(i) * way * way;
        for (const BodyLoad& l : loads) {
            const double arm = x - dot(beam.axis[i], l.place);
            if (arm > 0) moment += arm * l.force * dot(beam.axis[j], l.push);
        }
        if (std::abs(moment) > most.size) most = {std::abs(moment), x};
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
    /// From the place to the largest moment; off the pins, so that the cut is not among them.
    double to_largest() const {
        if (before < 1e29 && behind < 1e29) return 0;
        return before < behind ? -kOffPins * before : behind < 1e29 ? kOffPins * behind : 0;
    }
};
/// Along an axis, from the frame's origin, m.
struct Held {
    double low, high;
};

// A pinned vertex, and all of the boxes around it: what lies in a wall is held as far as the wall goes.
Held held_by(const State& state, Row<Bodies> body, Vec3d axis, uint32_t vertex) {
    const Vec3 at = state.vertices.rest[vertex];
    Held held{dot(axis, Vec3d(at)), dot(axis, Vec3d(at))};
    const Range boxes = state.bodies.pins[body];
    for (uint32_t p = boxes.first; p < boxes.first + boxes.count; ++p) {
        const Vec3 low = state.pin_boxes.low[p], high = state.pin_boxes.high[p];
        const auto is_between = [&](float l, float v, float h) { return l <= v && v <= h; };
        if (!is_between(low.x, at.x, high.x) || !is_between(low.y, at.y, high.y) || !is_between(low.z, at.z, high.z))
            continue;
        const Vec3d half = 0.5 * (Vec3d(high) - Vec3d(low));
        const double middle = dot(axis, 0.5 * (Vec3d(low) + Vec3d(high)));
        const double reach = std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
        held = {std::min(held.low, middle - reach), std::max(held.high, middle + reach)};
    }
    return held;
}

Span span_at(const State& state, Row<Bodies> body, Vec3d axis, double at) {
    Span span;
    const Range vertices = state.shells.vertices[state.bodies.shell[body]];
    for (uint32_t v = vertices.first; v < vertices.first + vertices.count; ++v) {
        if (state.vertices.element[v] == kNone || !state.vertices.is_pinned[v]) continue;
        const Held held = held_by(state, body, axis, v);
        if (held.low <= at && at <= held.high) return {0, 0};
        if (held.high < at) span.before = std::min(span.before, at - held.high);
        if (held.low > at) span.behind = std::min(span.behind, held.low - at);
    }
    return span;
}

// Of a bracket it is largest where the pins end.
Moment pinned_moment(const State& state, Row<Bodies> body, const Beam& beam, int i, int j,
                     std::span<const BodyLoad> loads) {
    double moment = 0, most = 0, at = 0;
    for (const BodyLoad& l : loads) {
        const double force = l.force * dot(beam.axis[j], l.push), x = dot(beam.axis[i], l.place);
        const Span span = span_at(state, body, beam.axis[i], x + dot(beam.axis[i], Vec3d(state.bodies.centre[body])));
        const double own = span.moment(force);
        moment += own;
        if (std::abs(own) <= most) continue;
        most = std::abs(own);
        at = x + span.to_largest();
    }
    return {std::abs(moment), at};
}

double sum_of(std::span<const BodyLoad> loads) {
    double sum = 0;
    for (const BodyLoad& l : loads) sum += l.force;
    return sum;
}

void bend(const State& state, Row<Bodies> body, bool is_pinned, std::span<const BodyLoad> loads, Overload& worst) {
    const Beam beam(state, body);
    const double stress = strength(state, body);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            if (i == j || beam.length(i) < kSlender * beam.length(j)) continue;
            const Moment moment =
                is_pinned ? pinned_moment(state, body, beam, i, j, loads) : free_moment(beam, i, j, loads);
            const double bearable = stress * beam.modulus[i][j];
            if (moment.size <= worst.share * bearable) continue;
            worst.share = moment.size / bearable;
            worst.load = std::max(worst.load, 0.5 * sum_of(loads));
            worst.section = state.bodies.centre[body] + moment.at * beam.axis[i];
            worst.section_normal = beam.axis[i];
        }
}

// Where the blow that stands for the load is to fall, when nobody drives: by the hardest push of what lies on it.
const BodyLoad& hardest(std::span<const BodyLoad> loads) {
    size_t hardest = 0;
    double most = -1;
    for (const BodyLoad& l : loads) {
        const double rank = l.is_backed ? 1e-12 * l.force : l.force;
        if (rank <= most) continue;
        most = rank;
        hardest = static_cast<size_t>(&l - loads.data());
    }
    return loads[hardest];
}

// What is squeezed splits along the push, across its longest side: the axis of least inertia.
Vec3d split_normal(const Bodies& bodies, Row<Bodies> body, Vec3d push) {
    const PrincipalAxes principal = principal_axes(bodies.inertia[body]);
    const double moment[3] = {principal.moments.x, principal.moments.y, principal.moments.z};
    const Vec3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vec3d best;
    double least = 1e300;
    for (int i = 0; i < 3; ++i) {
        const Vec3d axis(rotate(principal.axes, unit[i]));
        const Vec3d across = axis - dot(axis, push) * push;
        if (length(across) < 0.5 || moment[i] >= least) continue;
        least = moment[i];
        best = across;
    }
    return normalised(best);
}

ClosingBody closing_body(const State& state, Row<Bodies> body) {
    const double wall = state.shells.thickness[state.bodies.shell[body]], size = 2 * double{state.bodies.radius[body]};
    return {is_supported(state.bodies, body), state.bodies.radius[body],
            std::min(kDeepInWall * wall, kDeepInAll * size)};
}

bool are_balanced(std::span<const BodyLoad> loads) {
    Vec3d net;
    for (const BodyLoad& l : loads) net += l.force * l.push;
    return length(net) < kBalancedShare * sum_of(loads);
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

Overload overload_of(const State& state, Row<Bodies> body, std::span<BodyLoad> loads, Vec3d weight,
                     std::span<BodyLoad> room) {
    Overload worst;
    if (loads.empty()) return worst;
    const bool is_pinned = is_supported(state.bodies, body);
    const Closing closing = closing_on(closing_body(state, body), loads, room);
    const BodyLoad at = closing.driver ? *closing.driver : hardest(loads);
    worst.is_driven = closing.driver != nullptr;
    worst.is_between = closing.is_between;
    worst.driven_speed = worst.is_driven ? at.driven_speed : 0;
    worst.contact = at.contact;
    worst.section = state.bodies.centre[body] + 0.5 * at.place;
    worst.section_normal = split_normal(state.bodies, body, at.push);
    squeeze(is_pinned, loads, force_borne(state, body), worst);
    const auto may_bend = [&] { return sum_of(loads) > least_bending_force(state, body); };
    if (may_bend() && (is_pinned || are_balanced(loads) || balance(loads, weight, state.bodies.radius[body])) &&
        may_bend())
        bend(state, body, is_pinned, loads, worst);
    return worst;
}

}  // namespace cullet
