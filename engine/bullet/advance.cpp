#include "engine/bullet/advance.hpp"

#include "engine/bullet/closest_points.hpp"
#include "engine/bullet/overlap_axis.hpp"

namespace cullet::bullet {
namespace {

constexpr float kThicknessShare = 0.1f;
constexpr double kStop = 0.0005;  // m, the gap at which a sweep ends
constexpr double kAim = 0.0001;   // m: an advance aims this much past the gap to stop at, so that it ends in few rounds
constexpr double kTouching = 0.001;  // m: pieces nearer than this at the start touch already
constexpr double kDeeper = 0.001;    // m that touching pieces may go deeper in a step,
constexpr double kLeast = 0.0002;    // m: while their cores stay this far apart, so that gaps can be measured,
// and lively ones in all this share of the thinner one's width. Without it a sheet of 2 mm that strikes with its edge
// and spins at 400 rad/s works its way through a plate of a centimetre, a millimetre a step. From a half on sides are
// lost.
constexpr double kDepthShare = 1.0 / 3;
// What moves less in a step is pushed out faster than it works its way in. At 0 shards of a heap that lie deep in each
// other stand still at every wrong move and rock on; at 0.05 one corner of 10,000 sheets gets past the middle.
constexpr double kLively = 0.03;    // m
constexpr double kTurning = 0.004;  // m, see overlap_axis()
constexpr int kRounds = 48;         // then the body stops where it is: early, never late

// The spheres about both pieces do not meet on a straight way, turning included.
bool pass_by(const Hull& a, const Hull& b, Vec3d way, double turning) {
    const Vec3d from = Vec3d(b.world.centre) - Vec3d(a.world.centre);
    const double square = dot(way, way);
    const double along = square > 0 ? std::clamp(-dot(from, way) / square, 0.0, 1.0) : 0;
    const Vec3d nearest = from + along * way;
    const double reach = static_cast<double>(a.radius) + b.radius + a.margin + b.margin + turning + kStop;
    return dot(nearest, nearest) > reach * reach;
}

double width_along(const Hull& hull, const Points& points, Vec3d axis) {
    if (hull.one_sided) return kFar;
    const Vec3 direction = axis.to_float();
    const Vec3d high(points[support(points, direction)]), low(points[support(points, -direction)]);
    return dot(axis, high - low) + 2 * static_cast<double>(hull.margin);
}

}  // namespace

Mover mover_of(Body& body) {
    Mover out{&body, body.bullet->getWorldTransform(), {}, {}};
    const bool is_moving = body.is_free() || (body.kind == RigidKind::Kinematic && body.bullet->isActive());
    if (!is_moving) return out;
    out.velocity = Vec3d(from_bullet(body.bullet->getLinearVelocity()));
    out.spin = Vec3d(from_bullet(body.bullet->getAngularVelocity()));
    return out;
}

float turned(const Mover& mover, float reach, float dt) {
    return std::min(static_cast<float>(length(mover.spin)) * dt, 2.0f) * reach;
}

void include_way(Box& out, const Box& box, Vec3d velocity, float dt) {
    const Vec3 way = (static_cast<double>(dt) * velocity).to_float();
    include(out, box.low + way);
    include(out, box.high + way);
}

Box swept_box(const Box& box, const Mover& mover, float reach, float dt) {
    Box out = box;
    include_way(out, box, mover.velocity, dt);
    return grown(out, turned(mover, reach, dt) + kBoxGrowth);
}

bool are_split(const Body& a, const Body& b) {
    return a.is_fast && b.is_fast && a.moved_fraction != b.moved_fraction;
}

bool is_far(double way, float thickness) {
    return way > kContactRange + kThicknessShare * thickness;
}

bool may_meet_more(double way) {
    return way > kContactRange;
}

double travel(const Mover& mover, float dt) {
    return (length(mover.velocity) + length(mover.spin) * mover.body->reach) * dt;
}

float reach_of(const Body& body, const Hull& hull) {
    const Vec3 from = body.has_offset ? hull.local.centre - body.hull_centre : hull.local.centre;
    return length(from) + hull.radius;
}

Vec3d KnownAxes::of(const Hull& a, const Hull& b) const {
    if (!pair || a.one_sided || b.one_sided) return {};
    return is_turned ? -Vec3d(pair->axis_of(b.ordinal, a.ordinal)) : Vec3d(pair->axis_of(a.ordinal, b.ordinal));
}

double touch_fraction(const Mover& a, const Hull& hull_a, const Mover& b, const Hull& hull_b, float dt, double limit,
                      Vec3d& axis, const KnownAxes& known, bool has_moved) {
    const double turning = length(a.spin) * reach_of(*a.body, hull_a) + length(b.spin) * reach_of(*b.body, hull_b);
    // A body that was stopped earlier in the step may stand still by now: then each motion alone counts too.
    const bool is_stopped = are_split(*a.body, *b.body);
    const Vec3d nothing, first = is_stopped ? -a.velocity : b.velocity - a.velocity,
                         second = is_stopped ? b.velocity : nothing;
    if (!is_stopped && pass_by(hull_a, hull_b, (dt * limit) * first, turning * dt * limit)) return limit;
    const double margins = static_cast<double>(hull_a.margin) + hull_b.margin;
    Points points_a, points_b;
    const Points *now_a = &hull_a.world, *now_b = &hull_b.world;
    double t = 0, stop = kStop;
    bool is_axis_fixed = false;
    const bool is_lively = (turning + length(first) + length(second)) * dt > kLively;
    for (int round = 0; round < kRounds; ++round) {
        if (round > 0 || has_moved) {
            const btTransform at_a = a.body->hulls_at(a.at(t, dt)), at_b = b.body->hulls_at(b.at(t, dt));
            transform_points(hull_a, rotation_of(at_a), from_bullet(at_a.getOrigin()), points_a);
            transform_points(hull_b, rotation_of(at_b), from_bullet(at_b.getOrigin()), points_b);
            now_a = &points_a, now_b = &points_b;
        }
        const double left = dt * (limit - t);
        double gap = -1;
        if (!is_axis_fixed) {
            const Closest closest =
                closest_points(*now_a, *now_b, axis, turning * left + margins + kStop, {left * first, left * second});
            axis = closest.axis;
            if (closest.is_beyond) return limit;
            if (round == 0 && !closest.is_apart && !has_moved && is_lively) {
                const OverlapAxis least =
                    overlap_axis(hull_a, rotation_of(a.body->fresh_at), hull_b, rotation_of(b.body->fresh_at),
                                 known.of(hull_a, hull_b), kTurning);
                if (least.is_found) axis = least.axis;
            }
            if (closest.is_apart || round == 0) gap = gap_along(*now_a, *now_b, axis) - margins;
        } else {
            gap = gap_along(*now_a, *now_b, axis) - margins;
        }
        if (round == 0 && gap < kTouching) {
            // They touch: the solver has slowed them where they do, but the rest of a piece may still swing in.
            const double deepest = is_lively ? -kDepthShare * std::min(width_along(hull_a, *now_a, axis),
                                                                       width_along(hull_b, *now_b, axis))
                                             : -kFar;
            stop = std::max({gap - kDeeper, kLeast - margins, deepest});
            // Where the cores (nearly) overlap there is no gap to measure: along the axis of least overlap they may go
            // deeper by as much.
            is_axis_fixed = stop >= gap;
            if (is_axis_fixed) stop = std::min(gap, std::max(gap - kDeeper, deepest));
        }
        if (gap < stop) return t;
        const double one = dot(first, axis), other = dot(second, axis);
        const double closing = turning + (is_stopped ? std::max(0.0, one) + std::max(0.0, other) : one);
        if (!(closing > 1e-6)) return limit;
        t += (gap - stop + kAim) / (closing * dt);
        if (t >= limit) return limit;
    }
    return t;
}

}  // namespace cullet::bullet
