#include <algorithm>
#include <map>
#include <tuple>

#include "sample_game/mesh_tools.hpp"

namespace cullet {
namespace {

// A pass splits edges down to this share of the longest, so that some passes do for any mesh.
constexpr double kShareOfLongest = 0.85;

struct LongEdge {
    double length;
    uint32_t a, b;  // a < b
};

/// The two triangles of each edge; the second is the first's again on a border.
using Sides = std::map<std::pair<uint32_t, uint32_t>, std::array<uint32_t, 2>>;

Sides sides_of(const MeshDraft& s) {
    Sides sides;
    for (uint32_t t = 0; t < s.triangles.size(); ++t)
        for (size_t c = 0; c < 3; ++c) {
            const uint32_t a = s.triangles[t][c], b = s.triangles[t][(c + 1) % 3];
            const auto [place, is_new] = sides.try_emplace(std::minmax(a, b), std::array<uint32_t, 2>{t, t});
            if (!is_new) place->second[1] = t;
        }
    return sides;
}

std::vector<LongEdge> longest_first(const MeshDraft& s, const Sides& sides) {
    std::vector<LongEdge> edges;
    for (const auto& [ends, unused] : sides)
        edges.push_back({length(s.points[ends.first] - s.points[ends.second]), ends.first, ends.second});
    std::sort(edges.begin(), edges.end(), [](const LongEdge& p, const LongEdge& q) {
        return std::tie(q.length, p.a, p.b) < std::tie(p.length, q.a, q.b);
    });
    return edges;
}

void halve(MeshDraft& s, uint32_t triangle, uint32_t a, uint32_t b, uint32_t middle) {
    Triangle other = s.triangles[triangle];
    std::replace(other.begin(), other.end(), a, middle);
    std::replace(s.triangles[triangle].begin(), s.triangles[triangle].end(), b, middle);
    s.triangles.push_back(other);
}

}  // namespace

void split_longest(MeshDraft& surface, size_t vertices, const std::function<Vec3d(Vec3d)>& project) {
    while (surface.points.size() < vertices) {
        const Sides sides = sides_of(surface);
        const std::vector<LongEdge> edges = longest_first(surface, sides);
        std::vector<bool> is_taken(surface.triangles.size());
        if (edges.empty()) return;
        for (const LongEdge& e : edges) {
            if (surface.points.size() == vertices || e.length < kShareOfLongest * edges.front().length) break;
            const auto [first, second] = sides.at({e.a, e.b});
            if (is_taken[first] || is_taken[second]) continue;
            const Vec3d middle = 0.5 * (surface.points[e.a] + surface.points[e.b]);
            const auto v = static_cast<uint32_t>(surface.points.size());
            surface.points.push_back(project ? project(middle) : middle);
            halve(surface, first, e.a, e.b, v);
            if (second != first) halve(surface, second, e.a, e.b, v);
            is_taken[first] = is_taken[second] = true;
        }
    }
}

void open_seam(MeshDraft& surface, size_t vertices, const std::function<bool(Vec3d)>& is_beyond) {
    std::vector<uint8_t> sides(surface.points.size()), beyond(surface.triangles.size());
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        Vec3d middle;
        for (const uint32_t v : surface.triangles[t]) middle += surface.points[v];
        beyond[t] = is_beyond((1.0 / 3) * middle);
        for (const uint32_t v : surface.triangles[t]) sides[v] = static_cast<uint8_t>(sides[v] | (beyond[t] ? 2 : 1));
    }
    std::map<uint32_t, uint32_t> copies;
    for (uint32_t v = 0; v < sides.size() && surface.points.size() < vertices; ++v) {
        if (sides[v] != 3) continue;
        copies[v] = static_cast<uint32_t>(surface.points.size());
        const Vec3d place = surface.points[v];
        surface.points.push_back(place);
    }
    for (size_t t = 0; t < surface.triangles.size(); ++t)
        for (uint32_t& v : surface.triangles[t])
            if (const auto copy = copies.find(v); beyond[t] && copy != copies.end()) v = copy->second;
}

}  // namespace cullet
