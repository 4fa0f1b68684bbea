#include <algorithm>

#include "perf/bare_lanes.hpp"
#include "perf/hidden_yardsticks.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"

namespace cullet::perf {
namespace {
constexpr size_t kBlockFloats = 8 + 9 * 8, kLinkFloats = 8 + 6 * 8;
}

__attribute__((target("avx2"))) void BareHidden::integrate_cell(uint32_t side, uint32_t first) {
    const Float4* w = probe_[side].data();
    Float4* next = probe_[1 - side].data();
    const uint32_t end = std::min(first + kPairCellPacks, pack_count());
    const uint32_t first_vertex = first * kLanes, vertices = (end - first) * kLanes;
    alignas(32) Float4 f[kPairCellVertices + kLanes];
    for (uint32_t i = 0; i < vertices + kLanes; i += 2) _mm256_store_ps(&f[i].x, _mm256_setzero_ps());
    const __m256i from = _mm256_set1_epi32(static_cast<int>(first_vertex));
    const __m256i outside =
        _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(vertices)), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    const auto take_back = [&](const float* slot, __m256 x, __m256 y, __m256 z)
        __attribute__((target("avx2"), always_inline)) {
        alignas(32) uint32_t at[8];
        _mm256_store_si256(
            reinterpret_cast<__m256i*>(at),
            _mm256_min_epu32(_mm256_sub_epi32(_mm256_load_si256(reinterpret_cast<const __m256i*>(slot)), from),
                             outside));
        const __m256 zero = _mm256_setzero_ps();
        const __m256d a = _mm256_castps_pd(_mm256_unpacklo_ps(x, y)), b = _mm256_castps_pd(_mm256_unpacklo_ps(z, zero));
        const __m256d c = _mm256_castps_pd(_mm256_unpackhi_ps(x, y)), d = _mm256_castps_pd(_mm256_unpackhi_ps(z, zero));
        const __m256 r[4] = {_mm256_castpd_ps(_mm256_unpacklo_pd(a, b)), _mm256_castpd_ps(_mm256_unpackhi_pd(a, b)),
                             _mm256_castpd_ps(_mm256_unpacklo_pd(c, d)), _mm256_castpd_ps(_mm256_unpackhi_pd(c, d))};
        for (uint32_t q = 0; q < 4; ++q) {
            float* to = &f[at[q]].x;
            _mm_store_ps(to, _mm_sub_ps(_mm_load_ps(to), _mm256_castps256_ps128(r[q])));
        }
        for (uint32_t q = 0; q < 4; ++q) {
            float* to = &f[at[q + 4]].x;
            _mm_store_ps(to, _mm_sub_ps(_mm_load_ps(to), _mm256_extractf128_ps(r[q], 1)));
        }
    };
    for (uint32_t p = first; p < end; ++p) {
        const float* s = base_ + packs_[p].offset;
        const Float4* own = w + p * 8;
        __m256 x0, y0, z0, x, y, z, fx = _mm256_setzero_ps(), fy = fx, fz = fx;
        turn(pair(own, own + 4), pair(own + 1, own + 5), pair(own + 2, own + 6), pair(own + 3, own + 7), x0, y0, z0);
        for (uint32_t i = 0; i < packs_[p].blocks; ++i, s += kBlockFloats) {
            for (size_t b = 0; b < kBlockFloats; b += 16)
                _mm_prefetch(reinterpret_cast<const char*>(s + 512 + b), _MM_HINT_T0);
            gather(w, s, x, y, z);
            x = SUB(x, x0), y = SUB(y, y0), z = SUB(z, z0);
            const float* k = s + 8;
            const __m256 k0 = _mm256_load_ps(k), k1 = _mm256_load_ps(k + 8), k2 = _mm256_load_ps(k + 16);
            const __m256 k3 = _mm256_load_ps(k + 24), k4 = _mm256_load_ps(k + 32), k5 = _mm256_load_ps(k + 40);
            const __m256 k6 = _mm256_load_ps(k + 48), k7 = _mm256_load_ps(k + 56), k8 = _mm256_load_ps(k + 64);
            fx = ADD(fx, ADD(ADD(MUL(k0, x), MUL(k1, y)), MUL(k2, z)));
            fy = ADD(fy, ADD(ADD(MUL(k3, x), MUL(k4, y)), MUL(k5, z)));
            fz = ADD(fz, ADD(ADD(MUL(k6, x), MUL(k7, y)), MUL(k8, z)));
            take_back(s, ADD(ADD(MUL(k0, x), MUL(k3, y)), MUL(k6, z)), ADD(ADD(MUL(k1, x), MUL(k4, y)), MUL(k7, z)),
                      ADD(ADD(MUL(k2, x), MUL(k5, y)), MUL(k8, z)));
        }
        for (uint32_t i = 0; i < packs_[p].links; ++i, s += kLinkFloats) {
            for (size_t b = 0; b < kLinkFloats; b += 16)
                _mm_prefetch(reinterpret_cast<const char*>(s + 512 + b), _MM_HINT_T0);
            gather(w, s, x, y, z);
            x = SUB(x, x0), y = SUB(y, y0), z = SUB(z, z0);
            const float* k = s + 8;
            const __m256 r0 = _mm256_load_ps(k), r1 = _mm256_load_ps(k + 8), r2 = _mm256_load_ps(k + 16);
            const __m256 c0 = _mm256_load_ps(k + 24), c1 = _mm256_load_ps(k + 32), c2 = _mm256_load_ps(k + 40);
            const __m256 t = ADD(ADD(MUL(c0, x), MUL(c1, y)), MUL(c2, z));
            const __m256 b = ADD(ADD(MUL(r0, x), MUL(r1, y)), MUL(r2, z));
            fx = ADD(fx, MUL(r0, t)), fy = ADD(fy, MUL(r1, t)), fz = ADD(fz, MUL(r2, t));
            take_back(s, MUL(c0, b), MUL(c1, b), MUL(c2, b));
        }
        // Own sums, as one more share.
        Float4* at = f + (p * 8 - first_vertex);
        turn(pair(at, at + 4), pair(at + 1, at + 5), pair(at + 2, at + 6), pair(at + 3, at + 7), x, y, z);
        store(at, ADD(x, fx), ADD(y, fy), ADD(z, fz));
    }
    const __m256 dt = _mm256_set1_ps(dt_), beta = _mm256_set1_ps(beta_);
    for (uint32_t i = first_vertex; i < first_vertex + vertices; i += 8) {
        const Float4* at = f + (i - first_vertex);
        __m256 fx, fy, fz;
        turn(pair(at, at + 4), pair(at + 1, at + 5), pair(at + 2, at + 6), pair(at + 3, at + 7), fx, fy, fz);
        const __m256 m = MUL(dt, _mm256_loadu_ps(&inverse_mass_[i]));
        const __m256 vx = ADD(_mm256_loadu_ps(&v_[0][i]), MUL(m, fx));
        const __m256 vy = ADD(_mm256_loadu_ps(&v_[1][i]), MUL(m, fy));
        const __m256 vz = ADD(_mm256_loadu_ps(&v_[2][i]), MUL(m, fz));
        const __m256 ux = ADD(_mm256_loadu_ps(&u_[0][i]), MUL(dt, vx));
        const __m256 uy = ADD(_mm256_loadu_ps(&u_[1][i]), MUL(dt, vy));
        const __m256 uz = ADD(_mm256_loadu_ps(&u_[2][i]), MUL(dt, vz));
        _mm256_storeu_ps(&v_[0][i], vx), _mm256_storeu_ps(&v_[1][i], vy), _mm256_storeu_ps(&v_[2][i], vz);
        _mm256_storeu_ps(&u_[0][i], ux), _mm256_storeu_ps(&u_[1][i], uy), _mm256_storeu_ps(&u_[2][i], uz);
        store(next + i, ADD(ux, MUL(beta, vx)), ADD(uy, MUL(beta, vy)), ADD(uz, MUL(beta, vz)));
    }
}

}  // namespace cullet::perf
