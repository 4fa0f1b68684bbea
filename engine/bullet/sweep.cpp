#include "engine/bullet/sweep.hpp"

#include <LinearMath/btTransformUtil.h>

#include <algorithm>
#include <utility>

#include "engine/bullet/bullet_world.hpp"
#include "engine/bullet/closest_points.hpp"

namespace cullet::bullet {
namespace {

constexpr float kThicknessShare = 0.1f;
constexpr double kStop = 0.0005;  // m, the gap at which a sweep ends
constexpr double kAim = 0.0001;   // m: an advance aims this much past the gap to stop at, so that it ends in few rounds
constexpr double kTouching = 0.001;  // m: pieces nearer than this at the start touch already
constexpr double kDeeper = 0.001;    // m that touching pieces may go deeper in a step,
constexpr double kLeast = 0.0002;    // m: while their cores stay this far apart, so that gaps can be measured
constexpr int kRounds = 48;          // then the body stops where it is: early, never late
constexpr float kBoxGrowth = 0.01f;  // m

struct Mover {
    Body* body;
    btTransform start;
    Vec3d velocity, spin;

    btTransform at(double fraction, float dt) const {
        const auto f = static_cast<float>(std::min(fraction, static_cast<double>(body->moved_fraction)));
        if (!(f > 0) || !is_moving()) return start;
        btTransform out;
        btTransformUtil::integrateTransform(start, to_bullet(velocity.to_float()), to_bullet(spin.to_float()), f * dt,
                                            out);
        return out;
    }
    bool is_moving() const { return dot(velocity, velocity) + dot(spin, spin) > 0; }
};

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

// What a box sweeps over in the world: moved by the velocity, grown by what turning can do to points `reach` away from
// the centre of mass.
Box swept_box(const Box& box, const Mover& mover, float reach, float dt) {
    Box out = box;
    include_way(out, box, mover.velocity, dt);
    return grown(out, turned(mover, reach, dt) + kBoxGrowth);
}

// Both were stopped in this step, at different times: one stands still while the other moves on. Where only one is fast
// the other's way hardly counts.
bool are_split(const Body& a, const Body& b) {
    return a.is_fast && b.is_fast && a.moved_fraction != b.moved_fraction;
}

// The part of the step after which neither of the two is fast any more.
float last_fraction(const Body& a, const Body& b) {
    return std::max(a.is_fast ? a.moved_fraction : 0, b.is_fast ? b.moved_fraction : 0);
}

// What a box of a sweeps over as b sees it: bodies that fly side by side hardly meet. When they were stopped apart,
// also what it sweeps over with the other at rest.
Box relative_box(const Box& box, const Mover& a, const Mover& b, float reach, float dt) {
    Box out = box;
    include_way(out, box, a.velocity - b.velocity, dt);
    if (are_split(*a.body, *b.body)) {
        include_way(out, box, a.velocity, dt);
        include_way(out, box, -b.velocity, dt);
    }
    return grown(out, turned(a, reach, dt) + kBoxGrowth);
}

// A body is swept when a point of it may travel farther than contacts reach plus a tenth of its least width: less than
// that, the overlap is small and pushed out on the right side.
bool is_far(double way, float thickness) {
    return way > kContactRange + kThicknessShare * thickness;
}

double travel(const Mover& mover, float dt) {
    return (length(mover.velocity) + length(mover.spin) * mover.body->reach) * dt;
}

float reach_of(const Body& body, const Hull& hull) {
    const Vec3 from = body.has_offset ? hull.local.centre - body.hull_centre : hull.local.centre;
    return length(from) + hull.radius;
}

// The spheres about both pieces do not meet on a straight way, turning included.
bool pass_by(const Hull& a, const Hull& b, Vec3d way, double turning) {
    const Vec3d from = Vec3d(b.world.centre) - Vec3d(a.world.centre);
    const double square = dot(way, way);
    const double along = square > 0 ? std::clamp(-dot(from, way) / square, 0.0, 1.0) : 0;
    const Vec3d nearest = from + along * way;
    const double reach = static_cast<double>(a.radius) + b.radius + a.margin + b.margin + turning + kStop;
    return dot(nearest, nearest) > reach * reach;
}

// The fraction of the step at which the two pieces come within kStop; `limit` when they do not before it. World points
// are those of the start, or made here when a `has_moved` since. `axis` is a first guess, such as the last one of the
// same two bodies.
double touch_fraction(const Mover& a, const Hull& hull_a, const Mover& b, const Hull& hull_b, float dt, double limit,
                      Vec3d& axis, bool has_moved = false) {
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
            if (closest.is_apart || round == 0) gap = gap_along(*now_a, *now_b, axis) - margins;
        } else {
            gap = gap_along(*now_a, *now_b, axis) - margins;
        }
        if (round == 0 && gap < kTouching) {
            // They touch: the solver has slowed them where they do, but the rest of a piece may still swing in.
            stop = std::max(gap - kDeeper, kLeast - margins);
            // Where the cores (nearly) overlap there is no gap to measure: along the axis of least overlap they may go
            // deeper by as much. Shards that spin at 400 rad/s under a heavier one would else leave through the floor.
            is_axis_fixed = stop >= gap;
            if (is_axis_fixed) stop = gap - kDeeper;
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

}  // namespace

void Sweeper::find_near(const BulletWorld& world, const Box& box) {
    near_.clear();
    world.tree_.visit(box, [this](uint32_t id) { near_.push_back(id); });
    std::sort(near_.begin(), near_.end());
}

void Sweeper::sweep_pair(BulletWorld& world, Body& a, Body& b, float dt) {
    if (a.kind != RigidKind::Dynamic && b.kind != RigidKind::Dynamic) return;
    if (!a.meets_layer_of(b) || world.is_apart_by_order(a.id, b.id)) return;
    PairWork& work = world.work_;
    const Mover mover_a = mover_of(a), mover_b = mover_of(b);
    const double relative =
        length(mover_a.velocity - mover_b.velocity) + length(mover_a.spin) * a.reach + length(mover_b.spin) * b.reach;
    if (!are_split(a, b) && !is_far(relative * dt, std::min(a.thickness, b.thickness))) return;
    const float turned_b = turned(mover_b, b.reach, dt);
    const Box all_a = relative_box(a.shape.box, mover_a, mover_b, a.reach, dt);
    work.near_b.clear();
    for (const Hull* q = b.hulls; q; q = q->next)
        if (overlap(q->world_box, all_a, turned_b)) work.near_b.push_back(q);
    Vec3d axis;
    const auto advance = [&](const Hull& p, const Hull& q) {
        const double limit = last_fraction(a, b);
        const double t = touch_fraction(mover_a, p, mover_b, q, dt, limit, axis);
        if (t >= limit) return;
        if (a.is_fast) a.moved_fraction = std::min(a.moved_fraction, static_cast<float>(t));
        if (b.is_fast) b.moved_fraction = std::min(b.moved_fraction, static_cast<float>(t));
    };
    for (const Hull* p = a.hulls; p; p = p->next) {
        const float span = dt * last_fraction(a, b);
        const Box box = relative_box(p->world_box, mover_a, mover_b, reach_of(a, *p), span);
        if (!overlap(box, b.shape.box, turned_b)) continue;
        for (const Hull* q : work.near_b)
            if (overlap(box, q->world_box, turned(mover_b, reach_of(b, *q), span))) advance(*p, *q);
        if (!b.mesh) continue;
        visit_triangles(*b.mesh, box, [&](uint32_t t) {
            build_triangle(work.triangle, b.mesh->triangles[t].corner, t);
            // From behind a triangle is not there.
            if (dot(mover_a.velocity, Vec3d(work.triangle.face_normal[0])) < 0) advance(*p, work.triangle);
        });
    }
}

uint32_t Sweeper::sweep(BulletWorld& world, float dt) {
    fast_.clear();
    for (RigidId id = 0; id < world.body_end_; ++id) {
        Body& body = world.bodies_[id];
        if (!body.is_used || body.kind == RigidKind::Static) continue;
        body.moved_fraction = 1;
        body.is_fast = false;
        const Mover mover = mover_of(body);
        if (!is_far(travel(mover, dt), body.thickness)) continue;
        body.is_fast = true;
        fast_.push_back({id, swept_box(body.shape.box, mover, body.reach, dt)});
    }
    // The second round sees those that were stopped in the first standing still.
    for (int round = 0; round < 2; ++round) {
        for (size_t k = 0; k < fast_.size(); ++k) {
            Body& a = world.bodies_[fast_[k].id];
            if (round == 0) {
                find_near(world, fast_[k].swept);
                for (const RigidId id : near_)
                    if (id != a.id && !world.bodies_[id].is_fast) sweep_pair(world, a, world.bodies_[id], dt);
            }
            for (size_t j = k + 1; j < fast_.size(); ++j) {
                Body& b = world.bodies_[fast_[j].id];
                if (round == 1 && a.moved_fraction == 1 && b.moved_fraction == 1) continue;
                if (overlap(fast_[k].swept, fast_[j].swept, 0)) sweep_pair(world, a, b, dt);
            }
        }
    }
    uint32_t stopped = 0;
    for (const Fast& fast : fast_) stopped += world.bodies_[fast.id].moved_fraction < 1;
    return stopped;
}

// Free bodies that touch each other are one flock, named by its first body; one that touches anything else is not
// airborne.
void Sweeper::find_flocks(BulletWorld& world) {
    auto& bodies = world.bodies_;
    const auto flock_of = [&](RigidId id) {
        while (bodies[id].flock != id) id = bodies[id].flock;
        return id;
    };
    const auto are_free = [&](const auto& m) { return bodies[m.a].is_free() && bodies[m.b].is_free(); };
    const auto touch = [](const auto& m) { return m.manifold && m.manifold->getNumContacts() > 0; };
    for (RigidId id = 0; id < world.body_end_; ++id) {
        bodies[id].flock = id;
        bodies[id].is_airborne = bodies[id].is_used && bodies[id].is_free();
    }
    for (const auto& m : world.manifolds_) {
        if (!touch(m) || !are_free(m)) continue;
        const RigidId a = flock_of(m.a), b = flock_of(m.b);
        bodies[std::max(a, b)].flock = std::min(a, b);
    }
    // A flock's name is never above its bodies' ids.
    for (RigidId id = 0; id < world.body_end_; ++id) bodies[id].flock = bodies[bodies[id].flock].flock;
    for (const auto& m : world.manifolds_)
        if (touch(m) && !are_free(m))
            bodies[bodies[m.a].flock].is_airborne = bodies[bodies[m.b].flock].is_airborne = false;
    for (RigidId id = 0; id < world.body_end_; ++id)
        bodies[id].is_airborne = bodies[id].is_airborne && bodies[bodies[id].flock].is_airborne;
}

void Sweeper::carry_on(BulletWorld& world, float dt) {
    const auto& bodies = world.bodies_;
    const auto was_stopped = [&](const Fast& fast) { return bodies[fast.id].moved_fraction < 1; };
    if (std::none_of(fast_.begin(), fast_.end(), was_stopped)) return;
    find_flocks(world);
    carried_.clear();
    for (const Fast& fast : fast_)
        if (was_stopped(fast) && bodies[fast.id].is_airborne) carried_.push_back(bodies[fast.id].flock);
    std::sort(carried_.begin(), carried_.end());
    carried_.erase(std::unique(carried_.begin(), carried_.end()), carried_.end());
    flock_.clear();
    for (RigidId id = 0; id < world.body_end_ && !carried_.empty(); ++id)
        if (bodies[id].is_airborne && std::binary_search(carried_.begin(), carried_.end(), bodies[id].flock))
            flock_.push_back(id);
    std::sort(flock_.begin(), flock_.end(),
              [&](RigidId a, RigidId b) { return std::pair(bodies[a].flock, a) < std::pair(bodies[b].flock, b); });
    for (size_t first = 0, end = 0; first < flock_.size(); first = end) {
        while (end < flock_.size() && bodies[flock_[end]].flock == bodies[flock_[first]].flock) ++end;
        if (end - first > 1) carry_flock(world, {flock_.data() + first, end - first}, dt);
    }
}

// What `body` may go of its lost way with the flock's velocity before it meets another body: at most `share`.
double Sweeper::free_share(BulletWorld& world, Body& body, Vec3d velocity, float dt, double share) {
    const float left = (1 - body.moved_fraction) * dt;
    const Mover before = mover_of(body);
    const Mover mover{&body, body.bullet->getWorldTransform(), velocity, {}};
    const auto reached = [&](const Box& box, float reach) {
        Box out = swept_box(box, before, reach, dt);  // where it may be now,
        include_way(out, out, velocity, left);        // and goes
        return out;
    };
    const Box all = reached(body.shape.box, body.reach);
    find_near(world, all);
    const float moved = std::exchange(body.moved_fraction, 1.0f);  // Mover::at goes no farther
    for (const RigidId id : near_) {
        Body& other = world.bodies_[id];
        if (other.flock == body.flock || !body.meets_layer_of(other) || world.is_apart_by_order(body.id, id)) continue;
        const Mover still{&other, other.bullet->getWorldTransform(), {}, {}}, before_other = mover_of(other);
        Vec3d axis;
        const auto meet = [&](const Hull& p, const Hull& q) {
            share = std::min(share, touch_fraction(mover, p, still, q, left, share, axis, true));
        };
        for (const Hull* p = body.hulls; p; p = p->next) {
            const Box box = reached(p->world_box, reach_of(body, *p));
            for (const Hull* q = other.hulls; q; q = q->next)
                if (overlap(box, swept_box(q->world_box, before_other, other.reach, dt), 0)) meet(*p, *q);
            if (!other.mesh) continue;
            visit_triangles(*other.mesh, box, [&](uint32_t t) {
                build_triangle(world.work_.triangle, other.mesh->triangles[t].corner, t);
                if (dot(velocity, Vec3d(world.work_.triangle.face_normal[0])) < 0) meet(*p, world.work_.triangle);
            });
        }
    }
    body.moved_fraction = moved;
    return share;
}

void Sweeper::carry_flock(BulletWorld& world, std::span<const RigidId> flock, float dt) {
    double mass = 0;
    Vec3d momentum;
    for (const RigidId id : flock) {
        const Body& body = world.bodies_[id];
        mass += static_cast<double>(body.mass);
        momentum = momentum + static_cast<double>(body.mass) * Vec3d(from_bullet(body.bullet->getLinearVelocity()));
    }
    const Vec3d velocity = (1 / mass) * momentum;
    double share = 1;
    for (const RigidId id : flock)
        if (world.bodies_[id].moved_fraction < 1 && share > 0)
            share = free_share(world, world.bodies_[id], velocity, dt, share);
    for (const RigidId id : flock) {
        Body& body = world.bodies_[id];
        btTransform moved = body.bullet->getWorldTransform();
        const double left = share * (1 - static_cast<double>(body.moved_fraction)) * dt;
        moved.setOrigin(moved.getOrigin() + to_bullet((left * velocity).to_float()));
        body.bullet->proceedToTransform(moved);
    }
}

}  // namespace cullet::bullet
