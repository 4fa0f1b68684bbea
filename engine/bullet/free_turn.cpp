#include "engine/bullet/free_turn.hpp"

#include <algorithm>
#include <cmath>

#include "engine/bullet/bullet_types.hpp"

namespace cullet::bullet {
namespace {

// Runge and Kutta's fourth order errs by (w h)^5 / 120 a substep: 2e-5 of the spin.
constexpr float kTurn = 0.3f;  // rad a substep
// What turns faster than 1,200 rad/s at 60 steps a second keeps its axis.
constexpr float kMostSubsteps = 64;

Vec3 turning(Vec3 inverse, Vec3 moment, Vec3 w) {
    const Vec3 torque = cross({moment.x * w.x, moment.y * w.y, moment.z * w.z}, w);
    return {inverse.x * torque.x, inverse.y * torque.y, inverse.z * torque.z};
}

float energy(Vec3 moment, Vec3 w) {
    return moment.x * w.x * w.x + moment.y * w.y * w.y + moment.z * w.z * w.z;
}

}  // namespace

void turn_freely(btRigidBody& body, float dt) {
    const Vec3 inverse = from_bullet(body.getInvInertiaDiagLocal());
    if (!(inverse.x > 0 && inverse.y > 0 && inverse.z > 0)) return;
    const Vec3 moment{1 / inverse.x, 1 / inverse.y, 1 / inverse.z};
    const btMatrix3x3& axes = body.getWorldTransform().getBasis();
    Vec3 w = from_bullet(body.getAngularVelocity() * axes);  // the row vector: the transpose times w
    const float substeps = std::ceil(length(w) * dt / kTurn);
    if (!(substeps >= 1 && substeps <= kMostSubsteps)) return;
    const float before = energy(moment, w), h = dt / substeps;
    for (float k = 0; k < substeps; ++k) {
        const Vec3 one = turning(inverse, moment, w), two = turning(inverse, moment, w + 0.5f * h * one),
                   three = turning(inverse, moment, w + 0.5f * h * two), four = turning(inverse, moment, w + h * three);
        w += h / 6 * (one + 2.0f * two + 2.0f * three + four);
    }
    const float after = energy(moment, w);
    if (!(after > 0)) return;
    body.setAngularVelocity(axes * to_bullet(std::sqrt(before / after) * w));
}

}  // namespace cullet::bullet
