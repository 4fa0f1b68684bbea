#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "sample_game/mesh_tools.hpp"

namespace cullet {
namespace {

constexpr int kRounds = 7;  // after that the shares of short and long edges stand still
constexpr int kPassesPerRound = 6;
// Bounds of the edge length that neither splitting nor collapsing makes worse (Botsch and Kobbelt).
constexpr double kLongest = 4.0 / 3, kShortest = 4.0 / 5;

struct Edge {
    double length;
    uint32_t a, b;  // a < b
};

/// Triangles round each vertex, in order of their number.
struct TrianglesRound {
    explicit TrianglesRound(const MeshDraft& s) : first(s.points.size() + 1), triangles(3 * s.triangles.size()) {
        for (const Triangle& t : s.triangles)
            for (const uint32_t v : t) ++first[v + 1];
        std::partial_sum(first.begin(), first.end(), first.begin());
        std::vector<uint32_t> next(first.begin(), first.end() - 1);
        for (uint32_t t = 0; t < s.triangles.size(); ++t)
            for (const uint32_t v : s.triangles[t]) triangles[next[v]++] = t;
    }
    std::span<const uint32_t> operator[](uint32_t v) const {
        return std::span(triangles).subspan(first[v], first[v + 1] - first[v]);
    }

    std::vector<uint32_t> first, triangles;
};

/// The vertices joined to v, each once, in order. It writes into a vector that its caller keeps: one of its own for
/// each vertex took a fifth of the time.
void find_neighbours(const MeshDraft& s, std::span<const uint32_t> round, uint32_t v, std::vector<uint32_t>& result) {
    result.clear();
    for (const uint32_t t : round)
        for (const uint32_t w : s.triangles[t])
            if (w != v) result.push_back(w);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
}

/// Those whose length is wanted.
template <class Wanted>
std::vector<Edge> edges_shortest_first(const MeshDraft& s, Wanted&& is_wanted) {
    std::vector<Edge> edges;
    for (const Triangle& t : s.triangles)
        for (int c = 0; c < 3; ++c) {
            const uint32_t a = t[c], b = t[(c + 1) % 3];
            if (a > b) continue;  // closed: each edge once in the other sense
            const double along = length(s.points[a] - s.points[b]);
            if (is_wanted(along)) edges.push_back({along, a, b});
        }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& p, const Edge& q) { return std::tie(p.length, p.a, p.b) < std::tie(q.length, q.a, q.b); });
    return edges;
}

/// Splits long edges, longest first, at most one a triangle. False when there was none.
bool split_long(MeshDraft& s, double edge, const std::function<Vec3d(Vec3d)>& project) {
    const std::vector<Edge> edges = edges_shortest_first(s, [&](double along) { return along > kLongest * edge; });
    if (edges.empty()) return false;
    const TrianglesRound round(s);
    std::vector<bool> is_taken(s.triangles.size());
    bool has_split = false;
    for (auto e = edges.rbegin(); e != edges.rend(); ++e) {
        std::vector<uint32_t> sides;
        for (const uint32_t t : round[e->a])
            for (const uint32_t v : s.triangles[t])
                if (v == e->b) sides.push_back(t);
        if (sides.size() != 2 || is_taken[sides[0]] || is_taken[sides[1]]) continue;
        const auto middle = static_cast<uint32_t>(s.points.size());
        s.points.push_back(project(0.5 * (s.points[e->a] + s.points[e->b])));
        for (const uint32_t t : sides) {
            Triangle other = s.triangles[t];
            std::replace(other.begin(), other.end(), e->a, middle);
            std::replace(s.triangles[t].begin(), s.triangles[t].end(), e->b, middle);
            s.triangles.push_back(other);
            is_taken[t] = true;
        }
        has_split = true;
    }
    return has_split;
}

Vec3d normal_of(const MeshDraft& s, const Triangle& t) {
    return cross(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]]);
}

/// True when a and b, with these neighbours, may become one vertex at `place`: the surface stays a manifold (exactly
/// two common neighbours, which keep three others), no edge becomes long, no triangle turns by more than 60 degrees.
bool may_collapse(const MeshDraft& s, const TrianglesRound& round, const Edge& e, const std::vector<uint32_t>& of_a,
                  const std::vector<uint32_t>& of_b, Vec3d place, double edge) {
    std::vector<uint32_t> common;
    std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
    if (common.size() != 2) return false;
    for (const uint32_t v : common)
        if (round[v].size() <= 4) return false;
    for (const uint32_t end : {e.a, e.b}) {
        for (const uint32_t v : end == e.a ? of_a : of_b)
            if (length(s.points[v] - place) > kLongest * edge) return false;
        for (const uint32_t t : round[end]) {
            Triangle moved = s.triangles[t];
            if (std::count(moved.begin(), moved.end(), e.a) + std::count(moved.begin(), moved.end(), e.b) == 2)
                continue;
            const Vec3d before = normal_of(s, moved);
            Vec3d corner[3];
            for (int c = 0; c < 3; ++c) corner[c] = moved[c] == end ? place : s.points[moved[c]];
            const Vec3d after = cross(corner[1] - corner[0], corner[2] - corner[0]);
            if (!(dot(before, after) > 0.5 * length(before) * length(after))) return false;
        }
    }
    return true;
}

void drop_unused(MeshDraft& s, const std::vector<uint32_t>& becomes) {
    MeshDraft kept;
    std::vector<uint32_t> number(s.points.size());
    for (uint32_t v = 0; v < s.points.size(); ++v)
        if (becomes[v] == v) {
            number[v] = static_cast<uint32_t>(kept.points.size());
            kept.points.push_back(s.points[v]);
        }
    for (Triangle t : s.triangles) {
        for (uint32_t& v : t) v = number[becomes[v]];
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) kept.triangles.push_back(t);
    }
    s = std::move(kept);
}

/// Collapses short edges, shortest first, no two with a common neighbour. False when there was none.
bool collapse_short(MeshDraft& s, double edge, const std::function<Vec3d(Vec3d)>& project) {
    const std::vector<Edge> edges = edges_shortest_first(s, [&](double along) { return along < kShortest * edge; });
    if (edges.empty()) return false;
    const TrianglesRound round(s);
    std::vector<uint32_t> of_a, of_b;
    std::vector<bool> is_touched(s.points.size());
    std::vector<uint32_t> becomes(s.points.size());
    for (uint32_t v = 0; v < becomes.size(); ++v) becomes[v] = v;
    bool has_collapsed = false;
    const auto any_touched = [&](const std::vector<uint32_t>& of) {
        return std::any_of(of.begin(), of.end(), [&](uint32_t v) { return is_touched[v]; });
    };
    for (const Edge& e : edges) {
        if (is_touched[e.a] || is_touched[e.b]) continue;
        find_neighbours(s, round[e.a], e.a, of_a);
        find_neighbours(s, round[e.b], e.b, of_b);
        if (any_touched(of_a) || any_touched(of_b)) continue;
        const Vec3d place = project(0.5 * (s.points[e.a] + s.points[e.b]));
        if (!may_collapse(s, round, e, of_a, of_b, place, edge)) continue;
        for (const uint32_t v : of_a) is_touched[v] = true;
        for (const uint32_t v : of_b) is_touched[v] = true;
        s.points[e.a] = place;
        becomes[e.b] = e.a;
        has_collapsed = true;
    }
    if (has_collapsed) drop_unused(s, becomes);
    return has_collapsed;
}

/// Moves each point half the way to the middle of its neighbours, along the surface.
void slide(MeshDraft& s, const std::function<Vec3d(Vec3d)>& project) {
    const TrianglesRound round(s);
    std::vector<Vec3d> moved(s.points.size());
    std::vector<uint32_t> ring;
    for (uint32_t v = 0; v < s.points.size(); ++v) {
        find_neighbours(s, round[v], v, ring);
        Vec3d middle, normal;
        for (const uint32_t w : ring) middle += s.points[w];
        for (const uint32_t t : round[v]) normal += normal_of(s, s.triangles[t]);
        normal = normalised(normal);
        const Vec3d step = (1.0 / static_cast<double>(ring.size())) * middle - s.points[v];
        moved[v] = project(s.points[v] + 0.5 * (step - dot(step, normal) * normal));
    }
    s.points = std::move(moved);
}

}  // namespace

void remesh(MeshDraft& surface, double edge, const std::function<Vec3d(Vec3d)>& project) {
    for (int round = 0; round < kRounds; ++round) {
        for (int pass = 0; pass < kPassesPerRound && collapse_short(surface, edge, project); ++pass) {
        }
        for (int pass = 0; pass < kPassesPerRound && split_long(surface, edge, project); ++pass) {
        }
        for (int pass = 0; pass < 3; ++pass) {
            flip_to_delaunay(surface);
            slide(surface, project);
        }
        flip_to_delaunay(surface);
    }
}

}  // namespace cullet
