#include "engine/bullet/sweep.hpp"

#include <algorithm>
#include <utility>

#include "engine/bullet/advance.hpp"
#include "engine/bullet/bullet_world.hpp"

namespace cullet::bullet {
namespace {

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
    const KnownAxes known{world.pairs_.memory_of(std::min(a.id, b.id), std::max(a.id, b.id)), b.id < a.id};
    Vec3d axis;
    const auto advance = [&](const Hull& p, const Hull& q) {
        const double limit = last_fraction(a, b);
        const double t = touch_fraction(mover_a, p, mover_b, q, dt, limit, axis, known);
        if (t >= limit) return;
        if (a.is_fast) a.moved_fraction = std::min(a.moved_fraction, static_cast<float>(t));
        if (b.is_fast) b.moved_fraction = std::min(b.moved_fraction, static_cast<float>(t));
        a.is_anchored = a.is_anchored || !b.is_free();
        b.is_anchored = b.is_anchored || !a.is_free();
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

// What goes no farther than the thinnest thing of all asks for is swept against nothing.
void Sweeper::list_fast(BulletWorld& world, float dt) {
    float thinnest = kFar;
    for (RigidId id = 0; id < world.body_end_; ++id)
        if (world.bodies_[id].is_used) thinnest = std::min(thinnest, world.bodies_[id].thickness);
    fast_.clear();
    for (RigidId id = 0; id < world.body_end_; ++id) {
        Body& body = world.bodies_[id];
        if (!body.is_used || body.kind == RigidKind::Static) continue;
        body.moved_fraction = 1;
        body.is_fast = body.is_anchored = false;
        const Mover mover = mover_of(body);
        if (!is_far(travel(mover, dt), thinnest)) continue;
        body.is_fast = true;
        fast_.push_back({id, swept_box(body.shape.box, mover, body.reach, dt)});
    }
}

void Sweeper::order_fast() {
    by_low_.clear();
    Vec3 low{1e30f, 1e30f, 1e30f}, high = -low;
    for (uint32_t k = 0; k < fast_.size(); ++k) {
        const Vec3 at = fast_[k].swept.low;
        if (!(dot(at, at) >= 0)) continue;  // what is nowhere meets nothing, and has no place in an order
        by_low_.push_back(k);
        low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
    }
    const Vec3 spread = high - low;
    axis_ = spread.x >= spread.y && spread.x >= spread.z ? &Vec3::x : spread.y >= spread.z ? &Vec3::y : &Vec3::z;
    longest_ = 0;
    for (const uint32_t k : by_low_) longest_ = std::max(longest_, double{fast_[k].swept.high.*axis_} - low_of(k));
    std::sort(by_low_.begin(), by_low_.end(),
              [this](uint32_t a, uint32_t b) { return std::pair(low_of(a), a) < std::pair(low_of(b), b); });
}

// The fast ones behind the k-th whose ways meet its way, rising. None of them begins more than `longest_` before that
// way does. All against all took half of a frame in which 4,096 flew.
void Sweeper::find_fast(uint32_t k) {
    near_.clear();
    const Box& swept = fast_[k].swept;
    auto next = std::lower_bound(by_low_.begin(), by_low_.end(), low_of(k) - longest_,
                                 [this](uint32_t j, double from) { return low_of(j) < from; });
    for (; next != by_low_.end() && low_of(*next) <= double{swept.high.*axis_}; ++next)
        if (*next > k && overlap(swept, fast_[*next].swept, 0)) near_.push_back(*next);
    std::sort(near_.begin(), near_.end());
}

uint32_t Sweeper::sweep(BulletWorld& world, float dt) {
    list_fast(world, dt);
    order_fast();
    // The second round sees those that were stopped in the first standing still.
    for (int round = 0; round < 2; ++round) {
        for (uint32_t k = 0; k < fast_.size(); ++k) {
            Body& a = world.bodies_[fast_[k].id];
            if (round == 0) {
                find_near(world, fast_[k].swept);
                for (const RigidId id : near_)
                    if (id != a.id && !world.bodies_[id].is_fast) sweep_pair(world, a, world.bodies_[id], dt);
            }
            find_fast(k);
            for (const uint32_t j : near_) {
                Body& b = world.bodies_[fast_[j].id];
                if (round == 0 || a.moved_fraction < 1 || b.moved_fraction < 1) sweep_pair(world, a, b, dt);
            }
        }
    }
    uint32_t stopped = 0;
    for (const Fast& fast : fast_) stopped += world.bodies_[fast.id].moved_fraction < 1;
    return stopped;
}

// Bodies that were stopped, though by nothing that stands, and touch each other are one flock, named by its first body.
void Sweeper::find_flocks(BulletWorld& world) {
    auto& bodies = world.bodies_;
    const auto flock_of = [&](RigidId id) {
        while (bodies[id].flock != id) id = bodies[id].flock;
        return id;
    };
    const auto is_adrift = [&](RigidId id) {
        const Body& body = bodies[id];
        return body.is_used && body.is_free() && body.moved_fraction < 1 && !body.is_anchored;
    };
    for (RigidId id = 0; id < world.body_end_; ++id) bodies[id].flock = id;
    for (const auto& m : world.manifolds_) {
        if (!m.manifold || m.manifold->getNumContacts() == 0 || !is_adrift(m.a) || !is_adrift(m.b)) continue;
        const RigidId a = flock_of(m.a), b = flock_of(m.b);
        bodies[std::max(a, b)].flock = std::min(a, b);
    }
    flock_.clear();
    for (RigidId id = 0; id < world.body_end_; ++id) {
        if (!is_adrift(id)) continue;
        bodies[id].flock = flock_of(id);
        flock_.push_back(id);
    }
    std::sort(flock_.begin(), flock_.end(),
              [&](RigidId a, RigidId b) { return std::pair(bodies[a].flock, a) < std::pair(bodies[b].flock, b); });
}

void Sweeper::carry_on(BulletWorld& world, float dt) {
    const auto& bodies = world.bodies_;
    find_flocks(world);
    for (size_t first = 0, end = 0; first < flock_.size(); first = end) {
        const RigidId flock = bodies[flock_[first]].flock;
        while (end < flock_.size() && bodies[flock_[end]].flock == flock) ++end;
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
            share = std::min(share, touch_fraction(mover, p, still, q, left, share, axis, {}, true));
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

Vec3d Sweeper::common_velocity(const BulletWorld& world, std::span<const RigidId> flock) const {
    double mass = 0;
    Vec3d momentum;
    for (const RigidId id : flock) {
        const Body& body = world.bodies_[id];
        mass += static_cast<double>(body.mass);
        momentum = momentum + static_cast<double>(body.mass) * Vec3d(from_bullet(body.bullet->getLinearVelocity()));
    }
    return (1 / mass) * momentum;
}

// What can hardly move leaves the flock, and is in the way of the others.
void Sweeper::carry_flock(BulletWorld& world, std::span<RigidId> flock, float dt) {
    constexpr int kRounds = 4;
    constexpr double kHardly = 0.05;
    double share = 1;
    Vec3d velocity;
    for (int round = 0; round < kRounds; ++round) {
        share = 1;
        velocity = common_velocity(world, flock);
        size_t kept = 0;
        for (const RigidId id : flock) {
            const double own = free_share(world, world.bodies_[id], velocity, dt, 1);
            if (own < kHardly && round + 1 < kRounds) {
                world.bodies_[id].flock = kNoRigid;  // nobody's
                continue;
            }
            flock[kept++] = id;
            share = std::min(share, own);
        }
        const bool is_whole = kept == flock.size();
        flock = flock.first(kept);
        if (is_whole || flock.empty()) break;
    }
    for (const RigidId id : flock) {
        Body& body = world.bodies_[id];
        btTransform moved = body.bullet->getWorldTransform();
        const double left = share * (1 - static_cast<double>(body.moved_fraction)) * dt;
        moved.setOrigin(moved.getOrigin() + to_bullet((left * velocity).to_float()));
        body.bullet->proceedToTransform(moved);
    }
}

}  // namespace cullet::bullet
