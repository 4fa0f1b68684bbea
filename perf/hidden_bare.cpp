#include <cstring>

#include "perf/bare_lanes.hpp"
#include "perf/hidden_yardsticks.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"

namespace cullet::perf {
namespace {
constexpr size_t kBlockFloats = 8 + 9 * 8, kLinkFloats = 8 + 6 * 8;
}

bool BareHidden::is_supported() {
    return __builtin_cpu_supports("avx2");
}

BareHidden::BareHidden(ShellView shell, float dt, float beta)
    : dt_(dt), beta_(beta), has_pair_cells_(stores_pairs_once(shell.structures(), shell.structure)) {
    const ShellRows& s = shell.state;
    const Range packs = s.shells.packs[shell.row];
    size_t floats = 0;
    for (uint32_t p = 0; p < packs.count; ++p) {
        const uint32_t row = packs.first + p;
        packs_.push_back({floats, s.stiffness_packs.block_count[row], s.stiffness_packs.link_count[row]});
        floats += packs_.back().blocks * kBlockFloats + packs_.back().links * kLinkFloats;
    }
    stream_.resize(floats + kPadding);
    base_ = reinterpret_cast<float*>((reinterpret_cast<uintptr_t>(stream_.data()) + 63) & ~uintptr_t{63});
    for (uint32_t p = 0; p < packs.count; ++p) {
        const uint32_t row = packs.first + p;
        float* out = base_ + packs_[p].offset;
        for (uint32_t i = 0; i < packs_[p].blocks; ++i, out += kBlockFloats)
            std::memcpy(
                out,
                &s.stiffness_blocks.block[s.shells.blocks[shell.row].first + s.stiffness_packs.first_block[row] + i],
                kBlockFloats * 4);
        for (uint32_t i = 0; i < packs_[p].links; ++i, out += kLinkFloats)
            std::memcpy(
                out, &s.stiffness_links.link[s.shells.links[shell.row].first + s.stiffness_packs.first_link[row] + i],
                kLinkFloats * 4);
    }
    const uint32_t vertices = packs.count * kLanes, first = shell.vertices().first;
    for (int side = 0; side < 2; ++side)
        probe_[side].assign(s.vertices.probe.data(0) + first, s.vertices.probe.data(0) + first + vertices);
    for (int k = 0; k < 3; ++k) {
        u_[k].assign(s.vertices.displacement.lane(k) + first, s.vertices.displacement.lane(k) + first + vertices);
        v_[k].assign(s.vertices.velocity.lane(k) + first, s.vertices.velocity.lane(k) + first + vertices);
    }
    inverse_mass_.assign(s.vertices.inverse_mass.data() + first, s.vertices.inverse_mass.data() + first + vertices);
}

__attribute__((target("avx2"))) void BareHidden::integrate(uint32_t side, uint32_t first, uint32_t count) {
    const Float4* w = probe_[side].data();
    Float4* next = probe_[1 - side].data();
    const __m256 dt = _mm256_set1_ps(dt_), beta = _mm256_set1_ps(beta_);
    for (uint32_t p = first; p < first + count; ++p) {
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
            fx = ADD(
                fx, ADD(ADD(MUL(_mm256_load_ps(k), x), MUL(_mm256_load_ps(k + 8), y)), MUL(_mm256_load_ps(k + 16), z)));
            fy = ADD(fy, ADD(ADD(MUL(_mm256_load_ps(k + 24), x), MUL(_mm256_load_ps(k + 32), y)),
                             MUL(_mm256_load_ps(k + 40), z)));
            fz = ADD(fz, ADD(ADD(MUL(_mm256_load_ps(k + 48), x), MUL(_mm256_load_ps(k + 56), y)),
                             MUL(_mm256_load_ps(k + 64), z)));
        }
        for (uint32_t i = 0; i < packs_[p].links; ++i, s += kLinkFloats) {
            for (size_t b = 0; b < kLinkFloats; b += 16)
                _mm_prefetch(reinterpret_cast<const char*>(s + 512 + b), _MM_HINT_T0);
            gather(w, s, x, y, z);
            x = SUB(x, x0), y = SUB(y, y0), z = SUB(z, z0);
            const float* k = s + 8;
            const __m256 t = ADD(ADD(MUL(_mm256_load_ps(k + 24), x), MUL(_mm256_load_ps(k + 32), y)),
                                 MUL(_mm256_load_ps(k + 40), z));
            fx = ADD(fx, MUL(_mm256_load_ps(k), t));
            fy = ADD(fy, MUL(_mm256_load_ps(k + 8), t));
            fz = ADD(fz, MUL(_mm256_load_ps(k + 16), t));
        }
        const uint32_t i = p * 8;
        const __m256 m = MUL(dt, _mm256_loadu_ps(&inverse_mass_[i]));
        const __m256 vx = ADD(_mm256_loadu_ps(&v_[0][i]), MUL(m, fx));
        const __m256 vy = ADD(_mm256_loadu_ps(&v_[1][i]), MUL(m, fy));
        const __m256 vz = ADD(_mm256_loadu_ps(&v_[2][i]), MUL(m, fz));
        const __m256 ux = ADD(_mm256_loadu_ps(&u_[0][i]), MUL(dt, vx));
        const __m256 uy = ADD(_mm256_loadu_ps(&u_[1][i]), MUL(dt, vy));
        const __m256 uz = ADD(_mm256_loadu_ps(&u_[2][i]), MUL(dt, vz));
        _mm256_storeu_ps(&v_[0][i], vx), _mm256_storeu_ps(&v_[1][i], vy), _mm256_storeu_ps(&v_[2][i], vz);
        _mm256_storeu_ps(&u_[0][i], ux), _mm256_storeu_ps(&u_[1][i], uy), _mm256_storeu_ps(&u_[2][i], uz);
        x = ADD(ux, MUL(beta, vx)), y = ADD(uy, MUL(beta, vy)), z = ADD(uz, MUL(beta, vz));
        store(next + i, x, y, z);
    }
}

void BareHidden::run_packs(uint32_t side, uint32_t first, uint32_t count) {
    if (!has_pair_cells_) return integrate(side & 1, first, count);
    for (uint32_t p = first; p < first + count; p += kPairCellPacks) integrate_cell(side & 1, p);
}

}  // namespace cullet::perf
