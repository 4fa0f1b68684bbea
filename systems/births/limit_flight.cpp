#include "systems/births/limit_flight.hpp"

#include <algorithm>

#include "systems/bodies/blows.hpp"

namespace cullet {

FlightLimit flight_limit(const BodyRows& state, const Blows& blows, Row<Tasks> task) {
    const Tasks& tasks = state.tasks;
    if (is_cut_task(blows, task) || has_explosion(blows, task)) return {};
    return {kMostRelativeSpeed * static_cast<double>(tasks.approach_speed[task]),
            Vec3d(state.bodies.centre[tasks.body[task]]), Vec3d(tasks.start_velocity[task]),
            Vec3d(tasks.start_spin[task])};
}

Vec3d limit_flight(const FlightLimit& limit, Vec3d solid_centre, PartMotion& part) {
    const double most = limit.most_speed;
    if (!(most > 0) || part.is_static || !(part.mass > 0)) return {};
    const double reach = part.radius + length(solid_centre - part.centre);
    const Vec3d turning = part.spin - limit.spin;
    // What broke off a body that spins fast may keep that spin, or lose it.
    if (std::min(length(turning), length(part.spin)) * reach > most) {
        const Vec3d kept = limit.spin + (most / (length(turning) * reach)) * turning;
        // The body's own spin may have been the livelier one; then slow down about the part's own axis.
        const bool is_livelier = dot(kept, part.inertia * kept) > dot(part.spin, part.inertia * part.spin);
        part.spin = is_livelier ? std::min(1.0, most / (length(part.spin) * reach)) * part.spin : kept;
        part.is_spin_clamped = true;
    }
    const Vec3d before = limit.velocity + cross(limit.spin, solid_centre - limit.centre);
    const Vec3d relative = part.velocity - before;
    const double speed = length(relative);
    if (!(speed > most)) return {};
    const Vec3d kept = before + (most / speed) * relative;
    const Vec3d cut = part.mass * (part.velocity - kept);
    part.velocity = kept;
    part.is_speed_clamped = true;
    return cut;
}

}  // namespace cullet
