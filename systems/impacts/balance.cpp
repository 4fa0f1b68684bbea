#include "systems/impacts/balance.hpp"

#include <algorithm>

namespace cullet {
namespace {

// Gauss-Seidel on the least squares of force and moment: four supports are within a hundredth after 40 sweeps.
constexpr int kSweeps = 60;
// Of all forces what may be left over: on a slope of 8 degrees friction bears so much.
constexpr double kLeftOver = 0.15;

/// Force, N, and moment over the reach, N.
struct Wrench {
    Vec3d force, moment;
    void add(double newtons, const Wrench& unit) { force += newtons * unit.force, moment += newtons * unit.moment; }
};
double dot(const Wrench& a, const Wrench& b) {
    return dot(a.force, b.force) + dot(a.moment, b.moment);
}
Wrench unit_of(const BodyLoad& l, double reach) {
    return {l.push, (1 / reach) * cross(l.place, l.push)};
}

}  // namespace

bool balance(std::span<BodyLoad> loads, Vec3d weight, double reach) {
    Wrench left{weight, {}};
    for (BodyLoad& l : loads) {
        if (l.is_backed) l.force = 0;
        left.add(l.force, unit_of(l, reach));
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (BodyLoad& l : loads) {
            if (!l.is_backed) continue;
            const Wrench unit = unit_of(l, reach);
            const double force = std::max(0.0, l.force - dot(left, unit) / dot(unit, unit));
            left.add(force - l.force, unit);
            l.force = force;
        }
    double sum = length(weight);
    for (const BodyLoad& l : loads) sum += l.force;
    return length(left.force) + length(left.moment) < kLeftOver * sum;
}

}  // namespace cullet
