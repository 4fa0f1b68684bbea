#include "engine/bullet/sweep.hpp"

#include <algorithm>

#include "engine/bullet/advance.hpp"
#include "engine/bullet/bullet_world.hpp"
#include "engine/bullet/sides.hpp"

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

// What closes within so much of a way from the start of the step was within the range of contacts, seen and solved. At
// five times it bodies lose more than their contacts take: shards of one break end 0.15 m/s more apart (99 of 100).
// Lengths are those of scale 1.
constexpr float kMet = 0.0015f;     // m, and not just as far as a touching body may go
constexpr float kLeading = 0.001f;  // m behind the corner that leads: what else may have stopped the two
constexpr uint32_t kFastAJob = 8;
constexpr float kNeverSeen = -1;
constexpr int kBlows = 4;  // of a pair, each at another corner: the first ones turn the bodies
// What glances: closes by at most so much of what it goes along, and by at most half of what boxes are grown in a step.
constexpr double kGlance = 0.2;
constexpr float kLeastLed = 0.001f;
constexpr float kMostLed = kBoxGrowth / 2;  // m
constexpr double kShortOf = 0.99;           // of the way to the touch, so that the step ends before it

// The points of a hull that lead along `outwards`, of a body that stands where it was stopped.
template <class Found>
void visit_leading(const Body& body, const Hull& hull, Vec3 outwards, float within, Found found) {
    const btTransform at = body.hulls_at(body.bullet->getWorldTransform());
    Points points;
    transform_points(hull, rotation_of(at), from_bullet(at.getOrigin()), points);
    float most = -kFar;
    for (uint32_t k = 0; k < hull.point_count; ++k) most = std::max(most, dot(points[k], outwards));
    for (uint32_t k = 0; k < hull.point_count; ++k)
        if (dot(points[k], outwards) > most - within) found(points.centre + points[k]);
}

constexpr float kSlack = 1e-5f;  // m a step, as good as none

Vec3 middle_of_both(const Box& a, const Box& b) {
    const auto middle = [](float low_a, float low_b, float high_a, float high_b) {
        return 0.5f * (std::max(low_a, low_b) + std::min(high_a, high_b));
    };
    return {middle(a.low.x, b.low.x, a.high.x, b.high.x), middle(a.low.y, b.low.y, a.high.y, b.high.y),
            middle(a.low.z, b.low.z, a.high.z, b.high.z)};
}

// Where the point of a body was before the step that is now at `point`.
Vec3 was_at(const Body& body, Vec3 point) {
    const btTransform now = body.hulls_at(body.bullet->getWorldTransform());
    return from_bullet(body.fresh_at * now.invXform(to_bullet(point)));
}

}  // namespace

// Of its own contacts one is with somebody else, who stands behind it along the normal: what a press strikes goes
// nowhere then.
bool Sweeper::is_borne(const BulletWorld& world, const Body& body, RigidId driven, Vec3 normal) {
    bool is_any = false;
    const auto look_at = [&](uint32_t id) {
        if (is_any || id == body.id || id == driven) return;
        const PairAlgorithm* pair = world.pairs_.memory_of(std::min(id, body.id), std::max(id, body.id));
        if (!pair) return;
        pair->visit_manifolds([&](const btPersistentManifold& manifold, const PairRecord&) {
            for (int k = 0; k < manifold.getNumContacts(); ++k) {
                const Vec3 towards_a = from_bullet(manifold.getContactPoint(k).m_normalWorldOnB);
                is_any |= dot(body.id < id ? towards_a : -towards_a, normal) < -0.1f;
            }
        });
    };
    world.tree_.visit(world.tree_.box(body.leaf), look_at);
    return is_any;
}

// What is driven takes along whom it strikes, see carry(). Of several that strike a body the first one does.
void Sweeper::take_along(const BulletWorld& world, const Body& body, const Hull& hull, const Body& driven,
                         const Hull& driven_hull, const Touch& touch) {
    if (driven.kind != RigidKind::Kinematic || !body.is_fast || body.kind == RigidKind::Kinematic) return;
    Carrier& carrier = carriers_[body.id];
    if (carrier.driven != kNoRigid && (carrier.driven != driven.id || carrier.at <= touch.at)) return;
    if (is_before(body, driven.id, touch.normal) || is_borne(world, body, driven.id, touch.normal)) return;
    carrier = {driven.id, touch.normal, hull.world.centre, scale_of(hull, driven_hull) * kContactRange, touch.at};
}

// The driven one is stopped where it would go farther with the body than that may be carried, or where the body does
// not make way: it was too slow to be swept, or another driven one carries it, otherwise than this one goes.
float Sweeper::driven_until(const BulletWorld& world, const Body& driven, const Body& other, Vec3 normal, float at,
                            float dt) const {
    const Carrier& carrier = carriers_[other.id];
    if (carrier.driven == kNoRigid) return at;
    const float way = dt * dot(world.velocity_at(driven, carrier.place), normal);
    const float carried = dt * carried_speed(world, carrier) * dot(carrier.normal, normal);
    if (way > carried + kSlack) return at;
    return way > 0 ? at + carrier.most / way : 1;
}

// Something else stopped the body and stands in the way along `normal`.
bool Sweeper::is_before(const Body& body, RigidId driven, Vec3 normal) const {
    const Brake& brake = brakes_[body.id];
    return brake.other != kNoRigid && brake.other != driven && dot(brake.normal, normal) < -0.1f;
}

float Sweeper::carried_speed(const BulletWorld& world, const Carrier& carrier) {
    return dot(world.velocity_at(world.bodies_[carrier.driven], carrier.place), carrier.normal);
}

void Sweeper::stop(Body& body, const Hull& hull, const Body& other, const Hull& other_hull, const Touch& touch) {
    if (!body.is_fast || !(touch.at < body.moved_fraction)) return;
    body.moved_fraction = touch.at;
    const auto ordinal = [](const Body& of, const Hull& h) { return h.one_sided ? of.hull_count + h.cell : h.ordinal; };
    brakes_[body.id] = {other.id,
                        ordinal(body, hull),
                        ordinal(other, other_hull),
                        hull.one_sided ? nullptr : &hull,
                        other_hull.one_sided ? nullptr : &other_hull,
                        touch.normal,
                        touch.is_new};
}

// m: along their normal alone, for the rest of the step, as if both had been looked at from the driven one. Left behind
// a body would lie deep in a lift that rises, a step later, and hover over one that sinks. Up it goes no farther than
// contacts reach: that way is not swept. Down it would have gone faster by itself.
Vec3 Sweeper::carry(const BulletWorld& world, const Body& body, float dt) const {
    const Carrier& carrier = carriers_[body.id];
    if (carrier.driven == kNoRigid || !body.is_free() || is_before(body, carrier.driven, carrier.normal)) return {};
    const float rest = dt * std::max(0.0f, world.bodies_[carrier.driven].moved_fraction - carrier.at);
    return std::min(rest * carried_speed(world, carrier), carrier.most) * carrier.normal;
}

// What stopped a body near the start of its way takes the speed that leads into it, as a blow without restitution.
// Contacts lie where two pieces face each other; a corner beside those that swings in is held up by the sweep alone. A
// body that such a corner stops in every step would keep its speed and go a millimetre a step: heaps of fifty shards
// sleep after 218 steps in the mean without these blows, after 192 with them.
void Sweeper::slow_down(BulletWorld& world) {
    for (const Fast& fast : fast_) {
        const Brake& brake = brakes_[fast.id];
        if (brake.other == kNoRigid) continue;
        const Brake& theirs = brakes_[brake.other];
        const bool is_shared =
            theirs.other == fast.id && theirs.ordinal == brake.other_ordinal && theirs.other_ordinal == brake.ordinal;
        if (is_shared && brake.other < fast.id) continue;
        Body &a = world.bodies_[fast.id], &b = world.bodies_[brake.other];
        // A flight's end, and what is skipped, comes with a later step.
        if (!a.is_touched || !b.is_touched || world.is_skipped(a.id, b.id)) continue;
        const Hull& p = hull_of(brake.hull, a, brake.ordinal, {}, world.scratches_.own());
        const Hull& q = hull_of(brake.other_hull, b, brake.other_ordinal, {}, world.scratches_.own());
        for (int k = 0; k < kBlows; ++k)
            if (!stop_closing(world, a, p, b, q, brake.normal)) break;
    }
}

// Takes `closing`, m/s of approach at a place, from the spins that bring it about, by their shares in it.
void Sweeper::slow_spins(Body& a, Body& b, Vec3 place, Vec3 normal, float closing) {
    const btVector3 along = to_bullet(normal), point = to_bullet(place);
    Body* const bodies[] = {&a, &b};
    btVector3 arm[2];
    float closes[2] = {};
    for (int k = 0; k < 2; ++k) {
        if (!bodies[k]->is_free()) continue;
        const btRigidBody& body = *bodies[k]->bullet;
        arm[k] = (point - body.getCenterOfMassPosition()).cross(k == 0 ? along : -along);
        closes[k] = std::max(0.0f, -arm[k].dot(body.getAngularVelocity()));
    }
    const float both = closes[0] + closes[1];
    if (!(both > 0)) return;
    for (int k = 0; k < 2; ++k) {
        if (!(closes[k] > 0)) continue;
        const float softness = arm[k].dot(bodies[k]->bullet->getInvInertiaTensorWorld() * arm[k]);
        if (softness > 0)
            bodies[k]->bullet->applyTorqueImpulse(std::min(1.0f, closing / both) * closes[k] / softness * arm[k]);
    }
}

// At the corner of either piece that closes fastest; false when none does.
bool Sweeper::stop_closing(BulletWorld& world, Body& a, const Hull& p, Body& b, const Hull& q, Vec3 normal) {
    const float scale = scale_of(p, q), met = scale * kMet, leading = scale * kLeading;
    Vec3 place;
    float closing = 0;  // m/s
    const auto offer = [&](Vec3 point) {
        const float speed = dot(world.velocity_at(b, point) - world.velocity_at(a, point), normal);
        if (!(speed > closing) || dot(was_at(a, point) - was_at(b, point), normal) > met) return;
        closing = speed, place = point;
    };
    visit_leading(a, p, -normal, leading, offer);
    visit_leading(b, q, normal, leading, offer);
    if (!(closing > 0)) return false;
    const btVector3 along = to_bullet(normal), point = to_bullet(place);
    const auto arm = [&](const Body& body) { return point - body.bullet->getCenterOfMassPosition(); };
    const auto inverse_mass = [](const Body& body) { return body.is_free() ? body.bullet->getInvMass() : 0.0f; };
    const auto give = [&](const Body& body) {  // 1/kg
        if (!body.is_free()) return 0.0f;
        const btVector3 lever = arm(body).cross(along);
        return body.bullet->getInvMass() + lever.dot(body.bullet->getInvInertiaTensorWorld() * lever);
    };
    const float gives = give(a) + give(b);
    if (!(gives > 0)) return false;  // neither is free: what is driven meets what is held
    // Siblings do not throw each other (see SiblingRows).
    const float straight = inverse_mass(a) + inverse_mass(b);
    float blow = closing / gives;
    if (are_siblings(a, b)) {
        const auto flight_of = [&](const Body& body) {
            return world.velocity_at(body, from_bullet(body.bullet->getCenterOfMassPosition()));
        };
        const float flight = dot(flight_of(b) - flight_of(a), normal);
        blow = std::min(blow, std::max(flight, 0.0f) / straight);
        slow_spins(a, b, place, normal, closing - blow * gives);
    }
    const btVector3 impulse = blow * along;
    const auto push = [&](Body& body, const btVector3& by) {
        if (body.is_free()) return body.bullet->applyImpulse(by, arm(body));
        world.to_static_ += Vec3d(from_bullet(by));
        if (!CULLET_CHECKS_ON || body.kind != RigidKind::Kinematic) return;
        const double work = -static_cast<double>(dot(from_bullet(by), world.velocity_at(body, place)));
        world.work_done_.driven += std::max(0.0, work);
    };
    push(a, impulse);
    push(b, -impulse);
    return true;
}

void Sweeper::find_near(const BulletWorld& world, const Box& box, std::vector<RigidId>& near) {
    near.clear();
    world.tree_.visit(box, [&near](uint32_t id) { near.push_back(id); });
    std::sort(near.begin(), near.end());
}

// Calls found(p, q, touch of p) for pieces that touch before the two have both stopped.
template <class Found>
void Sweeper::visit_touches(const BulletWorld& world, Body& a, Body& b, float dt, PairScratch& scratch, Found found) {
    if (a.kind != RigidKind::Dynamic && b.kind != RigidKind::Dynamic) return;
    if (!a.meets_layer_of(b) || world.is_apart_by_order(a.id, b.id)) return;
    const Mover mover_a = mover_of(a), mover_b = mover_of(b);
    const double relative =
        length(mover_a.velocity - mover_b.velocity) + length(mover_a.spin) * a.reach + length(mover_b.spin) * b.reach;
    if (!are_split(a, b) && !is_far(relative * dt, scale_of(a, b), std::min(a.thickness, b.thickness))) return;
    const float turned_b = turned(mover_b, b.reach, dt);
    const Box all_a = relative_box(a.shape.box, mover_a, mover_b, a.reach, dt);
    scratch.near_b.clear();
    for (const Hull* q = b.hulls; q; q = q->next)
        if (overlap(q->world_box, all_a, turned_b)) scratch.near_b.push_back(q);
    const KnownAxes known{world.pairs_.memory_of(std::min(a.id, b.id), std::max(a.id, b.id)), b.id < a.id};
    Vec3d axis;
    const auto advance = [&](const Hull& p, const Hull& q) {
        if (known.at_crack(p, q)) return;
        const double limit = last_fraction(a, b);
        const double t = touch_fraction(world.work_.around, mover_a, p, mover_b, q, dt, limit, axis, known);
        if (t >= limit) return;
        const Vec3d met = known.of(p, q);
        found(p, q, Touch{axis.to_float(), static_cast<float>(t), !(dot(met, met) > 0)});
    };
    for (const Hull* p = a.hulls; p; p = p->next) {
        const float span = dt * last_fraction(a, b);
        const Box box = relative_box(p->world_box, mover_a, mover_b, reach_of(a, *p), span);
        if (!overlap(box, b.shape.box, turned_b)) continue;
        for (const Hull* q : scratch.near_b)
            if (overlap(box, q->world_box, turned(mover_b, reach_of(b, *q), span))) advance(*p, *q);
        if (!b.mesh) continue;
        const Vec3 seen_from = inner_point(*p, a.fresh_at);
        visit_triangles(*b.mesh, box, [&](uint32_t t) {
            build_seen_triangle(scratch.triangle, *b.mesh, t, t, seen_from);
            // Away from the face that it sees.
            if (dot(mover_a.velocity, Vec3d(scratch.triangle.face_normal[0])) < 0) advance(*p, scratch.triangle);
        });
    }
}

void Sweeper::sweep_pair(BulletWorld& world, Body& a, Body& b, float dt) {
    for (const auto& [body, driven] : {std::pair(&a, &b), std::pair(&b, &a)})
        if (carriers_[body->id].driven == driven->id) carriers_[body->id] = {};
    const auto until = [&](const Body& body, const Body& other, const Touch& touch) {
        const bool is_driven = body.kind == RigidKind::Kinematic;
        return is_driven ? driven_until(world, body, other, -touch.normal, touch.at, dt) : touch.at;
    };
    visit_touches(world, a, b, dt, world.scratches_.own(), [&](const Hull& p, const Hull& q, const Touch& of_a) {
        const Touch of_b{-of_a.normal, of_a.at, of_a.is_new};
        take_along(world, a, p, b, q, of_a);
        take_along(world, b, q, a, p, of_b);
        stop(a, p, b, q, {of_a.normal, until(a, b, of_a), of_a.is_new});
        stop(b, q, a, p, {of_b.normal, until(b, a, of_b), of_b.is_new});
    });
}

bool Sweeper::touch_on_whole_ways(const BulletWorld& world, Body& a, Body& b, float dt, PairScratch& scratch) {
    bool is_any = false;
    visit_touches(world, a, b, dt, scratch, [&](const Hull&, const Hull&, const Touch&) { is_any = true; });
    return is_any;
}

// What goes no farther than the thinnest thing of all asks for is swept against nothing.
void Sweeper::list_fast(BulletWorld& world, float dt) {
    float thinnest = kFar, least_scale = 1;
    for (RigidId id = 0; id < world.body_end_; ++id) {
        const Body& body = world.bodies_[id];
        if (!body.is_used) continue;
        thinnest = std::min(thinnest, body.thickness), least_scale = std::min(least_scale, scale_of(body));
    }
    fast_.clear(), driven_.clear();
    for (RigidId id = 0; id < world.body_end_; ++id) {
        Body& body = world.bodies_[id];
        brakes_[id].other = carriers_[id].driven = kNoRigid;
        if (!body.is_used || body.kind == RigidKind::Static) continue;
        body.moved_fraction = 1;
        body.glance = {};
        body.is_fast = false;
        const Mover mover = mover_of(body);
        if (!is_far(travel(mover, dt), least_scale, thinnest)) continue;
        body.is_fast = true;
        if (body.kind == RigidKind::Kinematic) driven_.push_back(static_cast<uint32_t>(fast_.size()));
        fast_.push_back({id, swept_box(body.shape.box, mover, body.reach, dt), -1});
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
void Sweeper::find_fast(uint32_t k, std::vector<uint32_t>& near) const {
    near.clear();
    const Box& swept = fast_[k].swept;
    auto next = std::lower_bound(by_low_.begin(), by_low_.end(), low_of(k) - longest_,
                                 [this](uint32_t j, double from) { return low_of(j) < from; });
    for (; next != by_low_.end() && low_of(*next) <= double{swept.high.*axis_}; ++next)
        if (*next > k && overlap(swept, fast_[*next].swept, 0)) near.push_back(*next);
    std::sort(near.begin(), near.end());
}

// On all threads: who is near whom, and whose whole ways meet, which those of most do not. What comes of the others
// depends on who was stopped before, so that they are swept one after another.
void Sweeper::find_neighbours(BulletWorld& world, float dt) {
    row_count_.store(0, std::memory_order_relaxed);
    const auto count = static_cast<uint32_t>(fast_.size());
    world.scratches_.run((count + kFastAJob - 1) / kFastAJob, [&](uint32_t job, PairScratch& scratch) {
        for (uint32_t k = job * kFastAJob; k < std::min(count, (job + 1) * kFastAJob); ++k)
            list_neighbours(world, k, dt, scratch);
    });
    has_rows_ = row_count_.load(std::memory_order_relaxed) <= rows_.size();
}

void Sweeper::list_neighbours(BulletWorld& world, uint32_t k, float dt, PairScratch& scratch) {
    Fast& fast = fast_[k];
    Body& a = world.bodies_[fast.id];
    find_near(world, fast.swept, scratch.bodies);
    std::erase_if(scratch.bodies, [&](RigidId id) {
        Body& b = world.bodies_[id];
        return id == a.id || b.is_fast || !touch_on_whole_ways(world, a, b, dt, scratch);
    });
    find_fast(k, scratch.fast);
    fast.slow_count = static_cast<uint32_t>(scratch.bodies.size());
    fast.fast_count = static_cast<uint32_t>(scratch.fast.size());
    const size_t needed = scratch.bodies.size() + scratch.fast.size();
    size_t row = row_count_.fetch_add(needed, std::memory_order_relaxed);
    fast.first_row = static_cast<uint32_t>(row);
    if (row + needed > rows_.size()) return;
    for (const RigidId id : scratch.bodies) rows_[row++] = {id, kNeverSeen, kNeverSeen};
    for (const uint32_t j : scratch.fast) {
        const float seen = touch_on_whole_ways(world, a, world.bodies_[fast_[j].id], dt, scratch) ? kNeverSeen : 1;
        rows_[row++] = {j, seen, seen};
    }
}

// True: it was stopped, or led along what would have.
bool Sweeper::sweep_slow(BulletWorld& world, uint32_t k, float dt) {
    Fast& fast = fast_[k];
    Body& a = world.bodies_[fast.id];
    if (has_rows_) {
        for (uint32_t n = 0; n < fast.slow_count; ++n)
            sweep_pair(world, a, world.bodies_[rows_[fast.first_row + n].other], dt);
    } else {
        sweep_near(world, fast, dt);
    }
    if (a.moved_fraction == 1) return false;
    fast.stopped_in = 0;
    go_along(world, fast, dt);
    return true;
}

void Sweeper::sweep_near(BulletWorld& world, const Fast& fast, float dt) {
    std::vector<RigidId>& near = world.scratches_.own().bodies;
    find_near(world, fast.swept, near);
    Body& a = world.bodies_[fast.id];
    for (const RigidId id : near)
        if (id != a.id && !world.bodies_[id].is_fast) sweep_pair(world, a, world.bodies_[id], dt);
}

// Its way is bent along what stopped it, so that it comes as near to that at the end of the step. The contact that it
// meets there takes the speed that leads into it.
void Sweeper::go_along(BulletWorld& world, Fast& fast, float dt) {
    Body& a = world.bodies_[fast.id];
    const Brake brake = brakes_[fast.id];
    // What lies in something is not led about in it. A ball touches in one point, whose contact leads it better: over
    // triangles of a centimetre it hopped by 0.3 mm.
    if (!brake.is_new || a.overlap > kMet || !a.is_free() || !brake.hull || brake.hull->face_count == 0) return;
    Body& other = world.bodies_[brake.other];
    if (mover_of(other).is_moving()) return;
    const Vec3d velocity = mover_of(a).velocity, normal(brake.normal);
    const double closing = -dot(velocity, normal), aside = length(velocity + closing * normal);
    if (closing * dt < scale_of(a, other) * kLeastLed || closing > kGlance * aside)
        return;  // contacts take what is less
    const float stopped_at = a.moved_fraction;
    const Vec3 glance = ((1 - kShortOf * static_cast<double>(stopped_at)) * closing * normal).to_float();
    if (length(glance) * dt > kMostLed) return;
    a.glance = glance;
    a.moved_fraction = 1;
    brakes_[fast.id].other = kNoRigid;
    sweep_near(world, fast, dt);
    const bool is_farther = a.moved_fraction > stopped_at;
    if (!is_farther) a.glance = {}, a.moved_fraction = stopped_at;
    // What met it from the start still takes its speed.
    if (!is_farther || brakes_[fast.id].other == kNoRigid) brakes_[fast.id] = brake;
}

// True: one of the two was stopped.
bool Sweeper::sweep_two_fast(BulletWorld& world, Fast& fast, Fast& other, int round, float dt) {
    Body &a = world.bodies_[fast.id], &b = world.bodies_[other.id];
    const float before_a = a.moved_fraction, before_b = b.moved_fraction;
    sweep_pair(world, a, b, dt);
    if (a.moved_fraction < before_a) fast.stopped_in = round;
    if (b.moved_fraction < before_b) other.stopped_in = round;
    return a.moved_fraction < before_a || b.moved_fraction < before_b;
}

// Against the fast ones behind it. Who is stopped later than it was swept against another one stands where that one saw
// it pass: those two are looked at again in the next round. True: somebody was stopped.
bool Sweeper::sweep_fast(BulletWorld& world, uint32_t k, int round, float dt) {
    Fast& fast = fast_[k];
    bool is_any = false;
    if (!has_rows_) {
        std::vector<uint32_t>& near = world.scratches_.own().fast;
        find_fast(k, near);
        for (const uint32_t j : near)
            if (round == 0 || std::max(fast.stopped_in, fast_[j].stopped_in) >= round - 1)
                is_any |= sweep_two_fast(world, fast, fast_[j], round, dt);
        return is_any;
    }
    const Body& a = world.bodies_[fast.id];
    for (uint32_t n = 0; n < fast.fast_count; ++n) {
        Neighbour& row = rows_[fast.first_row + fast.slow_count + n];
        Fast& other = fast_[row.other];
        const Body& b = world.bodies_[other.id];
        // Those behind are led after they were seen.
        const bool is_led = round <= 1 && (dot(a.glance, a.glance) > 0 || dot(b.glance, b.glance) > 0);
        if (!is_led && row.seen_a == a.moved_fraction && row.seen_b == b.moved_fraction) continue;
        is_any |= sweep_two_fast(world, fast, other, round, dt);
        row.seen_a = a.moved_fraction, row.seen_b = b.moved_fraction;
    }
    return is_any;
}

// Fast kinematic bodies that stand beside the k-th fast one and move as it does, one after another.
void Sweeper::gather_as_one(const BulletWorld& world, uint32_t k) {
    group_.clear();
    const auto add = [this](uint32_t of) { is_in_group_[of] = true, group_.push_back(of); };
    add(k);
    for (size_t n = 0; n < group_.size(); ++n) {
        const Body& body = world.bodies_[fast_[group_[n]].id];
        const Box around = grown(body.shape.box, kFlush);
        world.tree_.visit(around, [&](uint32_t id) {
            const Body& other = world.bodies_[id];
            if (other.kind != RigidKind::Kinematic || !other.is_fast || !overlap(other.shape.box, around, 0)) return;
            const auto at = std::lower_bound(fast_.begin(), fast_.end(), id,
                                             [](const Fast& fast, RigidId wanted) { return fast.id < wanted; });
            const auto which = static_cast<uint32_t>(at - fast_.begin());
            if (is_in_group_[which]) return;
            const Vec3 place = middle_of_both(around, other.shape.box);
            if (length(world.velocity_at(body, place) - world.velocity_at(other, place)) < kAsOne) add(which);
        });
    }
}

// Tiles of a lift are stopped as one: where one stood a millimetre behind the others, the next one was a kerb. True:
// one of them has less of its way now, so that what was swept against it is to be looked at again.
bool Sweeper::stop_as_one(BulletWorld& world, int round) {
    bool is_any = false;
    for (const uint32_t k : driven_) {
        if (world.bodies_[fast_[k].id].moved_fraction == 1 || is_in_group_[k]) continue;
        gather_as_one(world, k);
        float least = 1;
        for (const uint32_t of : group_) least = std::min(least, world.bodies_[fast_[of].id].moved_fraction);
        for (const uint32_t of : group_) {
            Body& body = world.bodies_[fast_[of].id];
            if (!(body.moved_fraction > least)) continue;
            body.moved_fraction = least, fast_[of].stopped_in = round;
            is_any = true;
        }
    }
    for (const uint32_t k : driven_) is_in_group_[k] = false;
    return is_any;
}

uint32_t Sweeper::sweep(BulletWorld& world, float dt) {
    constexpr int kRounds = 4;
    list_fast(world, dt);
    order_fast();
    find_neighbours(world, dt);
    bool is_any = true;
    for (int round = 0; round < kRounds && is_any; ++round) {
        is_any = false;
        for (uint32_t k = 0; k < fast_.size(); ++k) {
            if (round == 0) is_any |= sweep_slow(world, k, dt);
            is_any |= sweep_fast(world, k, round, dt);
        }
        is_any |= stop_as_one(world, round);
    }
    uint32_t stopped = 0;
    for (const Fast& fast : fast_) stopped += world.bodies_[fast.id].moved_fraction < 1;
    return stopped;
}

}  // namespace cullet::bullet
