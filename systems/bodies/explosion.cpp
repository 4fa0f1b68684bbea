#include "systems/bodies/explosion.hpp"

#include <cmath>

namespace cullet {

// A ring at height z of the unit ball sees the centre under the cosine (D z - a) / r, r^2 = D^2 + a^2 - 2 D a z. It has
// the area 2 pi a^2 dz. Of its impulse the share z is along the axis.
double impulse_on_ball(double distance, double ball_radius, float reach, float strength) {
    constexpr int kRings = 32;
    double sum = 0;
    for (int ring = 0; ring < kRings; ++ring) {
        const double z = (ring + 0.5) / kRings;
        const double r = std::sqrt(distance * distance + ball_radius * ball_radius - 2 * distance * ball_radius * z);
        const double sees = distance * z - ball_radius;
        if (!(sees > 0) || !(r > 0) || r >= double{reach}) continue;
        const double left = 1 - r / double{reach};
        sum += left * left * (sees / r) * z;
    }
    return double{strength} * sum * 2 * 3.14159265358979 * ball_radius * ball_radius / kRings;
}

}  // namespace cullet
