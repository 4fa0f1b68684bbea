// Rows of contacts, four pairs of bodies at a time: what sequential impulses read and write in every iteration, packed
// into lanes.
//
// A row is one direction in which two bodies are held: along the normal, along two directions across it, and about all
// three where contacts roll. Its impulse J changes velocities by J along / m and spins by J turn, turn = I^-1 arm, arm
// = r x along; its speed is along . (v_a - v_b) + arm_a . w_a - arm_b . w_b.
#pragma once
#include <cstdint>

#include "engine/lanes.hpp"

namespace cullet::bullet {

using namespace lanes;

/// What impulses have changed of a body in this step so far. The one at 0 is everything that stands.
/// A cache line, so that threads that solve others do not wait for it.
struct alignas(64) SolverBody {
    float velocity[4] = {};  // m/s; [3] is the inverse mass, 1/kg
    float spin[4] = {};      // rad/s
    float push[4] = {};      // m/s that take the body out of overlaps, in this step alone; [3] as above
    float turn[4] = {};      // rad/s likewise
};

/// An impulse's bound and sum, in one direction.
struct Row {
    LaneVec arm_a, arm_b, turn_a, turn_b;
    Lanes softness{};  // 1/kg: m/s of the row's speed that an impulse of 1 N s makes; 0 where there is no contact
    Lanes mass{};      // 1 / softness, or 0
    Lanes wanted{};    // m/s of speed to gain
    Lanes impulse{};   // N s so far
};

/// One contact point of each of four pairs.
struct PointRows {
    LaneVec normal, across[2];
    Row hold, slide[2];
    Lanes friction{};
    Lanes grip{};                   // N s that hold against parting and sliding, beside what presses
    Lanes push_wanted{}, pushed{};  // m/s, N s: split impulse (no velocity comes of it)
};

/// Rolling and spinning friction of the same point: `along` is none, arms are the axes.
struct RollRows {
    Row roll[3];
    Lanes limit{};  // m: the most torque impulse, of a contact impulse of 1 N s
};

/// The same point of siblings, which must not throw each other: between them impulses of its rows only take away from
/// the speed at which the two fly beside each other. Where that does not stop an approach, the spins that bring it
/// about are slowed down, each for itself. Momentum is kept and energy falls; angular momentum goes with the spins.
struct SiblingRows {
    Lanes are{};                     // 1 for siblings, 0 for others
    Lanes flight[3]{};               // m/s of the centres, along the normal and both ways across,
    Lanes opening_a{}, opening_b{};  // and of either spin along the normal, all without this step's impulses
    Lanes mass_a{}, mass_b{};        // kg: of either spin alone
    Lanes paid_a{}, paid_b{};        // m/s that either spin has given up
};

/// Four pairs, no free body in two of them, with their points one behind the other.
struct Batch {
    uint32_t body_a[kLanes] = {}, body_b[kLanes] = {};
    uint32_t first_point = 0, point_count = 0;                            // of PointRows
    float weight = 1;                                                     // of its squared changes of speed
    bool rolls = false, pushes = false, grips = false, siblings = false;  // any of them
};

/// One iteration over a batch. What comes back is the largest change of a row's speed, squared,
/// times the weight of the batch.
float solve_batch(const Batch& batch, PointRows* points, RollRows* rolls, SiblingRows* siblings, SolverBody* bodies);
/// The same for the push out of overlaps.
float push_batch(const Batch& batch, PointRows* points, SolverBody* bodies);
/// Gives the bodies the impulses that the rows begin with.
void start_batch(const Batch& batch, const PointRows* points, SolverBody* bodies);

}  // namespace cullet::bullet
