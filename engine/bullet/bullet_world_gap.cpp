// What may be done between detect() and solve(): hold, release, skip, ignore; and sleep.
#include <algorithm>

#include "engine/bullet/bullet_world.hpp"
#include "engine/rigid_allocations.hpp"

namespace cullet::bullet {
namespace {

// Sleep: for half a second no point left the ball of 3 mm about where it was. (Bullet's speeds are too shaky in piles
// of shards: a quarter of them never slept.) Twice the distance and slow slides are frozen, twice the time and piles
// cost more. Distances are those of what reaches this far from its middle, and farther; what is smaller has less, as it
// is smaller. Times and speeds are those of g: see Pace.
constexpr float kFullReach = 0.02f;       // m
constexpr float kStillDistance = 0.003f;  // m
constexpr float kStillSeconds = 0.5f;
// Deep heaps of curved shards creep on for long at a centimetre a second: a second below this speed is sleep
// too, faster steps counting back twice. At three times it a slab that begins to tip over is frozen as it stands.
constexpr float kSlowSpeed = 0.05f;  // m/s of the fastest point
constexpr float kSlowSeconds = 1;
// What rocks and trembles about its place is frozen, however deep it lies in something: so long within so much. What
// tips over does not take so long, nor does what slides in earnest. With two seconds of creeping and two and a half of
// being pressed (below) two of four heaps of 1,200 shards have more than 1 % awake five seconds after the last break,
// with these none of five.
constexpr float kCreepDistance = 0.015f;  // m
constexpr float kCreepSeconds = 1.5f;
// Sleepers stand as if of infinite mass, so that one that shakes does not keep its thousand neighbours awake. What
// wakes them: a blow that would give them this speed,
constexpr float kWakeSpeed = 0.05f;   // m/s
constexpr float kStruckGap = 0.001f;  // m, at scale 1, across which a blow comes,
// so many times the load that they fell asleep under, and weights of their own,
constexpr float kWakeLoads = 2, kWakeWeights = 3;
// or a neighbour that leaves its place: it may have been what they lay on. What lay still after so many such wakes is
// not woken by creeping and loads again, until it is struck.
constexpr uint32_t kIdleWakes = 3;

// What lies deeper in something than this is kept awake to be pushed out; each second of it makes twice as much more
// bear sleep: in a deep heap some millimetres may never come out.
constexpr float kPressedDeep = 0.0015f;  // m
constexpr float kImpatience = 2;         // 1/s
constexpr float kPressedSeconds = 1.5f;  // after which it sleeps as it lies

// What comes to rest deeper than this in what never moves is laid to rest first: it keeps so little of its speed that
// hardly anything but the pushes out of overlaps moves it, until it has come out or this time is over; once, while it
// stays in its place. A shard of two millimetres is turned over by the gravity of a single step, corner after corner
// into the floor, and would sleep half a wall deep in it. Without any speed the corners that it has come off do not
// meet the floor again: it hung on one of them. (Of shards in each other a heap has always some, which wake each
// other.)
constexpr float kShallow = 0.00005f;  // m, at scale 1
constexpr float kSettlingSeconds = 0.6f;
constexpr float kSettlingSpeed = 0.1f;  // of its speed, of what has the full reach; of what is smaller less
constexpr float kBorneShare = 0.5f;     // of its weight, that bears it when it is done

// Where there is no gravity nothing holds anything: at rest is what would not leave its place in so long.
constexpr float kDriftSeconds = 60;
// Gravity is faint where what falls from rest has gone less than so many times the distance of sleep in the time of
// sleep. There what falls seems to lie still: something has to bear it. Elsewhere it moves too far to be asked.
constexpr float kFaintWay = 10;
// A ball slower than this may be at rest; a faster one that has gone this share of the way that its speed takes it
// rolls. (From rest down a slope it is a half.)
constexpr float kRollingSpeed = 0.001f;  // m/s
constexpr float kRollingShare = 0.25f;

// The corner of the body's box that moved farthest bounds all of its points: displacement is convex in the point.
bool has_left(const Body& body, const btTransform& anchor, const btTransform& now, float distance) {
    for (int corner = 0; corner < 8; ++corner) {
        const btVector3 corner_point(corner & 1 ? body.local_box.high.x : body.local_box.low.x,
                                     corner & 2 ? body.local_box.high.y : body.local_box.low.y,
                                     corner & 4 ? body.local_box.high.z : body.local_box.low.z);
        const btVector3 p = body.has_offset ? body.hull_offset * corner_point : corner_point;
        if ((now * p - anchor * p).length2() > distance * distance) return true;
    }
    return false;
}

/// Of the lengths of sleep, 1 for what is as large as a hand or larger.
float size_of(const Body& body) {
    return std::clamp(body.reach / kFullReach, kLeastScale, 1.0f);
}

bool has_crept(const Body& body, const Pace& pace) {
    return body.is_touched && body.creep_seconds >= pace.slower * kCreepSeconds;
}

float bearable_overlap(const Body& body, const Pace& pace) {
    if (has_crept(body, pace)) return kFar;
    if (body.pressed_seconds >= kPressedSeconds) return kFar;
    return kPressedDeep * (1 + kImpatience * body.pressed_seconds);
}

// In which pieces of one break do not throw each other. For good, nothing that falls would ever be levered up by what
// broke off with it.
constexpr float kSiblingSeconds = 0.5f;

}  // namespace

void BulletWorld::hold(RigidId id) {
    if (!is_known(id) || bodies_[id].kind != RigidKind::Dynamic || bodies_[id].is_held) return;
    InsideRigidEngine guard(counts_.allocations);
    Body& body = bodies_[id];
    body.kept = motion(id);
    if (!body.bullet->isActive()) wake_body(body);
    body.is_held = true;
    stop_mass(body);
    body.bullet->setLinearVelocity({0, 0, 0});
    body.bullet->setAngularVelocity({0, 0, 0});
}

void BulletWorld::stop_mass(Body& body) {
    body.bullet->setMassProps(0, {0, 0, 0});
    body.bullet->updateInertiaTensor();
}

// In the order of creation, so that mass and weight round as they did then.
void BulletWorld::restore_mass(Body& body) {
    body.bullet->setMassProps(body.mass, body.moments);
    body.bullet->setGravity(gravity_);
    body.bullet->updateInertiaTensor();
}

void BulletWorld::release(RigidId id) {
    if (!is_known(id) || !bodies_[id].is_held) return;
    InsideRigidEngine guard(counts_.allocations);
    Body& body = bodies_[id];
    body.is_held = false;
    restore_mass(body);
    body.bullet->setLinearVelocity(to_bullet(body.kept.velocity));
    body.bullet->setAngularVelocity(to_bullet(body.kept.angular_velocity));
}

bool BulletWorld::is_held(RigidId id) const {
    return is_known(id) && bodies_[id].is_held;
}

void BulletWorld::carry(RigidId id, Vec3 by) {
    if (!is_held(id)) return;
    InsideRigidEngine guard(counts_.allocations);
    Body& body = bodies_[id];
    wake_touching(id);
    btTransform at = body.bullet->getCenterOfMassTransform();
    at.setOrigin(at.getOrigin() + to_bullet(by));
    body.bullet->setCenterOfMassTransform(at);
    refresh(body);
}

// The manifolds stay, without points: what the two remember of each other is not lost.
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

void BulletWorld::set_bounce(RigidId a, RigidId b, float restitution) {
    if (!is_known(a) || !is_known(b) || a == b) return;
    if (a > b) std::swap(a, b);
    const auto before = [](const SortedManifold& m, std::pair<RigidId, RigidId> key) {
        return std::pair(m.a, m.b) < key;
    };
    for (auto m = std::lower_bound(manifolds_.begin(), manifolds_.end(), std::pair(a, b), before);
         m != manifolds_.end() && m->a == a && m->b == b; ++m)
        for (int k = 0; m->manifold && k < m->manifold->getNumContacts(); ++k) {
            btManifoldPoint& point = m->manifold->getContactPoint(k);
            point.m_combinedRestitution = std::max(point.m_combinedRestitution, restitution);
        }
}

std::vector<IgnoredPair>::iterator BulletWorld::find_ignored(RigidId a, RigidId b) {
    const std::pair key(std::min(a, b), std::max(a, b));
    const auto found = std::lower_bound(ignored_.begin(), ignored_.end(), key,
                                        [](const IgnoredPair& p, auto& k) { return std::pair(p.a, p.b) < k; });
    return found != ignored_.end() && found->a == key.first && found->b == key.second ? found : ignored_.end();
}

bool BulletWorld::is_ignored(RigidId a, RigidId b) const {
    const std::pair key(std::min(a, b), std::max(a, b));
    const auto found = std::lower_bound(ignored_.begin(), ignored_.end(), key,
                                        [](const IgnoredPair& p, auto& k) { return std::pair(p.a, p.b) < k; });
    return found != ignored_.end() && found->a == key.first && found->b == key.second;
}

bool BulletWorld::is_apart_by_order(RigidId a, RigidId b) const {
    if (bodies_[a].is_soft || bodies_[b].is_soft || is_ignored(a, b)) return true;
    if (!newborn_of(std::min(a, b), std::max(a, b)).empty()) return true;
    if (bodies_[a].kind != RigidKind::Dynamic || bodies_[b].kind != RigidKind::Dynamic) return false;
    return is_skipped(a, b);
}

bool BulletWorld::is_skipped(RigidId a, RigidId b) const {
    return std::find(skipped_.begin(), skipped_.end(), std::pair(std::min(a, b), std::max(a, b))) != skipped_.end();
}

void BulletWorld::ignore_pair(RigidId a, RigidId b, float seconds) {
    if (!is_known(a) || !is_known(b) || a == b) return;
    if (a > b) std::swap(a, b);
    InsideRigidEngine guard(counts_.allocations);
    const auto found = find_ignored(a, b);
    if (found != ignored_.end()) {
        found->seconds = std::max(found->seconds, seconds);
        return;
    }
    const auto place = std::lower_bound(ignored_.begin(), ignored_.end(), std::pair(a, b),
                                        [](const IgnoredPair& p, auto k) { return std::pair(p.a, p.b) < k; });
    ignored_.insert(place, {a, b, seconds});
    skip_contacts(a, b);
}

void BulletWorld::name_siblings(std::span<const RigidId> ids) {
    ++births_;
    for (const RigidId id : ids)
        if (is_known(id)) bodies_[id].birth = births_, bodies_[id].sibling_seconds = kSiblingSeconds;
}

void BulletWorld::part_siblings(RigidId a, RigidId b, std::span<const CrackTouch> touches) {
    if (!is_known(a) || !is_known(b) || a == b) return;
    InsideRigidEngine guard(counts_.allocations);
    refresh(bodies_[a]);
    refresh(bodies_[b]);
    look_at_newborn(bodies_[std::min(a, b)], bodies_[std::max(a, b)], touches, a > b);
}

void BulletWorld::look_at_newborn(const Body& a, const Body& b, std::span<const CrackTouch> touches, bool is_turned) {
    PairScratch& scratch = scratches_.own();
    find_candidates(a, b, kContactRange, scratch);
    for (const Candidate& c : scratch.candidates) {
        Vec3 guess;
        if (!c.hull_a || !c.hull_b) continue;
        const float range = scale_of(*c.hull_a, *c.hull_b) * kContactRange;
        if (separation(*c.hull_a, *c.hull_b, guess, range) >= range) continue;
        find_near(*c.hull_a, *c.hull_b, touches, scratch.touches);
        newborn_.push_back({a.id, b.id, c.a, c.b, crack_contact(scratch.touches, a.fresh_at, b.fresh_at, is_turned)});
    }
}

// Before the solve: sleepers that are struck, driven, or pressed since the last step by what is awake.
void BulletWorld::wake_struck() {
    const Pace pace(gravity_.length());
    for (const SortedManifold& m : manifolds_) {
        if (!m.manifold) continue;
        for (const auto& [sleeper, other] : {std::pair(m.a, m.b), std::pair(m.b, m.a)}) {
            Body &s = bodies_[sleeper], &o = bodies_[other];
            if (!is_asleep(sleeper) && !(s.settling_seconds > 0)) continue;
            const bool is_driver = o.kind == RigidKind::Kinematic && o.bullet->isActive();
            if (is_driver || (o.is_free() && is_struck(s, o, *m.manifold, pace))) {
                wake_body(s);
            } else if (is_asleep(sleeper) && o.is_free() &&
                       std::min(s.overlap, o.overlap) > bearable_overlap(s, pace)) {
                const float pressed = s.pressed_seconds;
                wake_beside(s);  // what lies deep below a slab is pushed out only while the slab gives way
                s.pressed_seconds = pressed;
            }
        }
    }
}

// By the speed that the meeting would leave the sleeper with, were it free and the touch central.
bool BulletWorld::is_struck(const Body& sleeper, const Body& other, const btPersistentManifold& manifold,
                            const Pace& pace) const {
    const float near = scale_of(sleeper, other) * kStruckGap;
    float closing = 0;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
        const btManifoldPoint& p = manifold.getContactPoint(k);
        const Vec3 velocity = velocity_at(other, from_bullet(p.m_positionWorldOnB));
        const float along = dot(velocity, from_bullet(p.m_normalWorldOnB));
        const bool is_b = manifold.getBody1() == &*other.bullet;
        if (p.m_distance1 < near) closing = std::max(closing, is_b ? along : -along);
    }
    return closing * other.mass > pace.speed * kWakeSpeed * (other.mass + sleeper.mass);
}

// What presses on each body in this step: all of it on what is awake, on sleepers what the waking give.
void BulletWorld::sum_loads() {
    for (RigidId id = 0; id < body_end_; ++id) bodies_[id].load = 0;
    for (const SortedManifold& m : manifolds_) {
        if (!m.manifold) continue;
        Body &a = bodies_[m.a], &b = bodies_[m.b];
        if (!a.is_free() && !b.is_free()) continue;
        float load = 0;
        for (int k = 0; k < m.manifold->getNumContacts(); ++k) load += m.manifold->getContactPoint(k).m_appliedImpulse;
        a.load += load;
        b.load += load;
    }
}

// After the solve: what leaves its place wakes what may have lain on it, and a heavy load what it lies on.
void BulletWorld::wake_unsettled(float dt, const Pace& pace) {
    const btVector3 up = -gravity_;
    const float weight_speed = up.length() * dt;
    for (const SortedManifold& m : manifolds_) {
        if (!m.manifold || m.manifold->getNumContacts() == 0) continue;
        const bool is_a_free = bodies_[m.a].is_free();
        if (is_a_free == bodies_[m.b].is_free()) continue;
        Body &sleeper = bodies_[is_a_free ? m.b : m.a], &other = bodies_[is_a_free ? m.a : m.b];
        if (!other.has_left || !is_asleep(sleeper.id)) continue;
        const btRigidBody& leaver = *other.bullet;
        const float speed = leaver.getLinearVelocity().length() + leaver.getAngularVelocity().length() * other.reach;
        if (sleeper.idle_wakes >= kIdleWakes && speed < pace.speed * kSlowSpeed) continue;
        const float along = m.manifold->getContactPoint(0).m_normalWorldOnB.dot(up);
        if ((is_a_free ? -along : along) >= 0) wake_beside(sleeper);
    }
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        if (!body.is_used || !is_asleep(id) || body.idle_wakes >= kIdleWakes) continue;
        if (body.load > kWakeLoads * body.slept_load + kWakeWeights * body.mass * weight_speed) wake_beside(body);
    }
}

// Half of what it takes to sleep again is left to it: it lay still before.
void BulletWorld::wake_beside(Body& body) {
    const uint32_t idle_wakes = body.idle_wakes;
    const btTransform far_anchor = body.far_anchor;
    const float creep_seconds = body.creep_seconds;
    wake_body(body);
    body.still_seconds = 0.5f * kStillSeconds;
    body.far_anchor = far_anchor;
    body.creep_seconds = std::min(creep_seconds, 0.5f * kCreepSeconds);
    body.idle_wakes = idle_wakes + 1;
}

// Of the fastest point, m/s.
float speed_of(const Body& body) {
    const btRigidBody& bullet = *body.bullet;
    return bullet.getLinearVelocity().length() + bullet.getAngularVelocity().length() * body.reach;
}

// What nothing holds up goes on to move, however slowly it does now: it falls, also together with what touches it, or
// drifts where there is no gravity. A ball that rolls goes on too: it has come far for its speed, where what trembles
// has not.
bool BulletWorld::may_come_to_rest(const Body& body, float dt, const Pace& pace) const {
    const float speed = speed_of(body);
    if (pace.is_weightless) return speed * kDriftSeconds < size_of(body) * kStillDistance;
    if (!body.is_touched) return false;
    const float gravity = gravity_.length(), patience = pace.slower * kStillSeconds;
    const bool is_faint = 0.5f * gravity * patience * patience < kFaintWay * kStillDistance;
    if (is_faint && body.load < kBorneShare * body.mass * gravity * dt) return false;
    if (!is_ball(body) || speed < pace.speed * kRollingSpeed) return true;
    const float gone = (body.bullet->getWorldTransform().getOrigin() - body.anchor.getOrigin()).length();
    return gone < kRollingShare * speed * body.still_seconds;
}

// Half a second within 3 mm, or a slow second; but what lies too deep in something stays awake to be pushed out.
bool BulletWorld::may_sleep(Body& body, float dt, const Pace& pace) {
    const btTransform& now = body.bullet->getWorldTransform();
    const float size = size_of(body), still_seconds = pace.slower * kStillSeconds,
                slow_seconds = pace.slower * kSlowSeconds, creep_seconds = pace.slower * kCreepSeconds;
    body.has_left = has_left(body, body.anchor, now, size * kStillDistance);
    if (body.has_left) {
        body.anchor = now;
        body.still_seconds = 0;
        body.idle_wakes = 0;
    } else {
        body.still_seconds = std::min(body.still_seconds + dt, 2 * still_seconds);
    }
    if (body.is_driven || has_left(body, body.far_anchor, now, size * kCreepDistance)) {
        body.far_anchor = now;
        body.creep_seconds = 0;
    } else {
        body.creep_seconds = std::min(body.creep_seconds + dt, creep_seconds);
    }
    const bool is_slow =
        body.is_touched && !is_ball(body) && speed_of(body) < std::sqrt(size) * pace.speed * kSlowSpeed;
    body.slow_seconds = std::clamp(body.slow_seconds + (is_slow ? dt : -2 * dt), 0.0f, 2 * slow_seconds);
    if (body.is_driven) body.still_seconds = body.slow_seconds = 0;
    if (!may_come_to_rest(body, dt, pace)) return false;
    if (has_crept(body, pace)) {
        body.idle_wakes = kIdleWakes;
        return true;
    }
    if (body.still_seconds < still_seconds && body.slow_seconds < slow_seconds) return false;
    if (body.overlap <= bearable_overlap(body, pace)) return true;
    body.pressed_seconds += dt;
    return false;
}

void BulletWorld::update_sleep(float dt) {
    sum_loads();
    const Pace pace(gravity_.length());
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        if (!body.is_used || body.kind != RigidKind::Dynamic || !body.is_free()) continue;
        const bool is_settling = body.settling_seconds > 0, was_woken_in_place = body.idle_wakes > 0;
        if (!is_settling && !may_sleep(body, dt, pace)) continue;
        if ((was_woken_in_place && !is_settling) || has_settled(body, dt)) fall_asleep(body);
    }
    wake_unsettled(dt, pace);
}

void BulletWorld::still_settling() {
    for (RigidId id = 0; id < body_end_; ++id) {
        Body& body = bodies_[id];
        if (!body.is_used || !(body.settling_seconds > 0) || !body.is_free()) continue;
        const float kept = kSettlingSpeed * size_of(body);
        set_velocities(body, kept * body.bullet->getLinearVelocity(), kept * body.bullet->getAngularVelocity());
    }
}

// False: it is pushed out of something, or awake again: it leaves its place, for it was tipping over in the step before
// it was laid to rest, or nothing bears it any more.
bool BulletWorld::has_settled(Body& body, float dt) {
    const bool is_settling = body.settling_seconds > 0;
    const btTransform& now = body.bullet->getWorldTransform();
    if (!is_settling && body.sunk <= kShallow) return true;
    if (!is_settling) body.anchor = now;
    const bool is_done = body.sunk <= kShallow || body.settling_seconds >= kSettlingSeconds;
    const bool is_borne = body.load >= kBorneShare * body.mass * gravity_.length() * dt;
    body.has_left = false;
    const bool leaves = has_left(body, body.anchor, now, size_of(body) * kStillDistance) || (is_done && !is_borne);
    if (body.is_driven || leaves)
        wake_beside(body);
    else if (is_done)
        return true;
    else
        body.settling_seconds += dt;
    return false;
}

// Asleep is held, but for the name: Bullet sees something static.
void BulletWorld::fall_asleep(Body& body) {
    set_velocities(body, {0, 0, 0}, {0, 0, 0});
    body.bullet->setActivationState(ISLAND_SLEEPING);
    body.settling_seconds = 0;
    body.slept_load = body.load;
    stop_mass(body);
}

bool BulletWorld::is_asleep(RigidId id) const {
    return is_known(id) && bodies_[id].kind == RigidKind::Dynamic && !bodies_[id].bullet->isActive();
}

void BulletWorld::wake_body(Body& body) {
    const bool was_asleep = !body.bullet->isActive();
    body.bullet->setActivationState(ACTIVE_TAG);
    body.still_seconds = body.slow_seconds = body.pressed_seconds = 0;
    body.creep_seconds = body.settling_seconds = 0;
    body.idle_wakes = 0;
    body.anchor = body.far_anchor = body.bullet->getWorldTransform();
    if (was_asleep && !body.is_held) restore_mass(body);
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
        if (!other.is_used || other.kind != RigidKind::Dynamic) continue;
        if (!other.bullet->isActive() || other.settling_seconds > 0) wake_body(other);
    }
}

}  // namespace cullet::bullet
