#include "systems/fragments/cell_parts.hpp"

#include <algorithm>

namespace cullet {
namespace {

// m of burial. Two, three and four parts a bend took the hover of 1,000 shards in a pit (the 95th percentile) from 1.8 mm
// to 0.6, 0.6 and 0.3, but each made more contacts, and the solver's share and the time to sleep grow with them.
constexpr float kMostBend = 0.001f;
constexpr uint32_t kMostBentParts = 3;  // the fourth is for what 32 points leave out
constexpr float kMostBendOfWall = 0.1f;
constexpr uint32_t kFewElements = 4;  // a part of fewer is not halved
constexpr uint32_t kWays = 6;         // 30 degrees apart
constexpr float kHalfRoot3 = 0.8660254f;
constexpr float kTurn[kWays][2] = {{1, 0}, {kHalfRoot3, 0.5f},  {0.5f, kHalfRoot3},
                                   {0, 1}, {-0.5f, kHalfRoot3}, {-kHalfRoot3, 0.5f}};

/// Across which way a part is best halved.
struct Halving {
    float worth = 0;  // m
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

template <class Worth>
Halving find_halving(const ShellView& shell, std::span<const uint32_t> list, Worth worth) {
    const Vec3 n = normal_of(shell, list), x = tangent_of(n), y = cross(n, x);
    Halving best;
    for (const auto& turn : kTurn) {
        const Vec3 way = turn[0] * x + turn[1] * y;
        float low = 1e30f, high = -1e30f, least = 1e30f, most = -1e30f;
        for (uint32_t e : list)
            for (uint32_t v : shell.state.elements.corner[shell.element(e)]) {
                const float place = dot(way, shell.state.vertices.rest[shell.vertex(v)]);
                const float lean = dot(way, shell.state.vertices.inward[shell.vertex(v)]);
                low = std::min(low, place), high = std::max(high, place);
                least = std::min(least, lean), most = std::max(most, lean);
            }
        const float w = worth(high - low, most - least);
        if (w > best.worth) best = {w, way, 0.5f * (low + high)};
    }
    return best;
}

/// By the elements' middles, each side in the order it had. False: all lie on one side, nothing is changed.
bool halve(const ShellView& shell, std::span<uint32_t> elements, CellParts& parts, uint32_t part, const Halving& at) {
    constexpr uint32_t kMost = 256;
    uint32_t upper[kMost], low_count = 0, high_count = 0;
    const std::span<uint32_t> list = elements.subspan(parts.first[part], parts.size[part]);
    CULLET_ASSERT(list.size() <= kMost, "a part of %zu elements", list.size());
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
    if (low_count == 0 || high_count == 0) return false;
    parts.size[part] = low_count;
    parts.first[parts.count] = parts.first[part] + low_count;
    parts.size[parts.count++] = high_count;
    return true;
}

}  // namespace

void split_by_bend(const ShellView& shell, std::span<uint32_t> elements, CellParts& parts) {
    const float enough = std::max(kMostBend, kMostBendOfWall * shell.shells().thickness[shell.row]);
    parts.first[0] = 0;
    parts.size[0] = static_cast<uint32_t>(elements.size());
    parts.count = 1;
    Halving halving[kMostCellParts];
    const auto measure = [&](uint32_t part) {
        halving[part] = {};
        if (parts.size[part] < kFewElements) return;
        halving[part] =
            find_halving(shell, parts.list(elements, part), [](float extent, float turn) { return extent * turn / 8; });
    };
    measure(0);
    while (parts.count < kMostBentParts) {
        uint32_t worst = 0;
        for (uint32_t p = 1; p < parts.count; ++p)
            if (halving[p].worth > halving[worst].worth) worst = p;
        if (!(halving[worst].worth > enough)) return;
        if (!halve(shell, elements, parts, worst, halving[worst])) {
            halving[worst].worth = 0;
            continue;
        }
        measure(worst);
        measure(parts.count - 1);
    }
}

uint32_t split_by_reach(const ShellView& shell, std::span<uint32_t> elements, CellParts& parts, uint32_t part) {
    if (parts.size[part] < kFewElements || parts.count == kMostCellParts) return part;
    const Halving at = find_halving(shell, parts.list(elements, part), [](float extent, float) { return extent; });
    return halve(shell, elements, parts, part, at) ? parts.count - 1 : part;
}

}  // namespace cullet
