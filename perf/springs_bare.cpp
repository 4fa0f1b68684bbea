#include <algorithm>

#include "perf/bare_lanes.hpp"
#include "perf/springs.hpp"

namespace cullet::perf {

bool BareSprings::is_supported() {
    return __builtin_cpu_supports("avx2");
}

BareSprings::BareSprings(const SpringNet& net, const std::vector<Vec3>& start)
    : dt_(net.dt), inverse_mass_(1 / net.mass) {
    const auto count = static_cast<uint32_t>(start.size());
    const uint32_t packs = (count + 7) / 8;
    for (auto& side : position_) side.assign(8 * packs, Float4{});
    for (uint32_t v = 0; v < count; ++v)
        for (auto& side : position_) side[v] = {start[v].x, start[v].y, start[v].z, 0};
    for (auto& lane : velocity_) lane.assign(8 * packs, 0);
    strain_.assign(8 * packs, 0);
    std::vector<std::vector<uint32_t>> lists(8 * packs);
    for (const auto& [a, b] : net.springs) lists[a].push_back(b), lists[b].push_back(a);
    for (uint32_t p = 0; p < packs; ++p) {
        first_slots_.push_back(static_cast<uint32_t>(slots_.size()));
        size_t most = 0;
        for (uint32_t k = 0; k < 8; ++k) most = std::max(most, lists[8 * p + k].size());
        for (size_t i = 0; i < most; ++i) {
            Slots slots{};
            for (uint32_t k = 0; k < 8; ++k) {
                const uint32_t v = 8 * p + k;
                slots.neighbour[k] = v;
                if (i >= lists[v].size()) continue;
                const uint32_t n = slots.neighbour[k] = lists[v][i];
                const float rest = length(net.points[n] - net.points[v]);
                slots.inverse_rest[k] = 1 / rest;
                slots.stiffness_rest[k] = net.stiffness * rest;
                slots.damping[k] = net.damping / net.dt;
                slots.length[k] = length(start[n] - start[v]);
            }
            slots_.push_back(slots);
        }
    }
    first_slots_.push_back(static_cast<uint32_t>(slots_.size()));
}

Vec3 BareSprings::position(uint32_t v) const {
    const Float4 x = position_[side_][v];
    return {x.x, x.y, x.z};
}

void BareSprings::step() {
    step_packs(side_, 0, pack_count());
    side_ = 1 - side_;
}

__attribute__((target("avx2"))) void BareSprings::step_packs(uint32_t side, uint32_t first, uint32_t end) {
    const Float4* from = position_[side].data();
    Float4* to = position_[1 - side].data();
    const __m256 dt = _mm256_set1_ps(dt_), push = _mm256_set1_ps(dt_ * inverse_mass_), one = _mm256_set1_ps(1);
    const __m256 tiny = _mm256_set1_ps(1e-30f);  // a padding slot has no length
    for (uint32_t p = first; p < end; ++p) {
        const uint32_t v = 8 * p;
        __m256 x0, y0, z0, x, y, z, fx = _mm256_setzero_ps(), fy = fx, fz = fx, most = SUB(fx, one);
        turn(pair(from + v, from + v + 4), pair(from + v + 1, from + v + 5), pair(from + v + 2, from + v + 6),
             pair(from + v + 3, from + v + 7), x0, y0, z0);
        for (uint32_t i = first_slots_[p]; i < first_slots_[p + 1]; ++i) {
            Slots& s = slots_[i];
            gather(from, reinterpret_cast<const float*>(s.neighbour), x, y, z);
            x = SUB(x, x0), y = SUB(y, y0), z = SUB(z, z0);
            const __m256 length = _mm256_max_ps(tiny, _mm256_sqrt_ps(ADD(ADD(MUL(x, x), MUL(y, y)), MUL(z, z))));
            const __m256 strain = SUB(MUL(length, _mm256_load_ps(s.inverse_rest)), one);
            const __m256 closing = SUB(length, _mm256_load_ps(s.length));
            const __m256 pull =
                ADD(MUL(_mm256_load_ps(s.stiffness_rest), strain), MUL(_mm256_load_ps(s.damping), closing));
            const __m256 scale = _mm256_div_ps(pull, length);
            fx = ADD(fx, MUL(scale, x)), fy = ADD(fy, MUL(scale, y)), fz = ADD(fz, MUL(scale, z));
            most = _mm256_max_ps(most, strain);
            _mm256_store_ps(s.length, length);
        }
        const __m256 vx = ADD(_mm256_loadu_ps(&velocity_[0][v]), MUL(push, fx));
        const __m256 vy = ADD(_mm256_loadu_ps(&velocity_[1][v]), MUL(push, fy));
        const __m256 vz = ADD(_mm256_loadu_ps(&velocity_[2][v]), MUL(push, fz));
        _mm256_storeu_ps(&velocity_[0][v], vx), _mm256_storeu_ps(&velocity_[1][v], vy);
        _mm256_storeu_ps(&velocity_[2][v], vz), _mm256_storeu_ps(&strain_[v], most);
        store(to + v, ADD(x0, MUL(dt, vx)), ADD(y0, MUL(dt, vy)), ADD(z0, MUL(dt, vz)));
    }
}

}  // namespace cullet::perf
