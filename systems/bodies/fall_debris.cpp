#include <algorithm>

#include "systems/systems.hpp"

namespace cullet {
namespace {

constexpr float kLargeReach = 4;  // radii of the debris: what reaches less far is passed through, as other debris is
constexpr float kBounce = 0.2f;   // of the speed that they close with, above kBounceSpeed
constexpr float kBounceSpeed = 0.2f;  // m/s
constexpr float kFriction = 0.5f;
constexpr float kRestSpeed = 0.15f;   // m/s under g; where it is weaker, as much less as things fall slower
constexpr float kRestSlope = 0.7f;    // cosine: what it lies on is no steeper than 45 degrees
constexpr uint64_t kRestFrames = 16;  // what rests looks every so often whether it still lies on something

// As something of no mass: the body feels nothing of it, and what the debris gives is booked with the ground's. It is
// never sent off faster than it came, else a moving body would make energy.
Vec3 bounced(Vec3 velocity, const RigidTouch& touch) {
    const Vec3 relative = velocity - touch.velocity;
    const float closing = -dot(relative, touch.normal);
    if (!(closing > 0)) return velocity;
    const Vec3 sliding = relative + closing * touch.normal;
    const float bounce = closing > kBounceSpeed ? kBounce : 0.0f, slides = length(sliding);
    const float kept = slides > 0 ? std::max(0.0f, 1 - kFriction * (1 + bounce) * closing / slides) : 0.0f;
    const Vec3 after = touch.velocity + kept * sliding + (bounce * closing) * touch.normal;
    const float before_square = dot(velocity, velocity), square = dot(after, after);
    return square > before_square ? std::sqrt(before_square / square) * after : after;
}

struct Grain {
    Vec3 place, velocity;
    float radius;
    bool rests = false;
};

float rest_speed(Vec3 gravity) {
    constexpr float kEarth = 9.81f;  // m/s2
    return kRestSpeed * std::min(1.0f, std::sqrt(length(gravity) / kEarth));
}

// The way of a step, and of what is left of it along the surface that it meets; what it meets there stops it.
void fly(Grain& grain, const RigidWorld& rigid, Step step) {
    float left = step.dt;
    for (int turn = 0; turn < 2; ++turn) {
        const Vec3 to = grain.place + left * grain.velocity;
        RigidTouch touch;
        if (!rigid.first_touch(grain.place, to, left, grain.radius, kLargeReach * grain.radius, touch)) {
            grain.place = to;
            return;
        }
        grain.place = touch.place;
        grain.velocity = bounced(grain.velocity, touch);
        left *= 1 - touch.share;
        const float up = -dot(touch.normal, step.gravity);
        if (touch.is_still && length(grain.velocity) < rest_speed(step.gravity) &&
            up > kRestSlope * length(step.gravity)) {
            grain.rests = true;
            grain.velocity = {};
            return;
        }
    }
}

bool lies_on_something(Vec3 place, float radius, const RigidWorld& rigid, Step step) {
    const float probe = std::min(2e-3f, radius), pull = length(step.gravity);  // m, m/s2
    RigidTouch touch;
    return pull > 0 &&
           rigid.first_touch(place, place + (probe / pull) * step.gravity, 0, radius, kLargeReach * radius, touch);
}

}  // namespace

// Semi-implicit Euler under gravity.
void fall_debris(Serial, Step step, const RigidWorld& rigid, Debris& debris, DamageCounts& counts) {
    const bool meets_bodies = rigid.knows_surfaces();
    for (uint32_t d = 0; d < debris.size(); ++d) {
        if (!debris.is_used[d]) continue;
        if (debris.is_resting[d]) {
            if (!meets_bodies || (step.frame + d) % kRestFrames != 0) continue;
            if (lies_on_something(debris.position[d], debris.radius[d], rigid, step)) continue;
            debris.is_resting[d] = 0;
        }
        const Vec3 falling = debris.velocity[d] + step.dt * step.gravity;
        Grain grain{debris.position[d], falling, debris.radius[d]};
        if (meets_bodies)
            fly(grain, rigid, step);
        else
            grain.place = grain.place + step.dt * grain.velocity;
        if (grain.place.y <= debris.floor[d]) {
            grain.place.y = debris.floor[d];
            grain.velocity = {};
            grain.rests = true;
        }
        const Vec3d given = debris.mass[d] * (Vec3d(falling) - Vec3d(grain.velocity));
        counts.impulse_to_static[0] += given.x, counts.impulse_to_static[1] += given.y;
        counts.impulse_to_static[2] += given.z;
        debris.position.set(d, grain.place);
        debris.velocity.set(d, grain.velocity);
        debris.is_resting[d] = grain.rests;
    }
}

}  // namespace cullet
