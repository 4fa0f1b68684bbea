// Raw AVX2, for the bare kernels alone: the least that a step can be. Only perf/*_bare.cpp include it.
#pragma once
#include <immintrin.h>

#include <cstdint>

#include "components/shells.hpp"

namespace cullet::perf {

#define BARE __attribute__((target("avx2"), always_inline)) static inline

BARE __m256 pair(const Float4* low, const Float4* high) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(&low->x)), _mm_load_ps(&high->x), 1);
}
BARE void turn(__m256 a, __m256 b, __m256 c, __m256 d, __m256& x, __m256& y, __m256& z) {
    const __m256 l0 = _mm256_unpacklo_ps(a, b), l1 = _mm256_unpacklo_ps(c, d);
    const __m256 h0 = _mm256_unpackhi_ps(a, b), h1 = _mm256_unpackhi_ps(c, d);
    x = _mm256_castpd_ps(_mm256_unpacklo_pd(_mm256_castps_pd(l0), _mm256_castps_pd(l1)));
    y = _mm256_castpd_ps(_mm256_unpackhi_pd(_mm256_castps_pd(l0), _mm256_castps_pd(l1)));
    z = _mm256_castpd_ps(_mm256_unpacklo_pd(_mm256_castps_pd(h0), _mm256_castps_pd(h1)));
}
BARE void gather(const Float4* w, const float* slot, __m256& x, __m256& y, __m256& z) {
    const auto* n = reinterpret_cast<const uint32_t*>(slot);
    turn(pair(w + n[0], w + n[4]), pair(w + n[1], w + n[5]), pair(w + n[2], w + n[6]), pair(w + n[3], w + n[7]), x, y,
         z);
}
/// Eight vectors, with a fourth number of 0.
BARE void store(Float4* to, __m256 x, __m256 y, __m256 z) {
    const __m256 zero = _mm256_setzero_ps();
    const __m256d a = _mm256_castps_pd(_mm256_unpacklo_ps(x, y)), b = _mm256_castps_pd(_mm256_unpacklo_ps(z, zero));
    const __m256d c = _mm256_castps_pd(_mm256_unpackhi_ps(x, y)), d = _mm256_castps_pd(_mm256_unpackhi_ps(z, zero));
    const __m256 r[4] = {_mm256_castpd_ps(_mm256_unpacklo_pd(a, b)), _mm256_castpd_ps(_mm256_unpackhi_pd(a, b)),
                         _mm256_castpd_ps(_mm256_unpacklo_pd(c, d)), _mm256_castpd_ps(_mm256_unpackhi_pd(c, d))};
    for (uint32_t q = 0; q < 4; ++q) {
        _mm_store_ps(&to[q].x, _mm256_castps256_ps128(r[q]));
        _mm_store_ps(&to[q + 4].x, _mm256_extractf128_ps(r[q], 1));
    }
}
#define MUL _mm256_mul_ps
#define ADD _mm256_add_ps
#define SUB _mm256_sub_ps

}  // namespace cullet::perf
