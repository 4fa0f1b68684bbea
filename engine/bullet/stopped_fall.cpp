#include "engine/bullet/stopped_fall.hpp"

#include <algorithm>
#include <cmath>

#include "engine/bullet/bullet_types.hpp"

namespace cullet::bullet {

btVector3 velocity_of_stopped(const btVector3& velocity, const btVector3& gravity, float fraction, float dt,
                              Vec3 glance) {
    const double strength = static_cast<double>(gravity.length());
    if (!(strength > 0) || !(fraction < 1 || dot(glance, glance) > 0)) return velocity;
    const Vec3d down = (1 / strength) * Vec3d(from_bullet(gravity));
    const double fall = dot(down, Vec3d(from_bullet(velocity)));
    const double part = static_cast<double>(fraction), led = dot(down, Vec3d(glance));
    const double lost = static_cast<double>(dt) * ((1 - part) * fall - part * led);
    if (!(fall > 0) || !(lost > 0)) return velocity;
    const double kept = std::sqrt(std::max(0.0, fall * fall - 2 * strength * lost));
    return velocity - to_bullet(((fall - kept) * down).to_float());
}

}  // namespace cullet::bullet
