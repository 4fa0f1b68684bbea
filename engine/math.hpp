// Small vectors and matrices in float (state) and double (topology decisions, masses, momenta). Only correctly rounded
// operations: + - * / sqrt. Angles in state come from the polynomials at the end, never from libm.
#pragma once
#include <cmath>
#include <cstdint>

#include "cullet/types.hpp"

namespace cullet {

inline Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator-(Vec3 a) {
    return {-a.x, -a.y, -a.z};
}
inline Vec3 operator*(float s, Vec3 a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Vec3 operator*(Vec3 a, float s) {
    return s * a;
}
inline Vec3& operator+=(Vec3& a, Vec3 b) {
    return a = a + b;
}
inline Vec3& operator-=(Vec3& a, Vec3 b) {
    return a = a - b;
}
inline bool operator==(Vec3 a, Vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}
inline float dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3 a) {
    return std::sqrt(dot(a, a));
}
/// The zero vector stays zero.
inline Vec3 normalised(Vec3 a) {
    const float l = length(a);
    return l > 0 ? (1.0f / l) * a : Vec3{};
}

struct Vec3d {
    double x = 0, y = 0, z = 0;
    Vec3d() = default;
    Vec3d(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
    explicit Vec3d(Vec3 a) : x(a.x), y(a.y), z(a.z) {}
    Vec3 to_float() const { return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}; }
    double operator[](int k) const { return k == 0 ? x : k == 1 ? y : z; }
};
inline Vec3d operator+(Vec3d a, Vec3d b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3d operator-(Vec3d a, Vec3d b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3d operator-(Vec3d a) {
    return {-a.x, -a.y, -a.z};
}
inline Vec3d operator*(double s, Vec3d a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Vec3d& operator+=(Vec3d& a, Vec3d b) {
    return a = a + b;
}
inline Vec3d& operator-=(Vec3d& a, Vec3d b) {
    return a = a - b;
}
inline bool operator==(Vec3d a, Vec3d b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}
inline double dot(Vec3d a, Vec3d b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3d cross(Vec3d a, Vec3d b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3d a) {
    return std::sqrt(dot(a, a));
}
inline Vec3d normalised(Vec3d a) {
    const double l = length(a);
    return l > 0 ? (1.0 / l) * a : Vec3d{};
}

/// Symmetric 3 x 3 matrix: second moments, inertia, stiffness blocks.
struct Sym3d {
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};
inline Sym3d operator+(Sym3d a, Sym3d b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}
inline Sym3d operator-(Sym3d a, Sym3d b) {
    return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.xz - b.xz, a.yz - b.yz};
}
inline Sym3d operator*(double s, Sym3d a) {
    return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.xz, s * a.yz};
}
inline Vec3d operator*(Sym3d m, Vec3d v) {
    return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
            m.xz * v.x + m.yz * v.y + m.zz * v.z};
}
inline double trace(Sym3d m) {
    return m.xx + m.yy + m.zz;
}
inline double determinant(Sym3d m) {
    return m.xx * (m.yy * m.zz - m.yz * m.yz) - m.xy * (m.xy * m.zz - m.yz * m.xz) + m.xz * (m.xy * m.yz - m.yy * m.xz);
}
/// a a^T.
inline Sym3d outer(Vec3d a) {
    return {a.x * a.x, a.y * a.y, a.z * a.z, a.x * a.y, a.x * a.z, a.y * a.z};
}
/// Inertia tensor of a second moment C = sum m p p^T: tr(C) 1 - C.
inline Sym3d inertia_of(Sym3d c) {
    const double t = trace(c);
    return {t - c.xx, t - c.yy, t - c.zz, -c.xy, -c.xz, -c.yz};
}
/// Inverse by cofactors; a singular matrix gives zero, so a body of no extent does not spin.
inline Sym3d inverse(Sym3d m) {
    const double d = determinant(m);
    if (!(d > 0 || d < 0)) return {};
    const double s = 1.0 / d;
    return {s * (m.yy * m.zz - m.yz * m.yz), s * (m.xx * m.zz - m.xz * m.xz), s * (m.xx * m.yy - m.xy * m.xy),
            s * (m.xz * m.yz - m.xy * m.zz), s * (m.xy * m.yz - m.xz * m.yy), s * (m.xy * m.xz - m.xx * m.yz)};
}

/// 3 x 3 matrix by rows.
struct Mat3 {
    Vec3 row[3];
};
inline Vec3 operator*(const Mat3& m, Vec3 v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
inline Vec3 transposed_times(const Mat3& m, Vec3 v) {
    return v.x * m.row[0] + v.y * m.row[1] + v.z * m.row[2];
}

inline Quat operator*(Quat a, Quat b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
inline Quat conjugate(Quat q) {
    return {-q.x, -q.y, -q.z, q.w};
}
inline Quat normalised(Quat q) {
    const float l = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return l > 0 ? Quat{q.x / l, q.y / l, q.z / l, q.w / l} : Quat{};
}
inline Mat3 matrix(Quat q) {
    const float xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z,
                wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return {{{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)},
             {2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)},
             {2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)}}};
}
inline Vec3 rotate(Quat q, Vec3 v) {
    const Vec3 u{q.x, q.y, q.z};
    const Vec3 t = 2.0f * cross(u, v);
    return v + q.w * t + cross(u, t);
}
inline Vec3 to_world(const Pose& pose, Vec3 p) {
    return rotate(pose.orientation, p) + pose.position;
}
inline Vec3 to_body(const Pose& pose, Vec3 p) {
    return rotate(conjugate(pose.orientation), p - pose.position);
}

/// Sine and cosine of x in radians: reduced to [-pi/4, pi/4], Taylor to 1e-16, absolute error under 1e-13 for |x| <
/// 1e4. The same bits on every machine, which libm does not promise.
void sine_cosine(double x, double& sine, double& cosine);
/// Arc cosine of x in [-1, 1] (clamped), absolute error under 1e-12.
double arc_cosine(double x);
/// Natural logarithm of x > 0, relative error under 1e-14.
double logarithm(double x);
/// e^x for |x| < 700, relative error under 1e-14.
double exponential(double x);

}  // namespace cullet
