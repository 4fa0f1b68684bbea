#include "systems/structures/shell/cook/thin_fans.hpp"

#include <algorithm>
#include <map>

#include "engine/math.hpp"

namespace cullet {
namespace {

constexpr uint32_t kNone32 = ~0u;
constexpr double kFlat = 0.866;  // cosine of 30 degrees
constexpr int kMostRounds = 16;  // each leaves at most two thirds where nothing is folded

using Corners = std::array<uint32_t, 3>;

bool comes_before(Vec3 a, Vec3 b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z < b.z;
}

/// For each vertex the lowest rank of its position in (x, y, z) order.
std::vector<uint32_t> places_of(const Mesh& mesh, uint32_t& count) {
    std::vector<uint32_t> order(mesh.positions.size()), place(mesh.positions.size());
    for (uint32_t v = 0; v < order.size(); ++v) order[v] = v;
    const auto& at = mesh.positions;
    std::sort(order.begin(), order.end(), [&](uint32_t v, uint32_t w) {
        return comes_before(at[v], at[w]) || (!comes_before(at[w], at[v]) && v < w);
    });
    count = 0;
    for (size_t k = 0; k < order.size(); ++k) {
        if (k == 0 || !(at[order[k]] == at[order[k - 1]])) ++count;
        place[order[k]] = count - 1;
    }
    return place;
}

/// A triangle of the fan: corner `hub` is at its middle, `a` and `b` follow.
struct Blade {
    uint32_t triangle, hub;
    uint32_t a, b;  // places
};

/// An edge from the middle outward, and the blades at it: first one with its b there, second one with its a there.
struct Spoke {
    uint32_t ends_at_b = kNone32, begins_at_a = kNone32, uses = 0;
    uint32_t vertex = kNone32;  // the new one half way
    bool is_left_out = false;
};

class Fan {
 public:
    Fan(Mesh& mesh, const std::vector<uint32_t>& place, const std::vector<uint32_t>& triangles, uint32_t middle)
        : mesh_(mesh) {
        for (const uint32_t t : triangles) {
            const Corners& c = mesh.triangles[t];
            for (uint32_t k = 0; k < 3; ++k)
                if (place[c[k]] == middle) blades_.push_back({t, k, place[c[(k + 1) % 3]], place[c[(k + 2) % 3]]});
        }
        for (uint32_t n = 0; n < blades_.size(); ++n) {
            Spoke &a = spokes_[blades_[n].a], &b = spokes_[blades_[n].b];
            a.begins_at_a = n, b.ends_at_b = n;
            ++a.uses, ++b.uses;
        }
    }

    /// False when no spoke can go; then nothing has changed.
    bool thin() {
        std::vector<uint8_t> is_matched(blades_.size());
        bool any = false;
        for (auto& [place, spoke] : spokes_) {  // by position: the order does not know the numbering
            if (!can_go(spoke) || is_matched[spoke.ends_at_b] || is_matched[spoke.begins_at_a]) continue;
            is_matched[spoke.ends_at_b] = is_matched[spoke.begins_at_a] = 1;
            any = spoke.is_left_out = true;
        }
        if (!any) return false;
        for (const Blade& blade : blades_) {
            put_vertex(spokes_[blade.a], blade, 1);
            put_vertex(spokes_[blade.b], blade, 2);
        }
        for (auto& [place, spoke] : spokes_)
            if (spoke.is_left_out) replace_pair(blades_[spoke.ends_at_b], blades_[spoke.begins_at_a]);
        for (uint32_t n = 0; n < blades_.size(); ++n)
            if (!is_matched[n]) replace_single(blades_[n]);
        return true;
    }

 private:
    /// A corner of a triangle that is to be, or the middle between two.
    struct Point {
        uint32_t vertex;
        size_t corner, other;  // in the corner arrays
    };

    Corners corners(const Blade& blade) const {
        const Corners& c = mesh_.triangles[blade.triangle];
        return {c[blade.hub], c[(blade.hub + 1) % 3], c[(blade.hub + 2) % 3]};
    }
    size_t corner(const Blade& blade, uint32_t k) const { return 3 * size_t{blade.triangle} + (blade.hub + k) % 3; }
    Vec3d normal(const Blade& blade) const {
        const Corners c = corners(blade);
        const Vec3d p(mesh_.positions[c[0]]);
        return normalised(cross(Vec3d(mesh_.positions[c[1]]) - p, Vec3d(mesh_.positions[c[2]]) - p));
    }

    bool can_go(const Spoke& spoke) const {
        if (spoke.uses != 2 || spoke.ends_at_b == kNone32 || spoke.begins_at_a == kNone32) return false;
        if (spoke.ends_at_b == spoke.begins_at_a) return false;
        const Blade &before = blades_[spoke.ends_at_b], &after = blades_[spoke.begins_at_a];
        if (before.a == after.b || !(dot(normal(before), normal(after)) > kFlat)) return false;
        if (!mesh_.materials.empty() && mesh_.materials[before.triangle] != mesh_.materials[after.triangle])
            return false;
        if (mesh_.corner_uvs.empty()) return true;
        const Vec2 p = mesh_.corner_uvs[corner(before, 2)], q = mesh_.corner_uvs[corner(after, 1)];
        return p.x == q.x && p.y == q.y;
    }

    void put_vertex(Spoke& spoke, const Blade& blade, uint32_t end) {
        if (spoke.is_left_out || spoke.vertex != kNone32) return;
        const Corners c = corners(blade);
        const Vec3d middle = 0.5 * (Vec3d(mesh_.positions[c[0]]) + Vec3d(mesh_.positions[c[end]]));
        spoke.vertex = static_cast<uint32_t>(mesh_.positions.size());
        mesh_.positions.push_back(middle.to_float());
    }

    Point outer(const Blade& blade, uint32_t k) const {
        return {corners(blade)[k], corner(blade, k), corner(blade, k)};
    }
    Point half_way(const Blade& blade, uint32_t k) {
        return {spokes_[k == 1 ? blade.a : blade.b].vertex, corner(blade, 0), corner(blade, k)};
    }

    struct Made {
        Corners vertices;
        std::array<Vec3, 3> normals;
        std::array<Vec2, 3> uvs;
        uint16_t material;
    };
    Made make(const Blade& like, const Point& p, const Point& q, const Point& r) const {
        Made made{{p.vertex, q.vertex, r.vertex}, {}, {}, 0};
        const Point* points[3] = {&p, &q, &r};
        for (size_t k = 0; k < 3; ++k) {
            if (!mesh_.corner_normals.empty()) {
                const Vec3 n = mesh_.corner_normals[points[k]->corner], m = mesh_.corner_normals[points[k]->other];
                const Vec3 sum = normalised(n + m);
                made.normals[k] = points[k]->corner != points[k]->other && dot(sum, sum) > 0 ? sum : n;
            }
            if (!mesh_.corner_uvs.empty()) {
                const Vec2 n = mesh_.corner_uvs[points[k]->corner], m = mesh_.corner_uvs[points[k]->other];
                made.uvs[k] = {0.5f * (n.x + m.x), 0.5f * (n.y + m.y)};
            }
        }
        if (!mesh_.materials.empty()) made.material = mesh_.materials[like.triangle];
        return made;
    }

    /// In place of triangle t, or behind all others.
    void put(uint32_t t, const Made& made) {
        if (t == mesh_.triangles.size()) {
            mesh_.triangles.push_back({});
            if (!mesh_.corner_normals.empty()) mesh_.corner_normals.resize(mesh_.corner_normals.size() + 3);
            if (!mesh_.corner_uvs.empty()) mesh_.corner_uvs.resize(mesh_.corner_uvs.size() + 3);
            if (!mesh_.materials.empty()) mesh_.materials.push_back(0);
        }
        mesh_.triangles[t] = made.vertices;
        for (size_t k = 0; k < 3; ++k) {
            if (!mesh_.corner_normals.empty()) mesh_.corner_normals[3 * size_t{t} + k] = made.normals[k];
            if (!mesh_.corner_uvs.empty()) mesh_.corner_uvs[3 * size_t{t} + k] = made.uvs[k];
        }
        if (!mesh_.materials.empty()) mesh_.materials[t] = made.material;
    }
    void append(const Made& made) { put(static_cast<uint32_t>(mesh_.triangles.size()), made); }

    void replace_pair(const Blade& first, const Blade& second) {
        const Point hub = outer(first, 0), a = outer(first, 1), m = outer(first, 2), b = outer(second, 2);
        const Point to_a = half_way(first, 1), to_b = half_way(second, 2);
        const Made made[4] = {make(first, hub, to_a, to_b), make(first, to_a, a, m), make(first, to_a, m, to_b),
                              make(second, to_b, m, b)};
        put(first.triangle, made[0]);
        put(second.triangle, made[3]);
        append(made[1]);
        append(made[2]);
    }

    void replace_single(const Blade& blade) {
        const Point hub = outer(blade, 0), a = outer(blade, 1), b = outer(blade, 2);
        const Point to_a = half_way(blade, 1), to_b = half_way(blade, 2);
        const Made made[3] = {make(blade, hub, to_a, to_b), make(blade, to_a, a, b), make(blade, to_a, b, to_b)};
        put(blade.triangle, made[0]);
        append(made[1]);
        append(made[2]);
    }

    Mesh& mesh_;
    std::vector<Blade> blades_;
    std::map<uint32_t, Spoke> spokes_;  // by the place of the outer end
};

bool has_repeated_place(const Corners& c, const std::vector<uint32_t>& place) {
    return place[c[0]] == place[c[1]] || place[c[1]] == place[c[2]] || place[c[2]] == place[c[0]];
}

/// Triangles at each crowded place, without those of no area: they are dropped later.
std::map<uint32_t, std::vector<uint32_t>> crowded_places(const Mesh& mesh, const std::vector<uint32_t>& place,
                                                         uint32_t count, uint32_t most) {
    std::vector<uint32_t> uses(count);
    const auto visit = [&](auto&& f) {
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
            if (!has_repeated_place(mesh.triangles[t], place))
                for (const uint32_t v : mesh.triangles[t]) f(place[v], t);
    };
    visit([&](uint32_t p, uint32_t) { ++uses[p]; });
    std::map<uint32_t, std::vector<uint32_t>> crowded;
    visit([&](uint32_t p, uint32_t t) {
        if (uses[p] > most) crowded[p].push_back(t);
    });
    return crowded;
}

}  // namespace

uint32_t thin_fans(Mesh& mesh, uint32_t most) {
    uint32_t found = 0;
    for (int round = 0; round < kMostRounds; ++round) {
        uint32_t count = 0;
        const std::vector<uint32_t> place = places_of(mesh, count);
        const auto crowded = crowded_places(mesh, place, count, most);
        if (round == 0) found = static_cast<uint32_t>(crowded.size());
        // One fan at a time where two share triangles: the next round finds what is left.
        std::vector<uint8_t> is_taken(mesh.triangles.size());
        bool any = false;
        for (const auto& [middle, triangles] : crowded) {
            if (std::any_of(triangles.begin(), triangles.end(), [&](uint32_t t) { return is_taken[t] != 0; })) continue;
            if (!Fan(mesh, place, triangles, middle).thin()) continue;
            for (const uint32_t t : triangles) is_taken[t] = 1;
            any = true;
        }
        if (!any) break;
    }
    return found;
}

}  // namespace cullet
