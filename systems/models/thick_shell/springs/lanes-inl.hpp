// 8 lanes on every machine, in registers of 8, 4 or 1 floats: loops over a pack go `for (lane = 0; lane < 8; lane +=
// kStep)`. Included once a target by the kernels, after foreach_target.h.
//
// Never MulAdd, never an approximate reciprocal: each lane's result has the same bits at every level.
#if defined(CULLET_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef CULLET_LANES_INL_HPP
#undef CULLET_LANES_INL_HPP
#else
#define CULLET_LANES_INL_HPP
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "components/shells.hpp"

HWY_BEFORE_NAMESPACE();
namespace cullet {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
using Floats = hn::CappedTag<float, 1>;
inline constexpr uint32_t kStep = 1;
#elif HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SSSE3 || HWY_TARGET == HWY_SSE4
using Floats = hn::CappedTag<float, 4>;
inline constexpr uint32_t kStep = 4;
#else
using Floats = hn::CappedTag<float, 8>;
inline constexpr uint32_t kStep = 8;
#endif
static_assert(hn::MaxLanes(Floats()) == kStep, "a level whose registers are of another size would leave lanes out");
using V = hn::Vec<Floats>;

/// Asks for the lines of a slot that is read later.
HWY_INLINE void prefetch(const void* slot, size_t bytes) {
    const char* p = static_cast<const char*>(slot);
    for (size_t i = 0; i < bytes; i += 64) hwy::Prefetch(p + i);
}

struct V3 {
    V x, y, z;
};

HWY_INLINE V3 operator-(V3 a, V3 b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
/// (a.x b.x + a.y b.y) + a.z b.z
HWY_INLINE V dot(V3 a, V3 b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE V3 scaled(V s, V3 a) {
    return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
HWY_INLINE V3 add(V3 a, V3 b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V3 load(const float* x, const float* y, const float* z) {
    const Floats d;
    return {hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z)};
}
HWY_INLINE void store(V3 a, float* x, float* y, float* z) {
    const Floats d;
    hn::StoreU(a.x, d, x);
    hn::StoreU(a.y, d, y);
    hn::StoreU(a.z, d, z);
}

using Indices = hn::RebindToUnsigned<Floats>;
/// Floats by their indices. g++ 12's gather intrinsic without a source merges into a stale register and waits for it; a
/// zeroed source does not.
HWY_INLINE V gather(const float* values, hn::Vec<Indices> index) {
#if HWY_TARGET <= HWY_AVX2
    const __m256 all = _mm256_castsi256_ps(_mm256_set1_epi32(-1));
    return V{_mm256_mask_i32gather_ps(_mm256_setzero_ps(), values, index.raw, all, 4)};
#else
    alignas(32) uint32_t row[kStep];
    alignas(32) float gathered[kStep];
    hn::Store(index, Indices(), row);
    for (uint32_t lane = 0; lane < kStep; ++lane) gathered[lane] = values[row[lane]];
    return hn::Load(Floats(), gathered);
#endif
}

#if HWY_TARGET == HWY_SCALAR

template <int kStride = 1>
HWY_INLINE V3 gather(const Float4* w, const uint32_t* index) {
    const Floats d;
    const Float4& p = w[index[0]];
    return {hn::Set(d, p.x), hn::Set(d, p.y), hn::Set(d, p.z)};
}
HWY_INLINE V3 load_points(const Float4* w) {
    const Floats d;
    return {hn::Set(d, w->x), hn::Set(d, w->y), hn::Set(d, w->z)};
}
HWY_INLINE void store_points(V3 a, Float4* w) {
    w->x = hn::GetLane(a.x), w->y = hn::GetLane(a.y), w->z = hn::GetLane(a.z), w->w = 0;
}
HWY_INLINE void subtract_points(V3 a, Float4* w, const uint32_t* index) {
    Float4& p = w[index[0]];
    p = {p.x - hn::GetLane(a.x), p.y - hn::GetLane(a.y), p.z - hn::GetLane(a.z), 0};
}

#else

/// Register r of the four that hold vertices r and, in the upper half, r + 4.
HWY_INLINE V load_pair(const Float4* low, const Float4* high) {
#if HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SSSE3 || HWY_TARGET == HWY_SSE4
    (void)high;
    return hn::Load(Floats(), &low->x);
#else
    const hn::Half<Floats> half;
    return hn::Combine(Floats(), hn::Load(half, &high->x), hn::Load(half, &low->x));
#endif
}
/// Rows of (x, y, z, .) to columns, inside 128-bit blocks.
HWY_INLINE V3 transpose(V r0, V r1, V r2, V r3) {
    const Floats d;
    const hn::RepartitionToWide<Floats> wide;
    const auto low01 = hn::BitCast(wide, hn::InterleaveLower(d, r0, r1));  // x0 x1 y0 y1
    const auto low23 = hn::BitCast(wide, hn::InterleaveLower(d, r2, r3));
    const auto high01 = hn::BitCast(wide, hn::InterleaveUpper(d, r0, r1));  // z0 z1 . .
    const auto high23 = hn::BitCast(wide, hn::InterleaveUpper(d, r2, r3));
    return {hn::BitCast(d, hn::InterleaveLower(wide, low01, low23)),
            hn::BitCast(d, hn::InterleaveUpper(wide, low01, low23)),
            hn::BitCast(d, hn::InterleaveLower(wide, high01, high23))};
}
/// Points of kStep vertices by 128-bit loads: gather instructions of g++ 12 merge into a stale register and serialise.
/// The indices stand kStride apart.
template <int kStride = 1>
HWY_INLINE V3 gather(const Float4* w, const uint32_t* index) {
    constexpr int s = kStride, h = kStride * static_cast<int>(kStep - 4);  // h: first index of the upper half
    return transpose(load_pair(w + index[0], w + index[h]), load_pair(w + index[s], w + index[h + s]),
                     load_pair(w + index[2 * s], w + index[h + 2 * s]),
                     load_pair(w + index[3 * s], w + index[h + 3 * s]));
}
HWY_INLINE V3 load_points(const Float4* w) {
    constexpr uint32_t h = kStep - 4;
    return transpose(load_pair(w, w + h), load_pair(w + 1, w + h + 1), load_pair(w + 2, w + h + 2),
                     load_pair(w + 3, w + h + 3));
}
HWY_INLINE void store_pair(V a, Float4* low, Float4* high) {
#if HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SSSE3 || HWY_TARGET == HWY_SSE4
    (void)high;
    hn::Store(a, Floats(), &low->x);
#else
    const hn::Half<Floats> half;
    hn::Store(hn::LowerHalf(half, a), half, &low->x);
    hn::Store(hn::UpperHalf(half, a), half, &high->x);
#endif
}
/// Columns to rows: register r of the four holds vertices r and, in the upper half, r + 4.
struct PointRows {
    V row[4];
    explicit HWY_INLINE PointRows(V3 a) {
        const Floats d;
        const hn::RepartitionToWide<Floats> wide;
        const V zero = hn::Zero(d);
        const auto xy_low = hn::BitCast(wide, hn::InterleaveLower(d, a.x, a.y));  // x0 y0 x1 y1
        const auto z_low = hn::BitCast(wide, hn::InterleaveLower(d, a.z, zero));  // z0 0 z1 0
        const auto xy_high = hn::BitCast(wide, hn::InterleaveUpper(d, a.x, a.y));
        const auto z_high = hn::BitCast(wide, hn::InterleaveUpper(d, a.z, zero));
        row[0] = hn::BitCast(d, hn::InterleaveLower(wide, xy_low, z_low));
        row[1] = hn::BitCast(d, hn::InterleaveUpper(wide, xy_low, z_low));
        row[2] = hn::BitCast(d, hn::InterleaveLower(wide, xy_high, z_high));
        row[3] = hn::BitCast(d, hn::InterleaveUpper(wide, xy_high, z_high));
    }
};
HWY_INLINE void store_points(V3 a, Float4* w) {
    constexpr uint32_t h = kStep - 4;
    const PointRows rows(a);
    for (uint32_t r = 0; r < 4; ++r) store_pair(rows.row[r], w + r, w + h + r);
}
/// w[index[l]] -= a of lane l, one lane after the other.
HWY_INLINE void subtract_points(V3 a, Float4* w, const uint32_t* index) {
    const PointRows rows(a);
    const hn::CappedTag<float, 4> d;
    const auto subtract = [&](auto from, uint32_t at)
                              HWY_ATTR { hn::Store(hn::Sub(hn::Load(d, &w[at].x), from), d, &w[at].x); };
#if HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SSSE3 || HWY_TARGET == HWY_SSE4
    for (uint32_t r = 0; r < 4; ++r) subtract(rows.row[r], index[r]);
#else
    for (uint32_t r = 0; r < 4; ++r) subtract(hn::LowerHalf(hn::Half<Floats>(), rows.row[r]), index[r]);
    for (uint32_t r = 0; r < 4; ++r) subtract(hn::UpperHalf(hn::Half<Floats>(), rows.row[r]), index[r + 4]);
#endif
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace cullet
HWY_AFTER_NAMESPACE();
#endif
