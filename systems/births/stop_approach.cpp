#include "systems/births/stop_approach.hpp"

#include <algorithm>
#include <cmath>

namespace cullet {
namespace {

// Faces of a crack are rough: what slides along one has to climb its teeth, so that it opens by this much of what it
// slides (the dilation of rock joints, 30 degrees). Smooth faces let shards spin on at their rims' speed among
// neighbours that they leave at a tenth of it, and hit them in the next frames. Of 1,000 random breaks the tenth that
// loses most then loses 6 to 8 % of its energy in 3 steps, so 2.3 and 1.3. At 1 twice as many pairs are seen in each
// other later.
constexpr double kDilation = 0.6;
constexpr double kSteep = 0.857492925712544;  // 1 / sqrt(1 + kDilation^2), the cosine of a tooth's slope
// Points on a turning body bend towards its axis: a crack that opens too slowly closes again. It has to stay open for
// so long, s, while neither turns farther than this, rad.
constexpr double kAhead = 0.05, kMostTurned = 0.5;
constexpr double kClosed = 0.001;
constexpr uint32_t kMostSweeps = 80;  // at half of them a third more shards of quick breaks are struck by others later
// Full sweeps find touches that have come to need one, ever more rarely: every fourth one took twice as long, for the
// same figures.
constexpr uint32_t kFirstUntilFull = 2;

// w x (w x r) along n, by dots alone.
double inwards(Vec3d spin, Vec3d arm, Vec3d normal) {
    return dot(spin, normal) * dot(spin, arm) - dot(spin, spin) * dot(arm, normal);
}

// Columns of one row, as the sweeps go over them.
struct Touch {
    Vec3d normal, arm_a, arm_b;
};

// Along the normal, 1/2 a t of the points' accelerations w x (w x r), where it leads into each other: m/s.
double bending(const Touch& t, const Touching& a, const Touching& b) {
    const double closing = inwards(b.spin, t.arm_b, t.normal) - inwards(a.spin, t.arm_a, t.normal);
    if (!(closing > 0)) return 0;
    constexpr double kFast = (kMostTurned / kAhead) * (kMostTurned / kAhead);
    const double square = std::max(dot(a.spin, a.spin), dot(b.spin, b.spin));
    return 0.5 * closing * (square > kFast ? kMostTurned / std::sqrt(square) : kAhead);
}

// The speed that was missing.
double stop(Touches& touches, uint32_t row, Touching& a, Touching& b) {
    const Touch t{touches.normal[row], touches.arm_a[row], touches.arm_b[row]};
    const Vec3d parting = a.velocity + cross(a.spin, t.arm_a) - b.velocity - cross(b.spin, t.arm_b);
    const double opening = dot(parting, t.normal);
    const Vec3d sliding = parting - opening * t.normal;
    const double lacking = bending(t, a, b) - opening, square_slide = dot(sliding, sliding);
    // Where lacking <= -kDilation * slide it opens fast enough.
    if (lacking <= 0 && lacking * lacking >= kDilation * kDilation * square_slide) return 0;
    // Up the slope of the tooth that it slides against.
    const double slide = std::sqrt(square_slide);
    const Vec3d along = slide > 0 ? kSteep * t.normal - (kSteep * kDilation / slide) * sliding : t.normal;
    const double missing = slide > 0 ? kSteep * (lacking + kDilation * slide) : lacking;
    const Vec3d lever_a = cross(t.arm_a, along), lever_b = cross(t.arm_b, along);
    const Vec3d turn_a = a.inverse_inertia * lever_a, turn_b = b.inverse_inertia * lever_b;
    const double give = a.inverse_mass + b.inverse_mass + dot(lever_a, turn_a) + dot(lever_b, turn_b);
    if (!(give > 0)) return 0;
    const double impulse = missing / give;
    touches.impulse.set(row, touches.impulse[row] + impulse * along);
    a.velocity += impulse * a.inverse_mass * along;
    a.spin += impulse * turn_a;
    b.velocity -= impulse * b.inverse_mass * along;
    b.spin -= impulse * turn_b;
    return missing;
}

}  // namespace

void stop_approach(std::span<Touching> bodies, uint32_t first, Touches& touches, Rows<Touches> of, double speed) {
    for (const Row<Touches> t : of) {
        touches.arm_a.set(t, touches.point[t] - bodies[touches.a[t] - first].centre);
        touches.arm_b.set(t, touches.point[t] - bodies[touches.b[t] - first].centre);
        touches.impulse.set(t, {});
        touches.is_used[t] = 0;
    }
    uint32_t next_full = 0, until_full = kFirstUntilFull;
    for (uint32_t sweep = 0; sweep < kMostSweeps; ++sweep) {
        const bool is_full = sweep >= next_full;
        double most = 0;
        for (const Row<Touches> t : of) {
            if (!is_full && !touches.is_used[t]) continue;
            const double missing = stop(touches, t, bodies[touches.a[t] - first], bodies[touches.b[t] - first]);
            touches.is_used[t] = touches.is_used[t] || missing > 0;
            most = std::max(most, missing);
        }
        const bool is_settled = !(most > kClosed * speed);
        if (is_full && is_settled) break;
        if (is_full) next_full = sweep + until_full, until_full += until_full / 2;
        if (is_settled) next_full = sweep + 1;
    }
}

}  // namespace cullet
