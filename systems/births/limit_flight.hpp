// How fast pieces may leave a body that was hit.
#pragma once
#include "components/blows.hpp"
#include "components/body_rows.hpp"
#include "systems/births/part_motion.hpp"

namespace cullet {

/// Of one break, body axes. No piece but the largest leaves faster, relative to the body before the hit, than twice the
/// impact speed, nor does its rim turn faster (thick shell note 6.6). settle_momenta keeps to it by the centre of a
/// piece's vertices, and only as far as the hidden state's energy allows; here it is the solid's centre, which lies
/// elsewhere by some hundredths of its size. What the largest piece gets by that limit_energy keeps within bounds.
/// Debris is points and keeps to settle_momenta's limit, and so do pieces of an explosion, whose energy has no bound.
struct FlightLimit {
    double most_speed = 0;         // m/s; 0: no limit
    Vec3d centre, velocity, spin;  // of the body before the hit, m, m/s, rad/s
};

/// None where nothing struck: cuts, explosions.
FlightLimit flight_limit(const BodyRows& state, const Blows& blows, Row<Tasks> task);

/// Of a piece whose solid has this centre, body axes. Returns the momentum that was cut off, N s: it is another's.
Vec3d limit_flight(const FlightLimit& limit, Vec3d solid_centre, PartMotion& part);

}  // namespace cullet
