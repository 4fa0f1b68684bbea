#include "systems/fragments/stop_approach.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr double kClosed = 0.001;
constexpr uint32_t kMostSweeps = 80;  // at a third of them a fifth more pairs are seen in each other later
constexpr uint32_t kSweepsAFullOne = 4;

void prepare(Touch& t, std::span<const Touching> bodies) {
    const Touching &a = bodies[t.a], &b = bodies[t.b];
    t.arm_a = t.point - a.centre;
    t.arm_b = t.point - b.centre;
    const Vec3d lever_a = cross(t.arm_a, t.normal), lever_b = cross(t.arm_b, t.normal);
    t.turn_a = a.inverse_inertia * lever_a;
    t.turn_b = b.inverse_inertia * lever_b;
    const double give = a.inverse_mass + b.inverse_mass + dot(lever_a, t.turn_a) + dot(lever_b, t.turn_b);
    t.stiffness = give > 0 ? 1 / give : 0;
    t.impulse = 0;
}

// The speed at which it closed.
double stop(Touch& t, std::span<Touching> bodies) {
    Touching &a = bodies[t.a], &b = bodies[t.b];
    const Vec3d parting = a.velocity + cross(a.spin, t.arm_a) - b.velocity - cross(b.spin, t.arm_b);
    const double closing = -dot(parting, t.normal);
    const double impulse = std::max(0.0, t.impulse + t.stiffness * closing), more = impulse - t.impulse;
    if (more == 0) return 0;
    t.impulse = impulse;
    a.velocity += more * a.inverse_mass * t.normal;
    a.spin += more * t.turn_a;
    b.velocity -= more * b.inverse_mass * t.normal;
    b.spin -= more * t.turn_b;
    return closing;
}

}  // namespace

void stop_approach(std::span<Touching> bodies, std::span<Touch> touches, double speed) {
    for (Touch& t : touches) prepare(t, bodies);
    for (uint32_t sweep = 0; sweep < kMostSweeps; ++sweep) {
        const bool is_full = sweep % kSweepsAFullOne == 0;
        double fastest = 0;
        for (Touch& t : touches)
            if (is_full || t.impulse > 0) fastest = std::max(fastest, stop(t, bodies));
        if (is_full && !(fastest > kClosed * speed)) break;
    }
}

}  // namespace cullet
