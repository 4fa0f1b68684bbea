// The maths of vectors and of one rigid body that any engine has.
#pragma once
#include <cmath>

#include "cullet/rigid.hpp"

namespace plain {

using cullet::Quat;
using cullet::Vec3;

inline Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator*(float s, Vec3 a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline float dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline float length(Vec3 a) {
    return std::sqrt(dot(a, a));
}
inline Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec3 rotate(Quat q, Vec3 v) {
    const Vec3 u{q.x, q.y, q.z}, t = 2 * cross(u, v);
    return v + q.w * t + cross(u, t);
}
inline Vec3 rotate_back(Quat q, Vec3 v) {
    return rotate({-q.x, -q.y, -q.z, q.w}, v);
}
/// q after `turn` radians about the world's axes, small.
inline Quat turned(Quat q, Vec3 turn) {
    const Vec3 h = 0.5f * turn;
    const Quat r{q.x + h.x * q.w + h.y * q.z - h.z * q.y, q.y + h.y * q.w + h.z * q.x - h.x * q.z,
                 q.z + h.z * q.w + h.x * q.y - h.y * q.x, q.w - h.x * q.x - h.y * q.y - h.z * q.z};
    const float l = std::sqrt(r.x * r.x + r.y * r.y + r.z * r.z + r.w * r.w);
    return {r.x / l, r.y / l, r.z / l, r.w / l};
}
/// Solves I x = b for a symmetric I = xx yy zz xy xz yz.
inline Vec3 solve(const double (&i)[6], Vec3 b) {
    const double cx = i[1] * i[2] - i[5] * i[5], cy = i[4] * i[5] - i[3] * i[2], cz = i[3] * i[5] - i[4] * i[1];
    const double s = 1 / (i[0] * cx + i[3] * cy + i[4] * cz);
    const double yy = i[0] * i[2] - i[4] * i[4], yz = i[3] * i[4] - i[0] * i[5], zz = i[0] * i[1] - i[3] * i[3];
    return {static_cast<float>(s * (cx * b.x + cy * b.y + cz * b.z)),
            static_cast<float>(s * (cy * b.x + yy * b.y + yz * b.z)),
            static_cast<float>(s * (cz * b.x + yz * b.y + zz * b.z))};
}

// ---- one body; its centre of mass stands off the origin of its frame

using cullet::HostShape;

inline Vec3 centre(const HostShape& s) {
    const Vec3 local{static_cast<float>(s.centre[0]), static_cast<float>(s.centre[1]), static_cast<float>(s.centre[2])};
    return s.pose.position + rotate(s.pose.orientation, local);
}
/// `arm` is from the centre of mass, in world axes.
inline Vec3 velocity(const HostShape& s, Vec3 arm) {
    return s.motion.velocity + cross(s.motion.angular_velocity, arm);
}
inline Vec3 spin_of(const HostShape& s, Vec3 turn) {
    return rotate(s.pose.orientation, solve(s.inertia, rotate_back(s.pose.orientation, turn)));
}
/// The mass that it sets against a push.
inline float effective_mass(const HostShape& s, Vec3 arm, Vec3 along) {
    return 1 / (1 / static_cast<float>(s.mass) + dot(along, cross(spin_of(s, cross(arm, along)), arm)));
}
inline void kick(HostShape& s, Vec3 arm, Vec3 impulse) {
    s.motion.velocity = s.motion.velocity + (1 / static_cast<float>(s.mass)) * impulse;
    s.motion.angular_velocity = s.motion.angular_velocity + spin_of(s, cross(arm, impulse));
}
inline void move(HostShape& s, float dt) {
    const Vec3 at = centre(s) + dt * s.motion.velocity;
    s.pose.orientation = turned(s.pose.orientation, dt * s.motion.angular_velocity);
    s.pose.position = s.pose.position + (at - centre(s));
    s.motion.angular_velocity = (1 - dt) * s.motion.angular_velocity;  // air
}

}  // namespace plain
