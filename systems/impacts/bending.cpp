#include "systems/impacts/bending.hpp"

#include <algorithm>
#include <cmath>

#include "engine/principal_axes.hpp"

namespace cullet {
namespace {

// Of a bracket's arm: how near to its pins it breaks.
constexpr double kOffPins = 0.95;
// What is less slender does not bend before it is crushed.
constexpr double kSlender = 3;

/// The body along its principal axes.
struct Beam {
    double modulus[3][3];  // m3 of sections across i, bent along j
    Vec3d axis[3];
    std::array<Reach, 3> reach;

    explicit Beam(const LoadedBody& of) {
        const PrincipalAxes principal = principal_axes(of.bodies.inertia[of.body]);
        const Vec3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int i = 0; i < 3; ++i) axis[i] = Vec3d(rotate(principal.axes, unit[i]));
        reach = of.reach(axis);
        const double moment[3] = {principal.moments.x, principal.moments.y, principal.moments.z};
        const double volume = of.solid_volume(), sum = moment[0] + moment[1] + moment[2];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const double square = std::max(0.0, (0.5 * sum - moment[j]) / of.bodies.mass[of.body]);
                modulus[i][j] = volume * square / (length(i) * std::max(high(j), -low(j)));
            }
    }
    double low(int i) const { return reach[static_cast<size_t>(i)].low; }
    double high(int i) const { return reach[static_cast<size_t>(i)].high; }
    double length(int i) const { return std::max(high(i) - low(i), 1e-9); }
};

/// N m, the largest, and where it is along the axis, m from the centre.
struct Moment {
    double size = 0, at = 0;
};

/// Sections of a free body along axis i, bent along j.
struct FreeBar {
    const Beam& beam;
    int i, j;
    std::span<const BodyLoad> loads;
    const Underlay* under;
    double even;  // N/m, of the weight, and of what would accelerate it, along axis j
    Moment most;

    // Where the moment is positive the bar bulges against axis j.
    bool sags_onto_somebody(double at, bool is_positive) const {
        if (!under) return false;
        return under->way_through(at * beam.axis[i], (is_positive ? -1.0 : 1.0) * beam.axis[j], loads) >= 0;
    }
    // Of the forces before it, their sum and their sum times place.
    void look(double at, double sum, double turning) {
        const double way = std::max(0.0, at - beam.low(i)), moment = at * sum - turning - 0.5 * even * way * way;
        if (std::fabs(moment) > most.size && !sags_onto_somebody(at, moment > 0)) most = {std::fabs(moment), at};
    }
};

// The forces to one side of a section, and the even rest: largest at a load, or between two where the shear force is
// zero. Only what is larger than `least` is looked for.
Moment free_moment(const Beam& beam, int i, int j, std::span<const BodyLoad> loads, std::span<AxisForce> forces,
                   const Underlay* under, double least) {
    double all = 0;
    for (size_t l = 0; l < loads.size(); ++l) {
        forces[l] = {dot(beam.axis[i], loads[l].place), loads[l].force * dot(beam.axis[j], loads[l].push)};
        all += forces[l].force;
    }
    std::sort(forces.begin(), forces.begin() + static_cast<ptrdiff_t>(loads.size()),
              [](AxisForce a, AxisForce b) { return a.at != b.at ? a.at < b.at : a.force < b.force; });
    FreeBar bar{beam, i, j, loads, under, all / beam.length(i), {least, 0}};
    double sum = 0, turning = 0;
    for (size_t l = 0; l < loads.size(); ++l) {
        bar.look(forces[l].at, sum, turning);
        sum += forces[l].force;
        turning += forces[l].force * forces[l].at;
        if (bar.even == 0 || l + 1 == loads.size()) continue;
        const double still = beam.low(i) + sum / bar.even;
        if (forces[l].at < still && still < forces[l + 1].at) bar.look(still, sum, turning);
    }
    return bar.most;
}

// From the place to the largest moment; off the pins, so that the cut is not among them.
double to_largest(const HeldSpan& span) {
    if (span.before < 1e29 && span.behind < 1e29) return 0;
    return span.before < span.behind ? -kOffPins * span.before : span.behind < 1e29 ? kOffPins * span.behind : 0;
}

// Of a bracket it is largest where the pins end.
Moment pinned_moment(const LoadedBody& of, const Beam& beam, const HeldParts& held, int i, int j,
                     std::span<const BodyLoad> loads) {
    const double centre = dot(beam.axis[i], of.bodies.centre[of.body]);
    double moment = 0, most = 0, at = 0;
    for (const BodyLoad& l : loads) {
        const double force = l.force * dot(beam.axis[j], l.push), x = dot(beam.axis[i], l.place);
        const HeldSpan span = held.span_at(x + centre);
        const double own = span.moment(force);
        moment += own;
        if (std::fabs(own) <= most) continue;
        most = std::fabs(own);
        at = x + to_largest(span);
    }
    return {std::fabs(moment), at};
}

}  // namespace

// In the middle of a span of its whole size: 4 M / L with the modulus of a flat sheet of its wall, V h / (6 L). All
// shapes of that wall and size are stiffer.
double least_bending_force(const LoadedBody& of) {
    const double size = std::max(2 * double{of.bodies.radius[of.body]}, 1e-9);
    return 4 * of.strength() * of.solid_volume() * of.wall() / (6 * size * size);
}

void bend(const LoadedBody& of, std::span<const BodyLoad> loads, std::span<AxisForce> forces, const Underlay* under,
          Overload& worst) {
    if (forces.size() < loads.size()) return;
    const Beam beam(of);
    double sum = 0;
    for (const BodyLoad& l : loads) sum += l.force;
    for (int i = 0; i < 3; ++i) {
        const auto is_bent_along = [&](int j) { return i != j && beam.length(i) >= kSlender * beam.length(j); };
        if (!is_bent_along(0) && !is_bent_along(1) && !is_bent_along(2)) continue;
        const HeldParts held = of.held_along(beam.axis[i]);
        for (int j = 0; j < 3; ++j) {
            if (!is_bent_along(j)) continue;
            const double bearable = of.strength() * beam.modulus[i][j], least = worst.share * bearable;
            const Moment moment = of.is_pinned() ? pinned_moment(of, beam, held, i, j, loads)
                                                 : free_moment(beam, i, j, loads, forces, under, least);
            if (moment.size <= least) continue;
            worst.share = moment.size / bearable;
            worst.load = std::max(worst.load, 0.5 * sum);
            worst.section = of.bodies.centre[of.body] + moment.at * beam.axis[i];
            worst.section_normal = beam.axis[i];
        }
    }
}

}  // namespace cullet
