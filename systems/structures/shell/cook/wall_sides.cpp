#include "systems/structures/shell/cook/wall_sides.hpp"

#include <algorithm>
#include <map>

#include "systems/hulls/box_tree.hpp"

namespace cullet {
namespace {

constexpr double kLooksBack = -0.8;  // n . n of triangles across a wall from each other; keeps round lips out
constexpr double kSmooth = 0.5;      // n . n of neighbours on one patch
constexpr size_t kMostHits = 64;
constexpr float kRaySlack = 2e-6f;

class Finder {
 public:
    Finder(const Surface& surface, double reach) : surface_(surface), frame_(surface.low, surface.diagonal) {
        const size_t count = surface.triangles.size();
        found_.opposite.assign(count, kNone);
        found_.side.assign(count, WallSide::None);
        found_.is_lip.assign(count, 0);
        found_.nearest.assign(count, kNone);
        for (const Vec3d p : surface.positions) points_.push_back(frame_(p));
        for (const Triangle& c : surface.triangles) {
            const Vec3d twice = cross(points_[c[1]] - points_[c[0]], points_[c[2]] - points_[c[0]]);
            areas_.push_back(length(twice) / 2);
            normals_.push_back(normalised(twice));
        }
        match(frame_.scale * reach);
    }

    WallSides find() {
        make_patches();
        choose_sides();
        for (uint32_t t = 0; t < patch_.size(); ++t)
            if (patch_[t] != kNone) found_.side[t] = side_of_patch_[patch_[t]];
        spread();
        return std::move(found_);
    }

 private:
    Vec3d point(uint32_t t, size_t k) const { return points_[surface_.triangles[t][k]]; }
    uint32_t count() const { return static_cast<uint32_t>(areas_.size()); }

    // Distance from o along m to the plane of t inside its borders, or far.
    double distance_to(uint32_t t, Vec3d o, Vec3d m, double far) const {
        const Vec3d a = point(t, 0) - o, b = point(t, 1) - o, c = point(t, 2) - o;
        const double u = dot(m, cross(b, c)), v = dot(m, cross(c, a)), w = dot(m, cross(a, b));
        if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) return far;
        const double slope = dot(normals_[t], m);
        if (slope == 0) return far;
        const double d = dot(normals_[t], a) / slope;
        return d > 0 && d < far ? d : far;
    }

    void match(double reach) {
        std::vector<Vec3> floats;
        for (const Vec3d p : points_) floats.push_back(p.to_float());
        const RayScene rays(floats, surface_.triangles);
        struct Context {
            const Finder* finder;
            uint32_t triangle;
        };
        const auto ignore = [](uint32_t other, const void* pointer) {
            const auto* c = static_cast<const Context*>(pointer);
            const Surface& s = c->finder->surface_;
            const uint32_t one = s.component_of[c->triangle], two = s.component_of[other];
            return c->triangle == other || !s.components[two].is_closed || s.are_independent(one, two) ||
                   (one != two && s.components[one].is_cavity == s.components[two].is_cavity);
        };
        std::array<uint32_t, kMostHits> hits;
        for (uint32_t t = 0; t < count(); ++t) {
            if (!surface_.components[surface_.component_of[t]].is_closed) continue;
            const Vec3d o = (1.0 / 3) * (point(t, 0) + point(t, 1) + point(t, 2)), m = -normals_[t];
            const Context context{this, t};
            const size_t n =
                rays.collect(o.to_float(), m.to_float(), static_cast<float>(reach), kRaySlack, ignore, &context, hits);
            double least = reach;
            uint32_t first = kNone;
            for (size_t k = 0; k < n; ++k) {
                const double d = distance_to(hits[k], o, m, reach);
                if (d < least || (d < reach && d == least && hits[k] < first)) least = d, first = hits[k];
            }
            if (first == kNone || dot(normals_[first], normals_[t]) > kLooksBack) continue;
            found_.opposite[t] = first;
        }
    }

    // Matched triangles that hang together without a sharp edge between them.
    void make_patches() {
        patch_.assign(count(), kNone);
        std::vector<uint32_t> waiting;
        for (uint32_t seed = 0; seed < count(); ++seed) {
            if (found_.opposite[seed] == kNone || patch_[seed] != kNone) continue;
            patch_[seed] = patches_;
            waiting.assign(1, seed);
            while (!waiting.empty()) {
                const uint32_t t = waiting.back();
                waiting.pop_back();
                for (const uint32_t u : surface_.neighbours[t])
                    if (u != kNone && patch_[u] == kNone && found_.opposite[u] != kNone &&
                        dot(normals_[t], normals_[u]) > kSmooth) {
                        patch_[u] = patches_;
                        waiting.push_back(u);
                    }
            }
            ++patches_;
        }
    }

    struct Tie {
        double weight;
        uint32_t a, b;
    };
    static std::vector<Tie> heaviest_first(const std::map<std::pair<uint32_t, uint32_t>, double>& weights) {
        std::vector<Tie> ties;
        for (const auto& [pair, weight] : weights) ties.push_back({weight, pair.first, pair.second});
        std::sort(ties.begin(), ties.end(), [](const Tie& p, const Tie& q) {
            return p.weight != q.weight ? p.weight > q.weight : p.a != q.a ? p.a < q.a : p.b < q.b;
        });
        return ties;
    }

    // Patches across a wall are on different sides, patches along an edge on the same one. The heaviest ties are kept,
    // those of walls before those of edges; one that contradicts them is dropped.
    void choose_sides() {
        std::map<std::pair<uint32_t, uint32_t>, double> across, along;
        for (uint32_t t = 0; t < count(); ++t) {
            if (patch_[t] == kNone) continue;
            const uint32_t other = patch_[found_.opposite[t]];
            if (other != kNone && other != patch_[t]) across[std::minmax(patch_[t], other)] += areas_[t];
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t u = surface_.neighbours[t][k];
                if (u == kNone || patch_[u] == kNone || patch_[u] == patch_[t]) continue;
                along[std::minmax(patch_[t], patch_[u])] += length(point(t, (k + 1) % 3) - point(t, k));
            }
        }
        std::vector<uint32_t> parent(patches_), parity(patches_);
        for (uint32_t p = 0; p < patches_; ++p) parent[p] = p;
        const auto root = [&](uint32_t p) {
            uint32_t turns = 0;
            while (parent[p] != p) turns ^= parity[p], p = parent[p];
            return std::pair<uint32_t, uint32_t>(p, turns);
        };
        const auto tie = [&](const Tie& t, uint32_t differs) {
            const auto [a, a_turns] = root(t.a);
            const auto [b, b_turns] = root(t.b);
            if (a == b) return;
            parent[std::max(a, b)] = std::min(a, b);
            parity[std::max(a, b)] = a_turns ^ b_turns ^ differs;
        };
        for (const Tie& t : heaviest_first(across)) tie(t, 1);
        for (const Tie& t : heaviest_first(along)) tie(t, 0);
        for (uint32_t p = 0; p < patches_; ++p)
            side_of_patch_.push_back(root(p).second != 0 ? WallSide::Other : WallSide::One);
    }

    // What is unmatched takes the side that alone it touches; between both it is lip.
    void spread() {
        std::vector<uint32_t> ring;
        for (uint32_t t = 0; t < count(); ++t)
            if (found_.opposite[t] != kNone) ring.push_back(t);
        while (!ring.empty()) {
            std::vector<uint32_t> next;
            for (const uint32_t t : ring)
                for (const uint32_t u : surface_.neighbours[t]) {
                    if (u == kNone || found_.opposite[u] != kNone || found_.nearest[u] != kNone) continue;
                    found_.nearest[u] = found_.opposite[t] != kNone ? t : found_.nearest[t];
                    next.push_back(u);
                }
            ring.swap(next);
        }
        std::vector<uint8_t> is_done(count());
        for (uint32_t seed = 0; seed < count(); ++seed) {
            if (is_done[seed] || found_.opposite[seed] != kNone) continue;
            std::vector<uint32_t> region(1, seed);
            bool touches[3] = {};
            is_done[seed] = 1;
            for (size_t k = 0; k < region.size(); ++k)
                for (const uint32_t u : surface_.neighbours[region[k]]) {
                    if (u == kNone) continue;
                    if (found_.opposite[u] != kNone) touches[static_cast<size_t>(found_.side[u])] = true;
                    if (is_done[u] || found_.opposite[u] != kNone) continue;
                    is_done[u] = 1;
                    region.push_back(u);
                }
            const bool is_between = touches[1] && touches[2];
            for (const uint32_t t : region) {
                found_.is_lip[t] = is_between;
                if (found_.nearest[t] != kNone) found_.side[t] = found_.side[found_.nearest[t]];
            }
        }
    }

    const Surface& surface_;
    LocalFrame frame_;
    std::vector<Vec3d> points_, normals_;
    std::vector<double> areas_;
    std::vector<uint32_t> patch_;
    uint32_t patches_ = 0;
    std::vector<WallSide> side_of_patch_;
    WallSides found_;
};

}  // namespace

WallSides find_wall_sides(const Surface& surface, double reach) {
    return Finder(surface, reach).find();
}

}  // namespace cullet
