#include "systems/structures/shell/cell_parts.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr uint32_t kFewElements = 4;  // a part of fewer is not halved
constexpr uint32_t kMostElements = 256;
constexpr uint32_t kWays = 6;  // 30 degrees apart
constexpr float kHalfRoot3 = 0.8660254f;
constexpr float kTurn[kWays][2] = {{1, 0}, {kHalfRoot3, 0.5f},  {0.5f, kHalfRoot3},
                                   {0, 1}, {-0.5f, kHalfRoot3}, {-kHalfRoot3, 0.5f}};

/// Across which way a part is halved.
struct Halving {
    Vec3 way;
    float middle = 0;
};

Vec3 tangent_of(Vec3 n) {
    return normalised(std::fabs(n.x) < 0.7f ? cross(n, {1, 0, 0}) : cross(n, {0, 1, 0}));
}

Vec3 normal_of(const ShellView& shell, std::span<const uint32_t> list) {
    Vec3 n;
    for (uint32_t e : list) {
        const auto& c = shell.state.elements.corner[shell.element(e)];
        const auto& rest = shell.state.vertices.rest;
        const Vec3 a = rest[shell.vertex(c[0])];
        n += cross(rest[shell.vertex(c[1])] - a, rest[shell.vertex(c[2])] - a);
    }
    n = normalised(n);
    return dot(n, n) > 0 ? n : Vec3{0, 1, 0};  // closed or folded: no normal of its own
}

Halving longest_way(const ShellView& shell, std::span<const uint32_t> list) {
    const Vec3 n = normal_of(shell, list), x = tangent_of(n), y = cross(n, x);
    Halving best;
    float longest = 0;
    for (const auto& turn : kTurn) {
        const Vec3 way = turn[0] * x + turn[1] * y;
        float low = 1e30f, high = -1e30f;
        for (uint32_t e : list)
            for (uint32_t v : shell.state.elements.corner[shell.element(e)]) {
                const float place = dot(way, shell.state.vertices.rest[shell.vertex(v)]);
                low = std::min(low, place), high = std::max(high, place);
            }
        if (high - low > longest) longest = high - low, best = {way, 0.5f * (low + high)};
    }
    return best;
}

}  // namespace

uint32_t halve_part(const ShellView& shell, std::span<uint32_t> elements, CellParts& parts, uint32_t part) {
    const std::span<uint32_t> list = elements.subspan(parts.first[part], parts.size[part]);
    if (list.size() < kFewElements || list.size() > kMostElements || parts.count == kMostCellParts) return part;
    const Halving at = longest_way(shell, list);
    uint32_t upper[kMostElements], low_count = 0, high_count = 0;
    for (uint32_t e : list) {
        Vec3 sum;
        for (uint32_t v : shell.state.elements.corner[shell.element(e)])
            sum += shell.state.vertices.rest[shell.vertex(v)];
        if (dot(at.way, sum) < 3 * at.middle)
            list[low_count++] = e;
        else
            upper[high_count++] = e;
    }
    std::copy_n(upper, high_count, list.begin() + low_count);
    if (low_count == 0 || high_count == 0) return part;
    parts.size[part] = low_count;
    parts.first[parts.count] = parts.first[part] + low_count;
    parts.size[parts.count] = high_count;
    return parts.count++;
}

}  // namespace cullet
