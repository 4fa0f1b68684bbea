#include "sample_game/block_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace cullet {
namespace {

constexpr double kFlat = 1e-9;         // of 1 - cosine: faces are flat to rounding or not at all
constexpr double kShake = 0.18;        // of the shortest edge, as on lathes
constexpr double kLeastOfArea = 0.35;  // of each triangle's area that a shake leaves

double squared(Vec3d a, Vec3d b) {
    return dot(a - b, a - b);
}

class Skin {
 public:
    explicit Skin(const Blocks& blocks) : blocks_(blocks) {}

    MeshDraft make() {
        for (int k = blocks_.low[2]; k < blocks_.high[2]; ++k)
            for (int j = blocks_.low[1]; j < blocks_.high[1]; ++j)
                for (int i = blocks_.low[0]; i < blocks_.high[0]; ++i)
                    if (is_full({i, j, k})) add_cell({i, j, k});
        return std::move(surface_);
    }

 private:
    bool is_full(const GridNode& cell) const {
        for (size_t a = 0; a < 3; ++a)
            if (cell[a] < blocks_.low[a] || cell[a] >= blocks_.high[a]) return false;
        return blocks_.is_full(cell[0], cell[1], cell[2]);
    }

    void add_cell(const GridNode& cell) {
        for (size_t axis = 0; axis < 3; ++axis)
            for (const int side : {0, 1}) {
                GridNode beside = cell;
                beside[axis] += side == 1 ? 1 : -1;
                if (!is_full(beside)) add_square(cell, axis, side);
            }
    }

    void add_square(const GridNode& cell, size_t axis, int side) {
        const size_t u = (axis + 1) % 3, w = (axis + 2) % 3;
        std::array<uint32_t, 4> corners{};
        for (size_t c = 0; c < 4; ++c) {
            GridNode node = cell;
            node[axis] += side;
            node[u] += c == 1 || c == 2;
            node[w] += c >= 2;
            corners[c] = vertex(node);
        }
        if (side == 0) std::swap(corners[1], corners[3]);
        const auto& p = surface_.points;
        const auto [a, b, c, d] = corners;
        if (squared(p[a], p[c]) <= squared(p[b], p[d])) {
            surface_.triangles.push_back({a, b, c});
            surface_.triangles.push_back({a, c, d});
        } else {
            surface_.triangles.push_back({a, b, d});
            surface_.triangles.push_back({b, c, d});
        }
    }

    uint32_t vertex(const GridNode& node) {
        const auto [place, is_new] = vertices_.try_emplace(node, static_cast<uint32_t>(surface_.points.size()));
        if (is_new) surface_.points.push_back(blocks_.place(node));
        return place->second;
    }

    const Blocks& blocks_;
    std::map<GridNode, uint32_t> vertices_;
    MeshDraft surface_;
};

Vec3d area_vector(const MeshDraft& s, const Triangle& t) {
    return cross(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]]);
}

}  // namespace

MeshDraft surface_of(const Blocks& blocks) {
    return Skin(blocks).make();
}

void shake_flat_faces(MeshDraft& surface, uint64_t seed) {
    std::vector<std::vector<uint32_t>> round(surface.points.size());
    for (uint32_t t = 0; t < surface.triangles.size(); ++t)
        for (const uint32_t v : surface.triangles[t]) round[v].push_back(t);
    for (uint32_t v = 0; v < surface.points.size(); ++v) {
        const Vec3d normal = normalised(area_vector(surface, surface.triangles[round[v][0]]));
        bool is_flat = true;
        double shortest = 1e300;
        for (const uint32_t t : round[v]) {
            is_flat = is_flat && dot(normal, normalised(area_vector(surface, surface.triangles[t]))) > 1 - kFlat;
            for (const uint32_t w : surface.triangles[t])
                if (w != v) shortest = std::min(shortest, length(surface.points[w] - surface.points[v]));
        }
        if (!is_flat) continue;
        Vec3d step{jitter(seed, v, 0, 0), jitter(seed, v, 0, 1), jitter(seed, v, 0, 2)};
        step = (kShake * shortest) * (step - dot(step, normal) * normal);
        // Floors and walls along the axes stay where they are to the last bit.
        if (std::fabs(normal.x) > 1 - kFlat) step.x = 0;
        if (std::fabs(normal.y) > 1 - kFlat) step.y = 0;
        if (std::fabs(normal.z) > 1 - kFlat) step.z = 0;
        const Vec3d before = surface.points[v];
        std::vector<double> areas;
        for (const uint32_t t : round[v]) areas.push_back(dot(normal, area_vector(surface, surface.triangles[t])));
        surface.points[v] = before + step;
        for (size_t n = 0; n < areas.size(); ++n)
            if (dot(normal, area_vector(surface, surface.triangles[round[v][n]])) < kLeastOfArea * areas[n]) {
                surface.points[v] = before;
                break;
            }
    }
}

}  // namespace cullet
