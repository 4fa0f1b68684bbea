// The contact of the published method: a spring in the depth of the overlap, softer on the way out than on the way in
// (metal shell note, stage C). Its law in the distance, K / d, has no range and no place of rest; this one is linear.
#pragma once
#include <cstdint>

namespace cullet {

struct PenaltyContact {
    double mass = 1;          // effective, of both bodies along the normal, kg
    double speed = 1;         // m/s, at the first touch
    double depth = 1e-3;      // m, that the approach comes to
    double recede = 0.04;     // eps: stiffness on the way out over that on the way in; the square of the restitution
    uint32_t steps = 40;      // in the time of the approach and as long again
    bool splits_turn = true;  // the step in which it turns is taken in two, one with each stiffness
};
struct PenaltyOutcome {
    double rebound = 0;  // m/s
    double impulse = 0;  // N s
    double seconds = 0;
    double deepest = 0;  // m
};
PenaltyOutcome press(const PenaltyContact& contact);

}  // namespace cullet
