#include "engine/bullet/advance.hpp"

#include "engine/bullet/closest_points.hpp"

namespace cullet::bullet {
namespace {

constexpr float kThicknessShare = 0.1f;
// Lengths are those of pieces of scale 1, see lengths.hpp.
constexpr double kStop = 0.0005;  // m, the gap at which a sweep ends
constexpr double kAim = 0.0001;   // m: an advance aims this much past the gap to stop at, so that it ends in few rounds
// Cosines, of a degree, and of the ten by which the axis of two that just touch is off on a box of 2 km.
constexpr double kSameWay = 0.9998, kAboutTheSameWay = 0.985;
constexpr double kTouching = 0.001;  // m: pieces nearer than this at the start touch already
// How much deeper touching pieces may go in a step, m; two free ones also a share of the thinner one's width, until
// they are a third of it in each other: slabs of a house that comes down turn into each other by centimetres, and with
// a millimetre alone two thirds of their way are lost. Without a bound one of 800 shards in heaps ends 8 mm deep in
// others.
constexpr double kDeeper = 0.001, kDeeperShare = 0.1;
constexpr double kLeast = 0.0002;  // m that their cores stay apart, where they are, so that gaps can be measured
// Lively ones may go in all this share of the thinner one's width deep. Without it a sheet of 2 mm that strikes with
// its edge and spins at 400 rad/s works its way through a plate of a centimetre, a millimetre a step. From a half on
// sides are lost.
constexpr double kDepthShare = 1.0 / 3;
// What moves less in a step is pushed out faster than it works its way in. At 0 shards of a heap that lie deep in each
// other stand still at every wrong move and rock on; the larger, the more corners get past the middle of a shell of 4
// mm (here at most 5 of 10,000 spinning sheets; past its far side none).
constexpr double kLively = 0.03;   // m
constexpr double kMostTurn = 0.7;  // rad in a step, below which Bullet turns all of it
constexpr double kShort = 0.001;   // of the time left: as good as none
constexpr int kRounds = 48;        // then the body stops where it is

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

// The frame in which two pieces that touch are looked at: it turns with both, so that what spins as one is at rest in
// it. Their axis n turns along, dn/dt = w x n.
struct TurningFrame {
    Vec3d spin;    // rad/s
    Vec3d middle;  // m, between the centres of mass

    // Of two free bodies the mean spin; a body that is not free holds its contact's axis, and one whose face it is
    // (`holder`).
    static TurningFrame of(const Mover& a, const btTransform& at_a, const Mover& b, const btTransform& at_b,
                           const Mover* holder, float dt) {
        TurningFrame frame;
        frame.middle = 0.5 * (Vec3d(from_bullet(at_a.getOrigin())) + Vec3d(from_bullet(at_b.getOrigin())));
        frame.spin = holder               ? holder->spin
                     : !a.body->is_free() ? a.spin
                     : !b.body->is_free() ? b.spin
                                          : 0.5 * (a.spin + b.spin);
        if (std::max(length(a.spin), length(b.spin)) * dt >= kMostTurn) frame.spin = {};
        return frame;
    }
    Vec3d turned(Vec3d axis, double seconds) const {
        if (!(dot(spin, spin) > 0)) return axis;
        btTransform out;
        btTransformUtil::integrateTransform(btTransform::getIdentity(), btVector3(0, 0, 0), to_bullet(spin.to_float()),
                                            static_cast<float>(seconds), out);
        return Vec3d(from_bullet(out.getBasis() * to_bullet(axis.to_float())));
    }
    // Minus the second derivative of n . D, of two centres D apart that move away at V:
    // -(2 (w x n) . V + (w x (w x n)) . D), and a third of what the third one can add in `seconds`. What opens the gap
    // does not count.
    double bend(Vec3d axis, Vec3d apart, Vec3d velocity, double seconds) const {
        const Vec3d turning = cross(spin, axis);
        const double rate = length(spin);
        const double third = rate * rate * ((3 + rate * seconds) * length(velocity) + rate * length(apart));
        return std::max(0.0, third * seconds / 3 - 2 * dot(turning, velocity) - dot(cross(spin, turning), apart));
    }
};

// Where a set of points is along an axis, and how fast it moves there: height + speed t - bend t^2 / 2 bounds every
// point from below. `sign` -1 mirrors the axis, so that what is highest becomes what is lowest.
struct Approach {
    float height[kMaxPoints], speed[kMaxPoints];  // m from the points' centre, m/s
    uint32_t count = 0;
    double bend = 0;  // m/s^2: turning at d in a frame that turns at w takes a point r from the centre of mass along
                      // the axis by (d x r) . n t, to less than |d| (|d| + |w|) |r| t^2 / 2

    // Bullet turns by at most an eighth of a turn in a step and stands still after: turning helps only below that. What
    // another body has stopped already (`is_stopped`) only stands there.
    Approach(const Points& points, const Mover& mover, const btTransform& at, Vec3d axis, double sign, float reach,
             float dt, bool is_stopped, const TurningFrame& frame)
        : count(points.count) {
        const Vec3 n = (sign * axis).to_float();
        if (is_stopped) {
            for (uint32_t k = 0; k < count; ++k) {
                height[k] = n.x * points.x[k] + n.y * points.y[k] + n.z * points.z[k];
                speed[k] = 0;
            }
            return;
        }
        const Vec3d spin = mover.spin - frame.spin;
        const Vec3 lever = cross(n, spin.to_float());  // (w x r) . n = (n x w) . r
        const Vec3 arm = points.centre - from_bullet(at.getOrigin());
        const Vec3d from_middle = Vec3d(from_bullet(at.getOrigin())) - frame.middle;
        const double moving_in_frame = dot(mover.velocity, axis) + dot(cross(frame.spin, axis), from_middle);
        const float moving = static_cast<float>(sign * moving_in_frame), swinging = dot(lever, arm);
        const double rate = length(spin);
        bend = rate * (rate + length(frame.spin)) * reach;
        const bool turns_on = length(mover.spin) * dt < kMostTurn;
        for (uint32_t k = 0; k < count; ++k) {
            const float x = points.x[k], y = points.y[k], z = points.z[k];
            const float turning = swinging + (lever.x * x + lever.y * y + lever.z * z);
            height[k] = n.x * x + n.y * y + n.z * z;
            speed[k] = moving + (turns_on ? turning : std::min(turning, 0.0f));
        }
    }
    struct Low {
        double height, speed;
    };
    Low lowest(double t) const {
        const auto time = static_cast<float>(t);
        float least = kFar;
        uint32_t which = 0;
        for (uint32_t k = 0; k < count; ++k) {
            const float h = height[k] + speed[k] * time;
            if (h < least) least = h, which = k;
        }
        return {static_cast<double>(least) - 0.5 * bend * t * t, static_cast<double>(speed[which]) - bend * t};
    }
};

// How long the gap along an axis stays above `stop`: all of `left`, or less, to within half of `aim`. The bound of the
// gap is concave, so that Newton's steps from the end come down to the time from above, doubling their digits; twelve
// are more than they need.
double time_until(const Approach& a, const Approach& b, double apart, double stop, double left, double aim) {
    constexpr int kSteps = 12;
    double t = left;
    for (int step = 0; step < kSteps; ++step) {
        const Approach::Low low = a.lowest(t), high = b.lowest(t);
        const double room = apart + low.height + high.height - stop, closing = -(low.speed + high.speed);
        if (room >= 0 || !(closing > 0)) break;
        t = std::max(0.0, t + room / closing);
        if (room > -0.5 * aim) break;
    }
    return t;
}

}  // namespace

Mover mover_of(Body& body) {
    Mover out{&body, body.bullet->getWorldTransform(), {}, {}};
    const bool is_moving = body.is_free() || (body.kind == RigidKind::Kinematic && body.bullet->isActive());
    if (!is_moving) return out;
    out.velocity = Vec3d(from_bullet(body.bullet->getLinearVelocity()) + body.glance);
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

bool is_far(double way, float scale, float thickness) {
    return way > static_cast<double>(scale * kContactRange + kThicknessShare * thickness);
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

bool KnownAxes::at_crack(const Hull& a, const Hull& b) const {
    if (!pair || a.one_sided || b.one_sided) return false;
    return is_turned ? pair->meet_at_crack(b.ordinal, a.ordinal) : pair->meet_at_crack(a.ordinal, b.ordinal);
}

namespace {

/// Where two pieces come to a touch.
struct Meeting {
    const Surroundings& around;
    const Mover &a, &b;
    const Hull &hull_a, &hull_b;
    const Points &now_a, &now_b;  // where they are by then
    const btTransform &at_a, &at_b;
    const Closest& closest;

    // Along `axis`, from b towards a: where that is an edge inside of something flat, of b or of a, it becomes that of
    // an open face there.
    Push turn_on(bool is_of_b, Vec3d& axis) const;
};

Push Meeting::turn_on(bool is_of_b, Vec3d& axis) const {
    const Mover& mover = is_of_b ? b : a;
    const Hull &hull = is_of_b ? hull_b : hull_a, &piece = is_of_b ? hull_a : hull_b;
    if (!may_have_inner_edges(*mover.body, hull)) return Push::AsFound;
    Vec3 normal = (is_of_b ? axis : -axis).to_float();
    Vec3 place = now_a.centre + (is_of_b ? closest.on_b : closest.on_a).to_float() + hull.margin * normal;
    // World points are those of the step's start: what its body moved since is undone for both.
    const Points* points = is_of_b ? &now_a : &now_b;
    Points seen;
    Mat3 back = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (mover.body->kind != RigidKind::Static) {
        const btTransform undo = mover.body->fresh_at * mover.body->hulls_at(is_of_b ? at_b : at_a).inverse(),
                          other = undo * (is_of_b ? a : b).body->hulls_at(is_of_b ? at_a : at_b);
        back = rotation_of(undo);
        normal = back * normal;
        place = from_bullet(undo * to_bullet(place));
        transform_points(piece, rotation_of(other), from_bullet(other.getOrigin()), seen);
        points = &seen;
    }
    const Touched touched{*mover.body, hull, *(is_of_b ? a : b).body, piece, *points};
    Push push = Push::Turned;
    if (closest.is_apart)
        push = turn_to_open_face(around, touched, {&place, 1}, normal);
    else if (!is_firm(*mover.body))
        push = Push::AsFound;
    else if (!find_open_face(around, touched, points->centre, normal))
        push = Push::None;
    if (push != Push::Turned) return push;
    normal = transposed_times(back, normal);
    axis = is_of_b ? Vec3d(normal) : -Vec3d(normal);
    return push;
}

// The axis of a contact may be off that of a large face by a tenth of a degree. The far end of the face then seems to
// lie millimetres deep, and what slides on it would not move at all: of both pieces' faces that look the same way the
// one along which they are the farthest apart is better.
Vec3d flattest_near(const Mover& a, const Hull& hull_a, const Mover& b, const Hull& hull_b, Vec3d met,
                    double least_cosine) {
    Vec3d best = met;
    double most = gap_along(hull_a.world, hull_b.world, met);
    for (const bool is_of_b : {true, false}) {
        const Hull& hull = is_of_b ? hull_b : hull_a;
        const Mat3 rotation = rotation_of((is_of_b ? b : a).body->fresh_at);
        for (uint32_t f = 0; f < hull.face_count; ++f) {
            const Vec3d out(hull.one_sided ? hull.face_normal[f] : rotation * hull.face_normal[f]);
            const Vec3d axis = is_of_b ? out : -1.0 * out;
            if (!(dot(axis, met) > least_cosine)) continue;
            const double gap = gap_along(hull_a.world, hull_b.world, axis);
            if (gap > most) most = gap, best = axis;
        }
    }
    return best;
}

// m that a piece may go behind the face of another that it comes to along `axis`; 0: it closes too fast, and is to
// stop. Over floors most of a step's way leads aside; what of it leads inwards is pushed out on the right side when it
// is not far, see is_far(). What glides nearer than the gap to stop at would otherwise stop at each triangle or piece
// that comes: fast shards lost a third of their way over hills, and planks of pieces over planks as much.
// Between convex pieces that is only for what hardly turns: of 10,000 spinning shards two left a shell of cells.
double goes_deeper(const Mover& a, const Hull& hull_a, const Mover& b, const Hull& hull_b, Vec3d axis, double turning,
                   float dt) {
    const double scale = static_cast<double>(scale_of(hull_a, hull_b)),
                 margins = static_cast<double>(hull_a.margin) + hull_b.margin;
    const bool has_triangle = hull_a.one_sided || hull_b.one_sided;
    const float thickness = hull_a.one_sided ? hull_b.thickness : hull_a.thickness;
    const double least = scale * kDeeper,
                 most = has_triangle ? std::max(least, static_cast<double>(kThicknessShare * thickness)) : least;
    if ((turning + dot(axis, b.velocity - a.velocity)) * dt < most) return most;
    if (!has_triangle && turning * dt >= most) return 0;
    const bool is_gliding = gap_along(hull_a.world, hull_b.world, axis) - margins < scale * kTouching;
    return is_gliding ? least : 0;
}

}  // namespace

double touch_fraction(const Surroundings& around, const Mover& a, const Hull& hull_a, const Mover& b,
                      const Hull& hull_b, float dt, double limit, Vec3d& axis, const KnownAxes& known) {
    const double turning = length(a.spin) * reach_of(*a.body, hull_a) + length(b.spin) * reach_of(*b.body, hull_b);
    // Where the two were stopped at different times one goes on alone after the first of them.
    const double fraction_a = static_cast<double>(a.body->moved_fraction),
                 fraction_b = static_cast<double>(b.body->moved_fraction);
    const bool is_split = are_split(*a.body, *b.body);
    const double split = is_split ? std::min({fraction_a, fraction_b, limit}) : limit;
    const Vec3d first = b.velocity - a.velocity, second = fraction_a < fraction_b ? b.velocity : -a.velocity;
    if (!is_split && pass_by(hull_a, hull_b, (dt * limit) * first, turning * dt * limit)) return limit;
    const double margins = static_cast<double>(hull_a.margin) + hull_b.margin;
    Points points_a, points_b;
    const Points *now_a = &hull_a.world, *now_b = &hull_b.world;
    const float reach_a = reach_of(*a.body, hull_a), reach_b = reach_of(*b.body, hull_b);
    const double scale = static_cast<double>(scale_of(hull_a, hull_b)), aim = scale * kAim;
    double t = 0, stop = scale * kStop;
    bool is_at_stop = false;        // all but there
    const Mover* holder = nullptr;  // of the axis, where it was turned to a face
    // The pair's contact, found where the two stand now, has the axis.
    const Vec3d met = known.of(hull_a, hull_b);
    bool is_axis_fixed = dot(met, met) > 0.5;
    if (is_axis_fixed) {
        const bool are_free = a.body->is_free() && b.body->is_free();
        const bool is_deep = !are_free && gap_along(hull_a.world, hull_b.world, met) - margins < -scale * kDeeper;
        axis = is_deep ? flattest_near(a, hull_a, b, hull_b, met, kSameWay) : met;
    }
    const bool is_lively = (turning + std::max(length(first), is_split ? length(second) : 0)) * dt > scale * kLively;
    for (int round = 0; round < kRounds; ++round) {
        const btTransform at_a = a.at(t, dt), at_b = b.at(t, dt);
        if (round > 0) {
            const btTransform hulls_a = a.body->hulls_at(at_a), hulls_b = b.body->hulls_at(at_b);
            transform_points(hull_a, rotation_of(hulls_a), from_bullet(hulls_a.getOrigin()), points_a);
            transform_points(hull_b, rotation_of(hulls_b), from_bullet(hulls_b.getOrigin()), points_b);
            now_a = &points_a, now_b = &points_b;
        }
        const double left = dt * (limit - t), together = dt * std::max(split - t, 0.0);
        double gap = -1;
        double deeper = 0;  // m, behind a face beside the edge that was met, or one that it glides onto
        if (!is_axis_fixed) {
            const Closest closest = closest_points(*now_a, *now_b, axis, turning * left + margins + scale * kStop,
                                                   {together * first, (left - together) * second});
            axis = closest.axis;
            if (closest.is_beyond) return limit;
            if (closest.is_apart || round == 0) gap = gap_along(*now_a, *now_b, axis) - margins;
            if (round == 0 && gap < -scale * kDeeper && !(a.body->is_free() && b.body->is_free())) {
                axis = flattest_near(a, hull_a, b, hull_b, axis, kAboutTheSameWay);
                gap = gap_along(*now_a, *now_b, axis) - margins;
            }
            if (is_at_stop || gap < (round == 0 ? scale * kTouching : stop)) {
                const Meeting meeting{around, a, b, hull_a, hull_b, *now_a, *now_b, at_a, at_b, closest};
                // First that which no solver moves: the faces of a shard or a pane are as wavy as its cells.
                const bool is_b_first = is_firm(*b.body) || !is_firm(*a.body);
                Push push = meeting.turn_on(is_b_first, axis);
                if (push == Push::Turned) holder = is_b_first ? &b : &a;
                if (push == Push::AsFound) {
                    push = meeting.turn_on(!is_b_first, axis);
                    if (push == Push::Turned) holder = is_b_first ? &a : &b;
                }
                if (push == Push::None) return limit;
                const bool is_beside = push == Push::Turned;
                if (is_beside || round > 0) deeper = goes_deeper(a, hull_a, b, hull_b, axis, turning, dt);
                if (is_beside) deeper = std::max(deeper, scale * kDeeper);
                if (is_at_stop && !(deeper > 0)) return t;
                is_at_stop = false;
            }
        } else {
            gap = gap_along(*now_a, *now_b, axis) - margins;
        }
        if (deeper > 0) {
            // The face is there already: no deeper behind it than what touches it may go.
            is_axis_fixed = true;
            gap = gap_along(*now_a, *now_b, axis) - margins;
            stop = gap < scale * kTouching ? gap - deeper : scale * kStop;
        } else if (round == 0 && gap < scale * kTouching) {
            // They touch: the solver has slowed them where they do, but the rest of a piece may still swing in.
            const double width = std::min(width_along(hull_a, *now_a, axis), width_along(hull_b, *now_b, axis));
            const double third = -kDepthShare * width;
            const bool are_free = a.body->is_free() && b.body->is_free();
            const double deepest = is_lively ? third : -kFar;
            double allowed = gap - scale * kDeeper;
            if (are_free) allowed = std::min(allowed, std::max(gap - kDeeperShare * width, third));
            stop = std::max({allowed, scale * kLeast - margins, deepest});
            // Where the cores (nearly) overlap there is no gap to measure: along the axis of least overlap they may go
            // deeper by as much.
            is_axis_fixed = stop >= gap;
            if (is_axis_fixed) stop = std::min(gap, std::max(allowed, deepest));
        } else if (round == 0) {
            is_axis_fixed = false;
        }
        if (gap < stop) return t;
        const bool is_alone = is_split && t >= split;
        const double rest = is_split && !is_alone ? together : dt * (1 - t);
        TurningFrame frame;
        if (is_axis_fixed && !is_alone) frame = TurningFrame::of(a, at_a, b, at_b, holder, dt);
        Approach coming_a(*now_a, a, at_a, axis, 1, reach_a, dt, is_alone && fraction_a < fraction_b, frame);
        const Approach coming_b(*now_b, b, at_b, axis, -1, reach_b, dt, is_alone && fraction_b < fraction_a, frame);
        coming_a.bend +=
            frame.bend(axis, Vec3d(from_bullet(at_a.getOrigin() - at_b.getOrigin())), a.velocity - b.velocity, rest);
        const double apart = dot(axis, Vec3d(now_a->centre) - Vec3d(now_b->centre)) - margins;
        // Along an axis that stays there is nothing new to measure at the stop. All of the step counts, whatever the
        // limit, so that a flight which is foreseen ends in the same bits.
        const double taken = time_until(coming_a, coming_b, apart, is_axis_fixed ? stop : stop - aim, rest, aim);
        if (taken >= left) return limit;
        if (is_split && !is_alone && taken >= together) {
            t = split;
            axis = frame.turned(axis, together);
            continue;
        }
        t += taken / dt;
        axis = frame.turned(axis, taken);
        if (taken >= kShort * rest) continue;
        if (is_axis_fixed) return t;
        is_at_stop = true;
    }
    return t;
}

}  // namespace cullet::bullet
