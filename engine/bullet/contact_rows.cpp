#include "engine/bullet/contact_rows.hpp"

namespace cullet::bullet {
namespace {

// Four bodies of a batch in registers, between gathering and scattering.
struct Four {
    LaneVec velocity, spin;
    Lanes inverse_mass;
};

template <float (SolverBody::*Velocity)[4], float (SolverBody::*Spin)[4]>
CULLET_LANES_INLINE Four gather(const SolverBody* bodies, const uint32_t (&number)[kLanes]) {
    const SolverBody &p = bodies[number[0]], &q = bodies[number[1]], &r = bodies[number[2]], &s = bodies[number[3]];
    Lanes a = load(p.*Velocity), b = load(q.*Velocity), c = load(r.*Velocity), d = load(s.*Velocity);
    transpose(a, b, c, d);
    Lanes e = load(p.*Spin), f = load(q.*Spin), g = load(r.*Spin), h = load(s.*Spin);
    transpose(e, f, g, h);
    return {{a, b, c}, {e, f, g}, d};
}

// What stands or is driven stays as it is, even where a pair is not finite.
template <float (SolverBody::*Velocity)[4], float (SolverBody::*Spin)[4]>
CULLET_LANES_INLINE void scatter(const Four& four, SolverBody* bodies, const uint32_t (&number)[kLanes]) {
    Lanes v[4] = {four.velocity.x, four.velocity.y, four.velocity.z, four.inverse_mass};
    transpose(v[0], v[1], v[2], v[3]);
    Lanes w[4] = {four.spin.x, four.spin.y, four.spin.z, Lanes{}};
    transpose(w[0], w[1], w[2], w[3]);
    for (uint32_t k = 0; k < kLanes; ++k) {
        if (!(v[k][3] > 0)) continue;  // its inverse mass
        store(v[k], bodies[number[k]].*Velocity);
        store(w[k], bodies[number[k]].*Spin);
    }
}

CULLET_LANES_INLINE void give(const Row& row, const LaneVec& along, Lanes impulse, Four& a, Four& b) {
    a.velocity = a.velocity + (impulse * a.inverse_mass) * along;
    b.velocity = b.velocity - (impulse * b.inverse_mass) * along;
    a.spin = a.spin + impulse * row.turn_a;
    b.spin = b.spin - impulse * row.turn_b;
}

CULLET_LANES_INLINE void give_turn(const Row& row, Lanes impulse, Four& a, Four& b) {
    a.spin = a.spin + impulse * row.turn_a;
    b.spin = b.spin - impulse * row.turn_b;
}

CULLET_LANES_INLINE Lanes speed(const Row& row, const LaneVec& along, const Four& a, const Four& b) {
    return dot(along, a.velocity - b.velocity) + (dot(row.arm_a, a.spin) - dot(row.arm_b, b.spin));
}

// The impulse that takes the row to its wanted speed, bounded in sum. Notes how much that changes the speed.
CULLET_LANES_INLINE Lanes bounded(const Row& row, Lanes wanted, Lanes now, Lanes low, Lanes high, Lanes& sum,
                                  Lanes& changed) {
    const Lanes before = sum;
    sum = least(most(before + row.mass * (wanted - now), low), high);
    const Lanes impulse = sum - before, change = impulse * row.softness;
    changed = most(changed, change * change);
    return impulse;
}

float largest(Lanes lanes) {
    float out = lanes[0];
    for (uint32_t k = 1; k < kLanes; ++k)
        if (!(lanes[k] <= out)) out = lanes[k];
    return out;
}

constexpr Lanes kNone{}, kOne{1, 1, 1, 1}, kAny{1e10f, 1e10f, 1e10f, 1e10f};

// Impulses of both ways across, N s.
struct Sliding {
    Lanes way[2];
    Lanes squared() const { return way[0] * way[0] + way[1] * way[1]; }
};

// What stops the sliding, or as much against it as `limit` lets. Bounds of either way by itself would turn what slides
// towards an axis, and so would masses of their own: of what slides on, both are the lesser. (Siblings are bounded by
// their flight afterwards, way by way.)
CULLET_LANES_INLINE Sliding against_sliding(const PointRows& p, Lanes limit, const Four& a, const Four& b) {
    const Row &row_0 = p.slide[0], &row_1 = p.slide[1];
    const Lanes missing_0 = row_0.wanted - speed(row_0, p.across[0], a, b),
                missing_1 = row_1.wanted - speed(row_1, p.across[1], a, b);
    const Lanes mass = least(row_0.mass, row_1.mass), most_squared = limit * limit;
    Sliding to{row_0.impulse + row_0.mass * missing_0, row_1.impulse + row_1.mass * missing_1};
    const auto goes_on = to.squared() > most_squared;
    if (!is_any(goes_on)) return to;  // a root and a quotient less where everything sticks, as in most of a heap
    to.way[0] = goes_on ? row_0.impulse + mass * missing_0 : to.way[0];
    to.way[1] = goes_on ? row_1.impulse + mass * missing_1 : to.way[1];
    const Lanes squared = to.squared();
    const Lanes share = squared > most_squared ? limit / root(squared) : kOne;
    return {share * to.way[0], share * to.way[1]};
}

// Makes the row's impulse what is said. Notes how much that changes its speed.
CULLET_LANES_INLINE void change(Row& row, const LaneVec& along, Lanes to, Four& a, Four& b, Lanes& changed) {
    const Lanes impulse = to - row.impulse, speed = impulse * row.softness;
    row.impulse = to;
    changed = most(changed, speed * speed);
    give(row, along, impulse, a, b);
}

// So that an impulse of siblings leaves no more of their flight along `along` than there is, nor turns it round.
CULLET_LANES_INLINE void bound_by_flight(const Row& row, Lanes are, Lanes flight, const LaneVec& along, const Four& a,
                                         const Four& b, Lanes& low, Lanes& high) {
    const Lanes now = flight + dot(along, a.velocity - b.velocity);
    const Lanes stopping = row.impulse - now / (a.inverse_mass + b.inverse_mass);
    const Lanes lowest = least(stopping, row.impulse), highest = most(stopping, row.impulse);
    low = are > 0 ? least(most(low, lowest), high) : low;
    high = are > 0 ? most(least(high, highest), low) : high;
}

// What siblings still approach by is taken from the spins that close the gap, by their shares in it. A spin that was
// turned round by that gets it back.
CULLET_LANES_INLINE void slow_spins(const PointRows& p, SiblingRows& s, Four& a, Four& b, Lanes& changed) {
    const Row& row = p.hold;
    const Lanes missing = s.are * (row.wanted - speed(row, p.normal, a, b));
    const Lanes opening_a = s.opening_a + dot(row.arm_a, a.spin), opening_b = s.opening_b - dot(row.arm_b, b.spin);
    const Lanes from_a = missing > 0 ? most(-opening_a, kNone) : least(s.paid_a, most(opening_a, kNone)),
                from_b = missing > 0 ? most(-opening_b, kNone) : least(s.paid_b, most(opening_b, kNone)),
                from_both = from_a + from_b;
    const Lanes amount = missing > 0 ? least(missing, from_both) : most(missing, -from_both);
    const Lanes share = from_both > 0 ? amount / from_both : kNone;
    s.paid_a = s.paid_a + share * from_a, s.paid_b = s.paid_b + share * from_b;
    a.spin = a.spin + (share * from_a * s.mass_a) * row.turn_a;
    b.spin = b.spin - (share * from_b * s.mass_b) * row.turn_b;
    changed = most(changed, amount * amount);
}

// Grips and siblings are rare: rows without them are solved as if there were none.
template <bool Grips, bool Siblings>
float solve_rows(const Batch& batch, PointRows* points, RollRows* rolls, SiblingRows* siblings, SolverBody* bodies) {
    Four a = gather<&SolverBody::velocity, &SolverBody::spin>(bodies, batch.body_a);
    Four b = gather<&SolverBody::velocity, &SolverBody::spin>(bodies, batch.body_b);
    Lanes changed{};
    const uint32_t end = batch.first_point + batch.point_count;
    for (uint32_t k = batch.first_point; k < end; ++k) {
        PointRows& p = points[k];
        Lanes low = Grips ? -p.grip : kNone, high = kAny;
        const Lanes now = speed(p.hold, p.normal, a, b);
        if (Siblings) bound_by_flight(p.hold, siblings[k].are, siblings[k].flight[0], p.normal, a, b, low, high);
        give(p.hold, p.normal, bounded(p.hold, p.hold.wanted, now, low, high, p.hold.impulse, changed), a, b);
        if (Siblings) slow_spins(p, siblings[k], a, b, changed);
    }
    for (uint32_t k = batch.first_point; k < end; ++k) {
        PointRows& p = points[k];
        const Lanes pressed = p.friction * (Grips ? most(p.hold.impulse, kNone) : p.hold.impulse),
                    limit = Grips ? pressed + p.grip : pressed;
        Sliding to = against_sliding(p, limit, a, b);
        for (int way = 0; way < 2; ++way) {
            Row& row = p.slide[way];
            if (Siblings) {
                Lanes low = -limit, high = limit;
                bound_by_flight(row, siblings[k].are, siblings[k].flight[1 + way], p.across[way], a, b, low, high);
                to.way[way] = least(most(to.way[way], low), high);
            }
            change(row, p.across[way], to.way[way], a, b, changed);
        }
    }
    for (uint32_t k = batch.first_point; batch.rolls && k < end; ++k) {
        const Lanes pressed = Grips ? most(points[k].hold.impulse, kNone) : points[k].hold.impulse,
                    limit = rolls[k].limit * pressed;
        for (Row& row : rolls[k].roll) {
            const Lanes now = dot(row.arm_a, a.spin) - dot(row.arm_b, b.spin);
            give_turn(row, bounded(row, row.wanted, now, -limit, limit, row.impulse, changed), a, b);
        }
    }
    scatter<&SolverBody::velocity, &SolverBody::spin>(a, bodies, batch.body_a);
    scatter<&SolverBody::velocity, &SolverBody::spin>(b, bodies, batch.body_b);
    return batch.weight * largest(changed);
}

}  // namespace

float solve_batch(const Batch& batch, PointRows* points, RollRows* rolls, SiblingRows* siblings, SolverBody* bodies) {
    const auto solve = batch.siblings ? batch.grips ? solve_rows<true, true> : solve_rows<false, true>
                       : batch.grips ? solve_rows<true, false>
                                      : solve_rows<false, false>;
    return solve(batch, points, rolls, siblings, bodies);
}

float push_batch(const Batch& batch, PointRows* points, SolverBody* bodies) {
    Four a = gather<&SolverBody::push, &SolverBody::turn>(bodies, batch.body_a);
    Four b = gather<&SolverBody::push, &SolverBody::turn>(bodies, batch.body_b);
    Lanes changed{};
    for (uint32_t k = batch.first_point; k < batch.first_point + batch.point_count; ++k) {
        PointRows& p = points[k];
        // What does not overlap takes no part.
        const Lanes high = p.push_wanted > 0 ? kAny : kNone;
        const Lanes now = speed(p.hold, p.normal, a, b);
        give(p.hold, p.normal, bounded(p.hold, p.push_wanted, now, kNone, high, p.pushed, changed), a, b);
    }
    scatter<&SolverBody::push, &SolverBody::turn>(a, bodies, batch.body_a);
    scatter<&SolverBody::push, &SolverBody::turn>(b, bodies, batch.body_b);
    return batch.weight * largest(changed);
}

void start_batch(const Batch& batch, const PointRows* points, SolverBody* bodies) {
    Four a = gather<&SolverBody::velocity, &SolverBody::spin>(bodies, batch.body_a);
    Four b = gather<&SolverBody::velocity, &SolverBody::spin>(bodies, batch.body_b);
    for (uint32_t k = batch.first_point; k < batch.first_point + batch.point_count; ++k) {
        const PointRows& p = points[k];
        give(p.hold, p.normal, p.hold.impulse, a, b);
        for (int way = 0; way < 2; ++way) give(p.slide[way], p.across[way], p.slide[way].impulse, a, b);
    }
    scatter<&SolverBody::velocity, &SolverBody::spin>(a, bodies, batch.body_a);
    scatter<&SolverBody::velocity, &SolverBody::spin>(b, bodies, batch.body_b);
}

}  // namespace cullet::bullet
