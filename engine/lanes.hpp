// Four floats side by side, and vectors of them: one lane is one of four things that have nothing to do with each
// other. The compiler's own vector types: the same operations in the same order on every machine.
#pragma once
#include <immintrin.h>

#include <cstdint>
#include <cstring>

#include "engine/math.hpp"

/// Lanes that go through memory from one function to the next cost more than what is done with them.
#define CULLET_LANES_INLINE [[gnu::always_inline]] inline

namespace cullet::lanes {

inline constexpr uint32_t kLanes = 4;
typedef float Lanes __attribute__((vector_size(16)));

CULLET_LANES_INLINE Lanes load(const float* from) {
    Lanes out;
    std::memcpy(&out, from, sizeof out);
    return out;
}
CULLET_LANES_INLINE void store(Lanes lanes, float* to) {
    std::memcpy(to, &lanes, sizeof lanes);
}
CULLET_LANES_INLINE Lanes least(Lanes a, Lanes b) {
    return _mm_min_ps(a, b);
}
CULLET_LANES_INLINE Lanes most(Lanes a, Lanes b) {
    return _mm_max_ps(a, b);
}
CULLET_LANES_INLINE Lanes root(Lanes a) {
    return _mm_sqrt_ps(a);
}
typedef int LaneMask __attribute__((vector_size(16)));  // of a comparison: all bits of a lane, or none
CULLET_LANES_INLINE bool is_any(LaneMask mask) {
    return _mm_movemask_ps(reinterpret_cast<__m128>(mask)) != 0;
}

struct LaneVec {
    Lanes x{}, y{}, z{};
};
CULLET_LANES_INLINE LaneVec operator+(const LaneVec& a, const LaneVec& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
CULLET_LANES_INLINE LaneVec operator-(const LaneVec& a, const LaneVec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
CULLET_LANES_INLINE LaneVec operator*(Lanes s, const LaneVec& a) {
    return {s * a.x, s * a.y, s * a.z};
}
CULLET_LANES_INLINE Lanes dot(const LaneVec& a, const LaneVec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
CULLET_LANES_INLINE LaneVec cross(const LaneVec& a, const LaneVec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The next four of vectors that stand one after another.
CULLET_LANES_INLINE LaneVec load(const Vec3* from) {
    static_assert(sizeof(Vec3) == 3 * sizeof(float));
    const float* const at = &from->x;
    const Lanes a = load(at), b = load(at + 4), c = load(at + 8);  // x0 y0 z0 x1, y1 z1 x2 y2, z2 x3 y3 z3
    const Lanes xy = __builtin_shufflevector(b, c, 2, 3, 5, 6), yz = __builtin_shufflevector(a, b, 1, 2, 4, 5);
    return {__builtin_shufflevector(a, xy, 0, 3, 4, 6), __builtin_shufflevector(yz, xy, 0, 2, 5, 7),
            __builtin_shufflevector(yz, c, 1, 3, 4, 7)};
}

/// Four rows of four floats become columns.
CULLET_LANES_INLINE void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
    const Lanes ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5), ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Lanes cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5), cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

}  // namespace cullet::lanes
