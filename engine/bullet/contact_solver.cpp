#include "engine/bullet/contact_solver.hpp"

#include <LinearMath/btTransformUtil.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace cullet::bullet {
namespace {

// Bodies of a heap have 4 to 6 contact points each, half of their neighbours' counted. Beyond that arrays grow while
// they run.
constexpr size_t kPointsOfABody = 16;
// Iterations end once the largest change of a contact's speed in one of them is below this, (m/s) squared: at a hundred
// times it heaps sleep as soon and lie a quarter deeper in each other; at ten times it they lie as here, but a stack of
// five boxes leans by 3.4 mm, a tenth of that here. An error in speed is a depth after so many steps: it goes with the
// scale of the pair, and with how fast things fall. With a millimetre a second for all, walls of a quarter of a
// millimetre lie a quarter of that deep in the floor.
constexpr float kSettledSquare = 1e-6f;
// Until then a step takes as many as come to this many contacts in all, within these bounds. Of 16 heaps of fifty
// curved shards one has a contact deeper than 3 mm with three quarters as many and half of that for the pushes, none
// with these; with a fixed twenty (and rows one after the other) shards were pressed through each other. From 4,000
// contacts on it is twenty: heaps of thousands have no time for more. (A pile of a thousand hulls lies as deep with 10
// as with 20, a tenth of a millimetre in the mean.)
constexpr int kContactTurns = 80000, kLeastIterations = 20, kMostIterations = 100;

constexpr float kWarm = 0.85f;             // of the last step's impulses are handed on
constexpr float kPushed = 0.2f;            // of an overlap is pushed out in a step,
constexpr float kTurnedOut = 0.1f;         // of the turning that goes with it is done
constexpr float kRestitutionSpeed = 0.2f;  // m/s, below which nothing bounces
// Nor does what, at the speed at which it closes, lay deeper than this a step ago already: it does not strike, it sinks
// in. A curved shard that rocks on the floor gets corners in it that no contact held, and was thrown up by each of them
// for seven seconds.
constexpr float kStruckDepth = 0.001f;  // m, at scale 1

// Of a contact's softness, below which spins cannot be what closes it: the touch is central.
constexpr float kLeastTurning = 1e-3f;

constexpr uint32_t kNoPair = 0xffffffffu;
constexpr uint32_t kColours = 64;         // of pairs of free bodies, as many again of those with something that stands,
constexpr uint32_t kNoColour = kColours;  // and one for the rest of each: they go one by one
constexpr uint32_t kSizes = 16;           // pairs of a colour by falling number of points, so that lanes are full
constexpr uint32_t kBatchesAJob = 32;
constexpr uint32_t kKeysOfAGroup = 2 * (kColours + 1) * kSizes;
constexpr uint32_t kMostGroups = 8;
// An island in which something bears so many times its own weight is laden: impulses need a turn for each body and each
// ratio of two masses on their way through it. Its iterations end at a tenth of the change of speed, and it has as many
// contact turns as a step has at most. 290 kg on three boxes of 9 kg fell off without, now they lean by 0.6 mm; a tower
// of forty boxes stands. Larger islands are heaps, which have no time for it.
constexpr float kLadenWeights = 8;
constexpr uint32_t kMostLadenPoints = 500;
constexpr int kLadenTurns = 80000, kMostLadenIterations = 1000;
constexpr float kLadenSettledSquare = 1e-8f;
// What is laid on another, and closes on it more slowly than this, m/s, instead of striking it, lades it where it
// weighs so many times as much.
constexpr float kLaidWeights = 20, kLaidSpeed = 0.2f;
// Contacts from which on two groups are worth the start of a job; four times as many for four of them.
constexpr uint32_t kPointsOfTwoGroups = 500;

}  // namespace

/// Four bodies as set-up reads them.
struct ContactSolver::Source {
    LaneVec centre, velocity, spin;  // velocities before this step's forces
    LaneVec force_speed;             // m/s that forces give in this step
    Lanes inverse_mass;
    LaneVec inertia[3];  // inverse, world: rows

    Source(const std::vector<btRigidBody*>& bodies, const uint32_t (&number)[kLanes], float dt) {
        float c[3][kLanes] = {}, v[3][kLanes] = {}, w[3][kLanes] = {}, f[3][kLanes] = {}, m[kLanes] = {},
              i[9][kLanes] = {};
        for (uint32_t k = 0; k < kLanes; ++k) {
            if (number[k] == kStanding) continue;
            const btRigidBody& body = *bodies[number[k]];
            m[k] = body.getInvMass();
            for (int axis = 0; axis < 3; ++axis) {
                c[axis][k] = body.getCenterOfMassPosition()[axis];
                v[axis][k] = body.getLinearVelocity()[axis];
                w[axis][k] = body.getAngularVelocity()[axis];
                f[axis][k] = body.getTotalForce()[axis] * body.getInvMass() * dt;
                for (int j = 0; j < 3; ++j) i[3 * axis + j][k] = body.getInvInertiaTensorWorld()[axis][j];
            }
        }
        const auto vector = [](const float(&from)[3][kLanes]) {
            return LaneVec{load(from[0]), load(from[1]), load(from[2])};
        };
        centre = vector(c), velocity = vector(v), spin = vector(w), force_speed = vector(f);
        inverse_mass = load(m);
        for (int axis = 0; axis < 3; ++axis)
            inertia[axis] = {load(i[3 * axis]), load(i[3 * axis + 1]), load(i[3 * axis + 2])};
    }
    LaneVec turned_by(const LaneVec& torque) const {
        return {dot(inertia[0], torque), dot(inertia[1], torque), dot(inertia[2], torque)};
    }
};

ContactSolver::ContactSolver(uint32_t body_limit) {
    const size_t bodies = size_t{body_limit} + 1, points = kPointsOfABody * body_limit + 1024;
    bodies_.reserve(bodies);
    changes_.reserve(bodies);
    colours_.reserve(bodies);
    pairs_.reserve(points / 2);
    points_.reserve(points);
    order_.reserve(points / 2);
    key_begin_.resize((kMostGroups + 1) * kKeysOfAGroup + 1);
    above_.reserve(bodies);
    weights_.reserve(bodies);
    island_points_.reserve(bodies);
    group_of_.reserve(bodies);
    islands_.reserve(bodies);
    groups_.reserve(kMostGroups + 1);
    laden_.reserve(bodies);
    batches_.reserve(points / 2);
    batch_pairs_.reserve(2 * points);
    rows_.reserve(points / 2);
    rolls_.reserve(points / 2);
    siblings_.reserve(points / 2);
    clear();
}

void ContactSolver::clear() {
    bodies_.clear(), pairs_.clear(), points_.clear();
    bodies_.push_back(nullptr);
}

uint32_t ContactSolver::add_body(btRigidBody& body) {
    bodies_.push_back(&body);
    return static_cast<uint32_t>(bodies_.size() - 1);
}

void ContactSolver::add_pair(uint32_t a, uint32_t b, float grip, float most_push, bool are_siblings, float scale) {
    pairs_.push_back({a, b, static_cast<uint32_t>(points_.size()), 0, grip, most_push, are_siblings, false, scale, 0});
}

void ContactSolver::add_contacts(btPersistentManifold& manifold) {
    for (int k = 0; k < manifold.getNumContacts(); ++k) points_.push_back(&manifold.getContactPoint(k));
    pairs_.back().count = static_cast<uint32_t>(points_.size()) - pairs_.back().first;
}

bool ContactSolver::is_free(uint32_t number) const {
    return bodies_[number] && bodies_[number]->getInvMass() > 0;
}

// Ways are halved as they are gone.
uint32_t ContactSolver::root_of(uint32_t number) {
    while (above_[number] != number) number = above_[number] = above_[above_[number]];
    return number;
}

uint32_t ContactSolver::root_of(const Contacts& pair) {
    return root_of(is_free(pair.a) ? pair.a : pair.b);
}

// N s that each body weighs in a step.
void ContactSolver::weigh_bodies(float dt) {
    weights_.resize(bodies_.size());
    for (uint32_t number = 0; number < weights_.size(); ++number)
        weights_[number] = is_free(number) ? dt * static_cast<float>(bodies_[number]->getTotalForce().length()) : 0;
}

// Within 45 degrees, and not struck: laid on it.
bool ContactSolver::is_heavier_laid_on_other(const Contacts& pair) const {
    const btRigidBody &a = *bodies_[pair.a], &b = *bodies_[pair.b];
    const bool is_a = weights_[pair.a] > weights_[pair.b];
    const btVector3 force = (is_a ? a : b).getTotalForce(), down = (is_a ? -1 : 1) * force,
                    closing = b.getLinearVelocity() - a.getLinearVelocity();
    const float least = 0.7f * force.length();
    for (uint32_t k = pair.first; k < pair.first + pair.count; ++k) {
        const btVector3& normal = points_[k]->m_normalWorldOnB;
        if (down.dot(normal) > least && closing.dot(normal) < kLaidSpeed) return true;
    }
    return false;
}

// By what was handed on from the last step, of the lighter one's weight; where nothing was, by the weight of the
// heavier one: the first step is to bear it already, or it begins to sink in.
bool ContactSolver::is_laden(const Contacts& pair) const {
    const float weight_a = weights_[pair.a], weight_b = weights_[pair.b];
    const bool are_free = weight_a > 0 && weight_b > 0;
    const float weight = are_free ? std::min(weight_a, weight_b) : std::max(weight_a, weight_b);
    float load = 0;
    for (uint32_t k = pair.first; k < pair.first + pair.count; ++k) load += points_[k]->m_appliedImpulse;
    if (load > 0 || !are_free) return load > kLadenWeights * weight && weight > 0;
    return std::max(weight_a, weight_b) > kLaidWeights * weight && is_heavier_laid_on_other(pair);
}

// The largest island first, each to the group that has the fewest contacts; laden ones to the last group.
void ContactSolver::group_islands(float dt) {
    uint32_t count = 1;
    for (size_t points = kPointsOfTwoGroups; count < kMostGroups && points_.size() >= points; points *= 4) count *= 2;
    groups_.assign(count, {});
    weigh_bodies(dt);
    const bool any_laden =
        std::any_of(pairs_.begin(), pairs_.end(), [&](const Contacts& pair) { return is_laden(pair); });
    if (count == 1 && !any_laden) return;
    above_.resize(bodies_.size());
    for (uint32_t number = 0; number < above_.size(); ++number) above_[number] = number;
    for (const Contacts& pair : pairs_) {
        if (!is_free(pair.a) || !is_free(pair.b)) continue;
        const uint32_t a = root_of(pair.a), b = root_of(pair.b);
        above_[std::max(a, b)] = std::min(a, b);
    }
    island_points_.assign(bodies_.size(), 0);
    laden_.assign(bodies_.size(), 0);
    for (const Contacts& pair : pairs_) {
        island_points_[root_of(pair)] += pair.count;
        if (any_laden && is_laden(pair)) laden_[root_of(pair)] = 1;
    }
    islands_.clear();
    for (uint32_t root = 0; root < island_points_.size(); ++root)
        if (island_points_[root] > 0) islands_.push_back({island_points_[root], root});
    std::sort(islands_.begin(), islands_.end(), [](const Island& p, const Island& q) {
        return p.points != q.points ? p.points > q.points : p.root < q.root;
    });
    group_of_.resize(bodies_.size());
    uint32_t points[kMostGroups] = {};
    bool has_laden = false;
    for (const Island& island : islands_) {
        if (laden_[island.root] && island.points <= kMostLadenPoints) {
            group_of_[island.root] = count;
            has_laden = true;
            continue;
        }
        uint32_t* const fewest = std::min_element(points, points + count);
        *fewest += island.points;
        group_of_[island.root] = static_cast<uint32_t>(fewest - points);
    }
    if (has_laden) groups_.push_back({0, 0, true});
    if (groups_.size() == 1) return;
    for (Contacts& pair : pairs_) pair.is_laden = group_of_[root_of(pair)] == count;
}

// Keys, and pairs by key in the order that they were given.
void ContactSolver::colour_pairs() {
    colours_.assign(bodies_.size(), 0);
    const auto keys = static_cast<uint32_t>(groups_.size()) * kKeysOfAGroup;
    std::fill_n(key_begin_.begin(), keys + 1, 0);
    bool was_standing = false;
    for (Contacts& pair : pairs_) {
        const bool is_a_free = is_free(pair.a), is_b_free = is_free(pair.b), is_standing = !is_a_free || !is_b_free;
        if (is_standing && !was_standing) std::fill(colours_.begin(), colours_.end(), 0);
        was_standing = is_standing;
        uint64_t none = 0;
        uint64_t &of_a = is_a_free ? colours_[pair.a] : none, &of_b = is_b_free ? colours_[pair.b] : none;
        const auto colour = static_cast<uint32_t>(std::countr_one(of_a | of_b));
        if (colour != kNoColour) of_a |= uint64_t{1} << colour, of_b |= uint64_t{1} << colour;
        const uint32_t size = kSizes - std::min(pair.count, kSizes);
        const uint32_t group = groups_.size() == 1 ? 0 : group_of_[root_of(pair)];
        pair.key = group * kKeysOfAGroup + (colour + (is_standing ? kColours + 1 : 0)) * kSizes + size;
        ++key_begin_[pair.key + 1];
    }
    for (uint32_t key = 0; key < keys; ++key) key_begin_[key + 1] += key_begin_[key];
    order_.resize(pairs_.size());
    for (uint32_t k = 0; k < pairs_.size(); ++k) order_[key_begin_[pairs_[k].key]++] = k;
}

void ContactSolver::fill_batches() {
    batches_.clear(), batch_pairs_.clear();
    const auto key_of = [this](size_t k) { return pairs_[order_[k]].key; };
    size_t first = 0;
    for (uint32_t g = 0; g < groups_.size(); ++g) {
        groups_[g].first = static_cast<uint32_t>(batches_.size());
        while (first < order_.size() && key_of(first) / kKeysOfAGroup == g) {
            const uint32_t colour = key_of(first) / kSizes;
            const size_t most = colour % (kColours + 1) == kNoColour ? 1 : kLanes;
            size_t end = first + 1;
            while (end < order_.size() && end < first + most && key_of(end) / kSizes == colour) ++end;
            fill_batch(order_.data() + first, static_cast<uint32_t>(end - first));
            first = end;
        }
        groups_[g].end = static_cast<uint32_t>(batches_.size());
    }
}

void ContactSolver::fill_batch(const uint32_t* pairs, uint32_t count) {
    Batch batch;
    batch.first_point = batches_.empty() ? 0 : batches_.back().first_point + batches_.back().point_count;
    for (uint32_t k = 0; k < kLanes; ++k) {
        batch_pairs_.push_back(k < count ? pairs[k] : kNoPair);
        if (k >= count) continue;
        const Contacts& pair = pairs_[pairs[k]];
        batch.body_a[k] = pair.a, batch.body_b[k] = pair.b;
        batch.point_count = std::max(batch.point_count, pair.count);
    }
    batches_.push_back(batch);
}

namespace {

// Softness 1/m + 1/m + arm . I^-1 arm of both. `there` is 1 where there is a contact.
void set_row(Row& row, const LaneVec& arm_a, const LaneVec& arm_b, const LaneVec& turn_a, const LaneVec& turn_b,
             Lanes straight, Lanes there) {
    row.arm_a = arm_a, row.arm_b = arm_b, row.turn_a = turn_a, row.turn_b = turn_b;
    const Lanes softness = there * (straight + dot(arm_a, turn_a) + dot(arm_b, turn_b));
    row.softness = softness;
    row.mass = softness > 0 ? 1 / softness : Lanes{};
}

}  // namespace

void ContactSolver::set_up_point(PointRows& p, RollRows* r, SiblingRows* s, const Contacts* const (&of)[kLanes],
                                 uint32_t k, const Source& a, const Source& b, float dt) {
    float point_a[3][kLanes] = {}, point_b[3][kLanes] = {}, n[3][kLanes] = {}, t[2][3][kLanes] = {};
    float distance[kLanes] = {}, bounce[kLanes] = {}, friction[kLanes] = {}, impulse[3][kLanes] = {}, is[kLanes] = {};
    float struck[kLanes] = {}, rolling[kLanes] = {}, grip[kLanes] = {}, most_push[kLanes] = {}, siblings[kLanes] = {};
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
        if (!of[lane] || k >= of[lane]->count) continue;
        btManifoldPoint& from = *points_[of[lane]->first + k];
        btPlaneSpace1(from.m_normalWorldOnB, from.m_lateralFrictionDir1, from.m_lateralFrictionDir2);
        for (int axis = 0; axis < 3; ++axis) {
            point_a[axis][lane] = from.m_positionWorldOnA[axis], point_b[axis][lane] = from.m_positionWorldOnB[axis];
            n[axis][lane] = from.m_normalWorldOnB[axis];
            t[0][axis][lane] = from.m_lateralFrictionDir1[axis], t[1][axis][lane] = from.m_lateralFrictionDir2[axis];
        }
        is[lane] = 1;
        distance[lane] = from.m_distance1, bounce[lane] = from.m_combinedRestitution;
        friction[lane] = from.m_combinedFriction;
        impulse[0][lane] = kWarm * from.m_appliedImpulse;
        impulse[1][lane] = kWarm * from.m_appliedImpulseLateral1;
        impulse[2][lane] = kWarm * from.m_appliedImpulseLateral2;
        struck[lane] = of[lane]->scale * kStruckDepth;
        rolling[lane] = from.m_combinedRollingFriction;
        grip[lane] = of[lane]->grip, most_push[lane] = of[lane]->most_push;
        siblings[lane] = of[lane]->are_siblings;
        if (grip[lane] > 0) distance[lane] = bounce[lane] = 0;
        if (of[lane]->are_siblings) bounce[lane] = 0;
    }
    const auto vector = [](const float(&from)[3][kLanes]) {
        return LaneVec{load(from[0]), load(from[1]), load(from[2])};
    };
    const Lanes there = load(is), straight = a.inverse_mass + b.inverse_mass, per_second = there / dt;
    const LaneVec from_a = vector(point_a) - a.centre, from_b = vector(point_b) - b.centre;
    p.normal = vector(n), p.across[0] = vector(t[0]), p.across[1] = vector(t[1]);
    const auto set = [&](Row& row, const LaneVec& along) {
        const LaneVec arm_a = cross(from_a, along), arm_b = cross(from_b, along);
        set_row(row, arm_a, arm_b, a.turned_by(arm_a), b.turned_by(arm_b), straight, there);
        return dot(along, a.velocity - b.velocity) + (dot(arm_a, a.spin) - dot(arm_b, b.spin));
    };
    const auto forced = [&](const LaneVec& along) { return dot(along, a.force_speed - b.force_speed); };
    const Lanes apart = load(distance), opening = set(p.hold, p.normal);
    const Lanes a_step_ago = apart - opening * dt;
    const Lanes back =
        ((opening < -kRestitutionSpeed) & (a_step_ago > -load(struck))) ? -load(bounce) * opening : Lanes{};
    // What is still apart may close that far.
    p.hold.wanted = there * (back - opening - forced(p.normal)) - per_second * most(apart, Lanes{});
    p.push_wanted = per_second * least(kPushed * most(-apart, Lanes{}), load(most_push));
    p.pushed = Lanes{};
    p.hold.impulse = load(impulse[0]);
    for (int way = 0; way < 2; ++way) {
        const Lanes sliding = set(p.slide[way], p.across[way]);
        p.slide[way].wanted = there * (Lanes{} - sliding - forced(p.across[way]));
        p.slide[way].impulse = load(impulse[1 + way]);
    }
    p.friction = load(friction);
    p.grip = load(grip);
    const LaneVec* const axes[] = {&p.normal, &p.across[0], &p.across[1]};
    if (s) {
        s->are = load(siblings);
        for (int way = 0; way < 3; ++way)
            s->flight[way] = dot(*axes[way], a.velocity - b.velocity) + forced(*axes[way]);
        const auto mass = [&](const LaneVec& arm, const LaneVec& turn) {
            const Lanes softness = s->are * dot(arm, turn);
            return softness > kLeastTurning * p.hold.softness ? 1 / softness : Lanes{};
        };
        s->opening_a = dot(p.hold.arm_a, a.spin), s->opening_b = -dot(p.hold.arm_b, b.spin);
        s->paid_a = s->paid_b = Lanes{};
        s->mass_a = mass(p.hold.arm_a, p.hold.turn_a), s->mass_b = mass(p.hold.arm_b, p.hold.turn_b);
    }
    if (!r) return;
    for (int way = 0; way < 3; ++way) {
        const LaneVec& axis = *axes[way];
        set_row(r->roll[way], axis, axis, a.turned_by(axis), b.turned_by(axis), Lanes{}, there);
        r->roll[way].wanted = dot(axis, b.spin - a.spin);
        r->roll[way].impulse = Lanes{};
    }
    r->limit = load(rolling);
}

void ContactSolver::set_up(Batch& batch, const uint32_t* pairs, float dt, float pace) {
    const Contacts* of[kLanes] = {};
    float scale = 1;
    for (uint32_t k = 0; k < kLanes; ++k) {
        if (pairs[k] == kNoPair) continue;
        of[k] = &pairs_[pairs[k]];
        scale = std::min(scale, of[k]->scale);
        batch.grips |= of[k]->grip > 0;
        batch.siblings |= of[k]->are_siblings;
        batch.rolls |= points_[of[k]->first]->m_combinedRollingFriction > 0;
    }
    batch.weight = 1 / (scale * scale * pace * pace);
    const Source a(bodies_, batch.body_a, dt), b(bodies_, batch.body_b, dt);
    for (uint32_t k = 0; k < batch.point_count; ++k) {
        PointRows& p = rows_[batch.first_point + k];
        set_up_point(p, batch.rolls ? &rolls_[batch.first_point + k] : nullptr,
                     batch.siblings ? &siblings_[batch.first_point + k] : nullptr, of, k, a, b, dt);
        for (uint32_t lane = 0; lane < kLanes; ++lane) batch.pushes |= p.push_wanted[lane] > 0;
    }
}

void ContactSolver::solve(float dt, float pace, Scratches& scratches) {
    if (bodies_.size() == 1) return;
    changes_.assign(bodies_.size(), {});
    for (size_t k = 1; k < bodies_.size(); ++k)
        changes_[k].velocity[3] = changes_[k].push[3] = static_cast<float>(bodies_[k]->getInvMass());
    group_islands(dt);
    colour_pairs();
    fill_batches();
    const size_t rows = batches_.empty() ? 0 : batches_.back().first_point + batches_.back().point_count;
    if (rows_.size() < rows) rows_.resize(rows), rolls_.resize(rows), siblings_.resize(rows);
    const auto count = static_cast<uint32_t>(batches_.size());
    scratches.run((count + kBatchesAJob - 1) / kBatchesAJob, [&](uint32_t job, PairScratch&) {
        for (uint32_t k = job * kBatchesAJob; k < std::min(count, (job + 1) * kBatchesAJob); ++k)
            set_up(batches_[k], &batch_pairs_[k * kLanes], dt, pace);
    });
    scratches.run(static_cast<uint32_t>(groups_.size()), [&](uint32_t job, PairScratch&) { iterate(groups_[job]); });
    write_points();
    write_bodies(dt);
}

int ContactSolver::iterations_of(const Group& group) const {
    const int iterations =
        std::clamp(kContactTurns / std::max(static_cast<int>(points_.size()), 1), kLeastIterations, kMostIterations);
    if (!group.is_laden) return iterations;
    int points = 0;
    for (const Contacts& pair : pairs_) points += pair.is_laden ? static_cast<int>(pair.count) : 0;
    return std::clamp(kLadenTurns / std::max(points, 1), iterations, kMostLadenIterations);
}

void ContactSolver::iterate(const Group& group) {
    const int iterations = iterations_of(group);
    const float settled = group.is_laden ? kLadenSettledSquare : kSettledSquare;
    const std::span<const Batch> batches(batches_.data() + group.first, group.end - group.first);
    float changed = settled + 1;
    for (int k = 0; k < iterations && changed > settled; ++k) {
        changed = 0;
        for (const Batch& batch : batches)
            if (batch.pushes) changed = std::max(changed, push_batch(batch, rows_.data(), changes_.data()));
    }
    // Impulses that are handed on change the bodies after the pushes have been found: these do not see velocities.
    for (const Batch& batch : batches) start_batch(batch, rows_.data(), changes_.data());
    changed = settled + 1;
    for (int k = 0; k < iterations && changed > settled; ++k) {
        changed = 0;
        for (const Batch& batch : batches)
            changed =
                std::max(changed, solve_batch(batch, rows_.data(), rolls_.data(), siblings_.data(), changes_.data()));
    }
}

void ContactSolver::write_points() const {
    for (size_t k = 0; k < batches_.size(); ++k)
        for (uint32_t lane = 0; lane < kLanes; ++lane) {
            const uint32_t pair = batch_pairs_[k * kLanes + lane];
            if (pair == kNoPair) continue;
            for (uint32_t j = 0; j < pairs_[pair].count; ++j) {
                btManifoldPoint& to = *points_[pairs_[pair].first + j];
                const PointRows& p = rows_[batches_[k].first_point + j];
                to.m_appliedImpulse = p.hold.impulse[lane];
                to.m_appliedImpulseLateral1 = p.slide[0].impulse[lane];
                to.m_appliedImpulseLateral2 = p.slide[1].impulse[lane];
            }
        }
}

void ContactSolver::write_bodies(float dt) {
    const auto vector = [](const float(&from)[4]) { return btVector3(from[0], from[1], from[2]); };
    for (size_t k = 1; k < bodies_.size(); ++k) {
        btRigidBody& body = *bodies_[k];
        if (!(body.getInvMass() > 0)) continue;
        const SolverBody& change = changes_[k];
        body.setLinearVelocity(body.getLinearVelocity() + vector(change.velocity) +
                               body.getTotalForce() * body.getInvMass() * dt);
        body.setAngularVelocity(body.getAngularVelocity() + vector(change.spin));
        const btVector3 push = vector(change.push), turn = vector(change.turn);
        if (push.isZero() && turn.isZero()) continue;
        btTransform out;
        btTransformUtil::integrateTransform(body.getWorldTransform(), push, kTurnedOut * turn, dt, out);
        body.setWorldTransform(out);
    }
}

}  // namespace cullet::bullet
