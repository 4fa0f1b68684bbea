#include <algorithm>
#include <tuple>

#include "sample_game/mesh_tools.hpp"

namespace cullet {
namespace {

constexpr uint32_t kBorder = 0xffffffffu;
constexpr int kMostPasses = 50;  // a handful is usual; each flip shortens the sum of the cotangents

/// Half-edge h = 3 t + c runs from corner c of triangle t to the next corner.
struct HalfEdges {
    MeshDraft& surface;
    std::vector<uint32_t> twin;

    explicit HalfEdges(MeshDraft& s) : surface(s), twin(3 * s.triangles.size(), kBorder) {
        std::vector<std::tuple<uint32_t, uint32_t, uint32_t>> edges;
        for (uint32_t h = 0; h < twin.size(); ++h)
            edges.emplace_back(std::min(from(h), to(h)), std::max(from(h), to(h)), h);
        std::sort(edges.begin(), edges.end());
        for (size_t e = 0; e + 1 < edges.size(); ++e) {
            const auto [low, high, h] = edges[e];
            const auto [next_low, next_high, g] = edges[e + 1];
            if (low == next_low && high == next_high) twin[h] = g, twin[g] = h;
        }
    }
    static uint32_t next(uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
    uint32_t from(uint32_t h) const { return surface.triangles[h / 3][h % 3]; }
    uint32_t to(uint32_t h) const { return from(next(h)); }
    uint32_t opposite(uint32_t h) const { return from(next(next(h))); }
    Vec3d point(uint32_t v) const { return surface.points[v]; }
    Vec3d normal(uint32_t a, uint32_t b, uint32_t c) const { return cross(point(b) - point(a), point(c) - point(a)); }

    /// Cotangent of the angle opposite of h.
    double cotangent(uint32_t h) const {
        const Vec3d a = point(from(h)) - point(opposite(h)), b = point(to(h)) - point(opposite(h));
        const double area = length(cross(a, b));
        return area > 0 ? dot(a, b) / area : 1e9;
    }

    /// True when an edge joins the start of h to v. Walks the fan both ways, so borders do not hide a part of it.
    bool is_joined(uint32_t h, uint32_t v) const {
        uint32_t e = h;
        do {
            if (to(e) == v || opposite(e) == v) return true;
            e = twin[next(next(e))];
        } while (e != kBorder && e != h);
        if (e == h) return false;
        for (e = twin[h]; e != kBorder; e = twin[next(e)])
            if (opposite(e) == v) return true;
        return false;
    }

    bool may_flip(uint32_t h) const {
        const uint32_t g = twin[h], a = from(h), b = to(h), c = opposite(h), d = opposite(g);
        if (c == d || is_joined(next(next(h)), d)) return false;
        const Vec3d before = normal(a, b, c) + normal(b, a, d);
        return dot(normal(a, d, c), before) > 0 && dot(normal(b, c, d), before) > 0;
    }

    /// Cosine of the angle between the normals on both sides of h.
    double bend(uint32_t h) const {
        const uint32_t g = twin[h];
        const Vec3d a = normal(from(h), to(h), opposite(h)), b = normal(from(g), to(g), opposite(g));
        return dot(a, b) / (length(a) * length(b));
    }

    void pair(uint32_t h, uint32_t g) {
        twin[h] = g;
        if (g != kBorder) twin[g] = h;
    }

    /// Triangles (a, b, c) and (b, a, d) become (a, d, c) and (b, c, d).
    void flip(uint32_t h) {
        const uint32_t g = twin[h], a = from(h), b = to(h), c = opposite(h), d = opposite(g);
        const uint32_t bc = twin[next(h)], ca = twin[next(next(h))], ad = twin[next(g)], db = twin[next(next(g))];
        const uint32_t t = h / 3, u = g / 3;
        surface.triangles[t] = {a, d, c};
        surface.triangles[u] = {b, c, d};
        pair(3 * t, ad);
        pair(3 * t + 2, ca);
        pair(3 * u, bc);
        pair(3 * u + 2, db);
        pair(3 * t + 1, 3 * u + 1);
    }
};

}  // namespace

void flip_to_delaunay(MeshDraft& surface, double least_cosine) {
    HalfEdges edges(surface);
    bool has_flipped = true;
    for (int pass = 0; pass < kMostPasses && has_flipped; ++pass) {
        has_flipped = false;
        for (uint32_t h = 0; h < edges.twin.size(); ++h) {
            const uint32_t g = edges.twin[h];
            if (g == kBorder || g < h || edges.cotangent(h) + edges.cotangent(g) > -1e-9 || !edges.may_flip(h) ||
                edges.bend(h) < least_cosine)
                continue;
            edges.flip(h);
            has_flipped = true;
        }
    }
}

}  // namespace cullet
