// What may be done between detect() and solve(): hold, release, skip, ignore; and sleep.
#include <algorithm>

#include "engine/bullet/bullet_world.hpp"
#include "engine/rigid_allocations.hpp"

namespace cullet::bullet {
namespace {

// Sleep: for half a second no point left the ball of 3 mm about where it was. (Bullet's speeds are too shaky in piles
// of shards: a quarter of them never slept.) Twice the distance and slow slides are frozen, twice the time and piles
// cost more.
constexpr float kStillDistance = 0.003f;  // m
constexpr float kStillSeconds = 0.5f;
// Deep heaps of curved shards creep on for long at a centimetre a second: a second below this speed is sleep
// too, faster steps counting back twice.
constexpr float kSlowSpeed = 0.15f;  // m/s of the fastest point
constexpr float kSlowSeconds = 1;
// What is wedged in a heap may shake for ever at any speed, and keep a thousand others awake: so long without leaving
// this much room is sleep too.
constexpr float kRattleDistance = 0.02f;  // m
constexpr float kRattleSeconds = 2;

// What lies deeper in something than this is kept awake to be pushed out; each second of it makes twice as much more
// bear sleep: a slab of brick presses a piece below it by 7 mm, which takes the solver two seconds, and in a deep heap
// some millimetres may never come out.
constexpr float kPressedDeep = 0.0015f;  // m
constexpr float kImpatience = 2;         // 1/s
constexpr float kPressedSeconds = 2.5f;  // after which it sleeps as it lies

// The corner of the body's box that moved farthest bounds all of its points: displacement is convex in the point.
bool has_left(const Body& body, const btTransform& anchor, const btTransform& now, float distance) {
    for (int corner = 0; corner < 8; ++corner) {
        const btVector3 p(corner & 1 ? body.local_box.high.x : body.local_box.low.x,
                          corner & 2 ? body.local_box.high.y : body.local_box.low.y,
                          corner & 4 ? body.local_box.high.z : body.local_box.low.z);
        if ((now * p - anchor * p).length2() > distance * distance) return true;
    }
    return false;
}

}  // namespace

void BulletWorld::hold(RigidId id) {
    if (!is_known(id) || bodies_[id].kind != RigidKind::Dynamic || bodies_[id].is_held) return;
    InsideRigidEngine guard(counts_.allocations);
    Body& body = bodies_[id];
    body.kept = motion(id);
    if (!body.bullet->isActive()) wake_body(body);
    body.is_held = true;
    body.bullet->setMassProps(0, {0, 0, 0});
    body.bullet->updateInertiaTensor();
    body.bullet->setLinearVelocity({0, 0, 0});
    body.bullet->setAngularVelocity({0, 0, 0});
}

void BulletWorld::release(RigidId id) {
    if (!is_known(id) || !bodies_[id].is_held) return;
    InsideRigidEngine guard(counts_.allocations);
    Body& body = bodies_[id];
    body.is_held = false;
    // In the order of creation, so that mass and weight round as they did then.
    body.bullet->setMassProps(body.mass, body.moments);
    body.bullet->setGravity(world_.getGravity());
    body.bullet->updateInertiaTensor();
    body.bullet->setLinearVelocity(to_bullet(body.kept.velocity));
    body.bullet->setAngularVelocity(to_bullet(body.kept.angular_velocity));
}

bool BulletWorld::is_held(RigidId id) const {
    return is_known(id) && bodies_[id].is_held;
}

// The manifolds stay, without points, so that they still join their islands: Bullet's solver would otherwise move a
// body twice.
void BulletWorld::skip_contacts(RigidId a, RigidId b) {
    if (!is_known(a) || !is_known(b) || a == b) return;
    if (a > b) std::swap(a, b);
    InsideRigidEngine guard(counts_.allocations);
    skipped_.emplace_back(a, b);
    const auto before = [](const SortedManifold& m, std::pair<RigidId, RigidId> key) {
        return std::pair(m.a, m.b) < key;
    };
    for (auto m = std::lower_bound(manifolds_.begin(), manifolds_.end(), std::pair(a, b), before);
         m != manifolds_.end() && m->a == a && m->b == b; ++m)
        if (m->manifold) m->manifold->setNumContacts(0);
}

std::vector<IgnoredPair>::iterator BulletWorld::find_ignored(RigidId a, RigidId b) {
    const std::pair key(std::min(a, b), std::max(a, b));
    const auto found = std::lower_bound(ignored_.begin(), ignored_.end(), key,
                                        [](const IgnoredPair& p, auto& k) { return std::pair(p.a, p.b) < k; });
    return found != ignored_.end() && found->a == key.first && found->b == key.second ? found : ignored_.end();
}

bool BulletWorld::is_apart_by_order(RigidId a, RigidId b) const {
    const std::pair key(std::min(a, b), std::max(a, b));
    const auto found = std::lower_bound(ignored_.begin(), ignored_.end(), key,
                                        [](const IgnoredPair& p, auto& k) { return std::pair(p.a, p.b) < k; });
    if (found != ignored_.end() && found->a == key.first && found->b == key.second) return true;
    if (bodies_[a].kind != RigidKind::Dynamic || bodies_[b].kind != RigidKind::Dynamic) return false;
    return std::find(skipped_.begin(), skipped_.end(), key) != skipped_.end();
}

void BulletWorld::ignore_pair(RigidId a, RigidId b, float seconds, bool until_apart) {
    if (!is_known(a) || !is_known(b) || a == b) return;
    if (a > b) std::swap(a, b);
    InsideRigidEngine guard(counts_.allocations);
    const auto found = find_ignored(a, b);
    if (found != ignored_.end()) {
        found->seconds = std::max(found->seconds, seconds);
        found->until_apart = found->until_apart && until_apart;
        return;
    }
    const auto place = std::lower_bound(ignored_.begin(), ignored_.end(), std::pair(a, b),
                                        [](const IgnoredPair& p, auto k) { return std::pair(p.a, p.b) < k; });
    ignored_.insert(place, {a, b, seconds, until_apart});
    skip_contacts(a, b);
}

void BulletWorld::update_sleep(float dt) {
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        if (!body.is_used || body.kind != RigidKind::Dynamic || body.is_held) continue;
        btRigidBody& bullet = *body.bullet;
        if (!bullet.isActive()) {  // its whole island went to sleep in this step
            set_velocities(body, {0, 0, 0}, {0, 0, 0});
            continue;
        }
        // A body that its island woke keeps its anchor: it may sleep again as soon as the others do.
        const btTransform& now = bullet.getWorldTransform();
        if (!body.is_touched || has_left(body, body.rattle_anchor, now, kRattleDistance)) {
            body.rattle_anchor = now;
            body.rattle_seconds = 0;
        } else {
            body.rattle_seconds += dt;
        }
        if (has_left(body, body.anchor, now, kStillDistance)) {
            body.anchor = now;
            body.still_seconds = 0;
        } else {
            body.still_seconds = std::min(body.still_seconds + dt, 2 * kStillSeconds);
        }
        const float speed = bullet.getLinearVelocity().length() + bullet.getAngularVelocity().length() * body.reach;
        const float slower = body.is_touched && speed < kSlowSpeed ? dt : -2 * dt;
        body.slow_seconds = std::clamp(body.slow_seconds + slower, 0.0f, 2 * kSlowSeconds);
        if (body.is_driven) body.still_seconds = body.slow_seconds = body.rattle_seconds = 0;
        bool is_ready = body.still_seconds >= kStillSeconds || body.slow_seconds >= kSlowSeconds ||
                        body.rattle_seconds >= kRattleSeconds;
        if (is_ready && body.pressed_seconds < kPressedSeconds &&
            body.overlap > kPressedDeep * (1 + kImpatience * body.pressed_seconds)) {
            body.pressed_seconds += dt;
            is_ready = false;
        }
        bullet.setActivationState(is_ready ? WANTS_DEACTIVATION : ACTIVE_TAG);
    }
}

bool BulletWorld::is_asleep(RigidId id) const {
    return is_known(id) && bodies_[id].kind == RigidKind::Dynamic && !bodies_[id].bullet->isActive();
}

void BulletWorld::wake_body(Body& body) {
    body.bullet->setActivationState(ACTIVE_TAG);
    body.still_seconds = body.slow_seconds = body.pressed_seconds = 0;
    body.anchor = body.rattle_anchor = body.bullet->getWorldTransform();
    body.rattle_seconds = 0;
}

void BulletWorld::wake(RigidId id) {
    if (!is_known(id) || bodies_[id].kind != RigidKind::Dynamic) return;
    InsideRigidEngine guard(counts_.allocations);
    wake_body(bodies_[id]);
}

void BulletWorld::wake_touching(RigidId id) {
    for (const SortedManifold& m : manifolds_) {
        if (!m.manifold || (m.a != id && m.b != id)) continue;
        Body& other = bodies_[m.a == id ? m.b : m.a];
        if (other.is_used && other.kind == RigidKind::Dynamic && !other.bullet->isActive()) wake_body(other);
    }
}

}  // namespace cullet::bullet
