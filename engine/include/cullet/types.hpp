// The plain value types of the public face.
//
// Units are SI everywhere: metre, kilogram, second, newton, pascal, radian. Axes are right-handed with y up. Triangles
// are counter-clockwise seen from outside. A pose maps body coordinates to world coordinates.
#pragma once
#include <cstdint>

namespace cullet {

struct Vec2 {
    float x = 0, y = 0;
};

struct Vec3 {
    float x = 0, y = 0, z = 0;
};

/// Unit quaternion, w is the real part. The default is no rotation.
struct Quat {
    float x = 0, y = 0, z = 0, w = 1;
};

/// world = rotate(orientation, body) + position.
struct Pose {
    Vec3 position;     // m
    Quat orientation;  // unit
};

/// Velocity of the centre of mass, and rotation about it, in world axes.
struct Motion {
    Vec3 velocity;          // m/s
    Vec3 angular_velocity;  // rad/s
};

/// A model that was added to a world.
struct ModelId {
    uint32_t index = 0, generation = 0;
    explicit operator bool() const { return generation != 0; }
    friend bool operator==(const ModelId&, const ModelId&) = default;
};

}  // namespace cullet
