// The touch of a body in flight, before it comes: what solve() and detect() will do with the body is done here ahead of
// time, step by step and in the same order, so that an undisturbed flight ends in the very bits that were foreseen.
// What is held up gains in each step what it gained in the last ones, in its own axes, which turn with it: a guess.
#include <algorithm>

#include "engine/bullet/advance.hpp"
#include "engine/bullet/bullet_world.hpp"
#include "engine/bullet/free_turn.hpp"
#include "engine/bullet/sides.hpp"
#include "engine/bullet/stopped_fall.hpp"
#include "engine/rigid_allocations.hpp"

namespace cullet::bullet {
namespace {

btRigidBody::btRigidBodyConstructionInfo copied(const Body& body) {
    btRigidBody::btRigidBodyConstructionInfo info(body.mass, nullptr, nullptr, body.moments);
    info.m_startWorldTransform = body.bullet->getWorldTransform();
    return info;
}

constexpr float kSlow = 1;  // m/s of the fastest point: what moves faster is not where it is when the touch comes

}  // namespace

bool is_slow(const Body& body) {
    if (body.is_soft) return false;
    const bool is_moving = body.is_free() || (body.kind == RigidKind::Kinematic && body.bullet->isActive());
    if (!is_moving) return true;
    return body.bullet->getLinearVelocity().length() + body.bullet->getAngularVelocity().length() * body.reach < kSlow;
}

/// One flight. The body's world points go along and are put back at the end: they follow from its pose.
class Flight {
 public:
    Flight(BulletWorld& world, Body& body, float dt)
        : world_(world),
          body_(body),
          dt_(dt),
          flying_(copied(body)),
          stood_at_(body.fresh_at),
          stood_in_(body.shape.box),
          moved_fraction_(body.moved_fraction),
          is_fast_(body.is_fast) {
        if (body.is_held_up) {
            const Mat3 to_world = rotation_of(flying_.getWorldTransform());
            pushed_ = transposed_times(to_world, body.gained.velocity);
            turned_ = transposed_times(to_world, body.gained.angular_velocity);
        }
        flying_.setGravity(world.gravity_);
        flying_.setLinearVelocity(body.bullet->getLinearVelocity());
        flying_.setAngularVelocity(body.bullet->getAngularVelocity());
        body.moved_fraction = 1;
        body.is_fast = false;
    }
    ~Flight() {
        if (is_away_) stand(stood_at_);
        body_.shape.box = stood_in_;
        body_.moved_fraction = moved_fraction_;
        body_.is_fast = is_fast_;
    }
    Flight(const Flight&) = delete;
    Flight& operator=(const Flight&) = delete;

    /// Bodies that it may meet within `steps` steps; false: there are none.
    bool find_others(uint32_t steps) {
        const float seconds = static_cast<float>(steps) * dt_;
        const Mover mover = this->mover();
        Box way = body_.shape.box;
        include_way(way, body_.shape.box, mover.velocity, seconds);
        const btVector3 fall = 0.5f * seconds * (seconds + dt_) * flying_.getGravity();
        include_way(way, way, Vec3d(from_bullet(fall)), 1);
        way = grown(way, turned(mover, body_.reach, seconds) + kBoxGrowth);
        auto& others = world_.in_the_way_;
        others.clear();
        world_.tree_.visit(way, [&](uint32_t id) { others.push_back(id); });
        std::erase_if(others, [&](RigidId id) {
            const Body& other = world_.bodies_[id];
            return id == body_.id || !is_slow(other) || !body_.meets_layer_of(other) ||
                   world_.is_apart_by_order(body_.id, id);
        });
        if (body_.is_held_up) std::erase_if(others, [&](RigidId id) { return meets_already(id); });
        std::sort(others.begin(), others.end());
        return !others.empty();
    }

    /// The solve() of one step; nothing touches the body.
    void go() {
        if (body_.is_held_up) {
            const Mat3 to_world = rotation_of(flying_.getWorldTransform());
            flying_.setLinearVelocity(flying_.getLinearVelocity() + to_bullet(to_world * pushed_));
            flying_.setAngularVelocity(flying_.getAngularVelocity() + to_bullet(to_world * turned_));
        } else {
            flying_.clearForces();
            flying_.applyGravity();
            turn_freely(flying_, dt_);
            flying_.setLinearVelocity(flying_.getLinearVelocity() +
                                      flying_.getTotalForce() * flying_.getInvMass() * dt_);
        }
        const Mover mover = this->mover();
        float fraction = 1;
        const double way = travel(mover, dt_);
        for (const RigidId id : world_.in_the_way_)
            if (const Body& other = world_.bodies_[id];
                is_far(way, scale_of(body_, other), std::min(body_.thickness, other.thickness)))
                fraction = std::min(fraction, free_way(mover, id, fraction));
        btTransform moved;
        flying_.predictIntegratedTransform(fraction * dt_, moved);
        flying_.proceedToTransform(moved);
        flying_.setLinearVelocity(velocity_of_stopped(flying_.getLinearVelocity(), world_.gravity_, fraction, dt_));
        stand(body_.hulls_at(moved));
    }

    /// The detect() of one step.
    bool touches(ForeseenTouch& out) {
        out.contact_count = 0;
        for (const RigidId id : world_.in_the_way_)
            if (overlap(body_.shape.box, world_.bodies_[id].shape.box, 2 * kContactRange)) meet(id, out);
        if (out.contact_count == 0) return false;
        out.pose = from_bullet(flying_.getWorldTransform(), body_.frame);
        out.motion = {from_bullet(flying_.getLinearVelocity()), from_bullet(flying_.getAngularVelocity())};
        return true;
    }

 private:
    Mover mover() const {
        return {&body_, flying_.getWorldTransform(), Vec3d(from_bullet(flying_.getLinearVelocity())),
                Vec3d(from_bullet(flying_.getAngularVelocity()))};
    }
    /// What holds it up, or slides along it: the way on is found by what it did in the last steps.
    bool meets_already(RigidId id) {
        if (!overlap(body_.shape.box, world_.bodies_[id].shape.box, 2 * kContactRange)) return false;
        ForeseenTouch touch;
        touch.contact_count = 0;
        meet(id, touch);
        return touch.contact_count > 0;
    }
    void stand(const btTransform& at) {
        is_away_ = true;
        body_.fresh_at = at;
        const Mat3 rotation = rotation_of(at);
        for (Hull* hull = body_.hulls; hull; hull = hull->next)
            refresh_world(*hull, rotation, from_bullet(at.getOrigin()));
        world_.gather_box(body_);
    }

    float free_way(const Mover& mover, RigidId id, float limit) {
        Body& other = world_.bodies_[id];
        const Mover still{&other, other.bullet->getWorldTransform(), {}, {}};
        double share = limit;
        Vec3d axis;
        const auto advance = [&](const Hull& p, const Hull& q) {
            share = std::min(share, touch_fraction(world_.work_.around, mover, p, still, q, dt_, share, axis));
        };
        for (const Hull* p = body_.hulls; p; p = p->next) {
            const Box box = swept_box(p->world_box, mover, reach_of(body_, *p), dt_);
            if (!overlap(box, other.shape.box, 0)) continue;
            for (const Hull* q = other.hulls; q; q = q->next)
                if (overlap(box, q->world_box, 0)) advance(*p, *q);
            if (!other.mesh) continue;
            Hull& triangle = world_.scratches_.own().triangle;
            const Vec3 seen_from = inner_point(*p, body_.fresh_at);
            visit_triangles(*other.mesh, box, [&](uint32_t t) {
                build_seen_triangle(triangle, *other.mesh, t, t, seen_from);
                if (dot(mover.velocity, Vec3d(triangle.face_normal[0])) < 0) advance(*p, triangle);
            });
        }
        return static_cast<float>(share);
    }

    void meet(RigidId id, ForeseenTouch& out) {
        PairAlgorithm pair(std::min(body_.id, id), std::max(body_.id, id), world_.work_);
        pair.process(world_.scratches_.own());
        const bool is_first = body_.id < id;
        pair.visit_manifolds([&](const btPersistentManifold& manifold, const PairRecord&) {
            for (int k = 0; k < manifold.getNumContacts() && out.contact_count < kMostForeseenContacts; ++k) {
                const btManifoldPoint& p = manifold.getContactPoint(k);
                const Vec3 point = 0.5f * (from_bullet(p.m_positionWorldOnA) + from_bullet(p.m_positionWorldOnB)),
                           normal = from_bullet(p.m_normalWorldOnB);
                const Vec3 moving =
                    from_bullet(flying_.getVelocityInLocalPoint(to_bullet(point) - flying_.getCenterOfMassPosition()));
                const float speed = (is_first ? -1.0f : 1.0f) * dot(moving, normal);
                out.contacts[out.contact_count++] = {std::min(body_.id, id),
                                                     std::max(body_.id, id),
                                                     static_cast<uint32_t>(manifold.m_companionIdA),
                                                     static_cast<uint32_t>(manifold.m_companionIdB),
                                                     point,
                                                     normal,
                                                     p.m_distance1,
                                                     speed};
            }
        });
        pair.forget();
    }

    BulletWorld& world_;
    Body& body_;
    float dt_;
    btRigidBody flying_;
    btTransform stood_at_;
    Box stood_in_;
    float moved_fraction_;
    bool is_fast_, is_away_ = false;
    Vec3 pushed_, turned_;  // of what is held up: gained a step, its axes
};

bool BulletWorld::foresee(RigidId id, float dt, uint32_t steps, ForeseenTouch& out) {
    if (!is_known(id)) return false;
    Body& body = bodies_[id];
    if (!body.is_free() || body.is_soft) return false;
    InsideRigidEngine guard(counts_.allocations);
    Flight flight(*this, body, dt);
    if (!flight.find_others(steps)) return false;
    for (out.steps = 1; out.steps <= steps; ++out.steps) {
        flight.go();
        if (flight.touches(out)) return true;
    }
    return false;
}

}  // namespace cullet::bullet
