// Between our plain values and Bullet's. Bullet's bodies have their origin at the centre of mass and their axes along
// the principal axes of inertia; BodyFrame says where these stand in the mesh frame.
#pragma once
#include <LinearMath/btTransform.h>

#include "engine/math.hpp"

namespace cullet::bullet {

inline btVector3 to_bullet(Vec3 a) {
    return {a.x, a.y, a.z};
}
inline Vec3 from_bullet(const btVector3& a) {
    return {a.x(), a.y(), a.z()};
}
inline btQuaternion to_bullet(Quat q) {
    return {q.x, q.y, q.z, q.w};
}
inline Quat from_bullet(const btQuaternion& q) {
    return {q.x(), q.y(), q.z(), q.w()};
}

/// Bullet frame -> mesh frame: mesh = rotate(axes, bullet) + centre.
struct BodyFrame {
    Vec3 centre;
    Quat axes;
};

inline btTransform to_bullet(const Pose& pose, const BodyFrame& frame) {
    const Quat q = normalised(pose.orientation);
    return btTransform(to_bullet(normalised(q * frame.axes)), to_bullet(rotate(q, frame.centre) + pose.position));
}

inline Pose from_bullet(const btTransform& transform, const BodyFrame& frame) {
    const Quat q = normalised(from_bullet(transform.getRotation()) * conjugate(frame.axes));
    return {from_bullet(transform.getOrigin()) - rotate(q, frame.centre), q};
}

}  // namespace cullet::bullet
