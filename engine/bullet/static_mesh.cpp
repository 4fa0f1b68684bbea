#include "engine/bullet/static_mesh.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace cullet::bullet {
namespace {

using Triangle = std::array<uint32_t, 3>;

constexpr uint32_t kLeafTriangles = 4;
// A corner may stand this far in front of a face, in sizes of the part, and the part still counts as convex.
constexpr float kConvexTolerance = 1e-5f;

// Corners with equal coordinates are one corner.
std::vector<uint32_t> weld(std::span<const Vec3> positions) {
    const auto key = [&](uint32_t k) { return std::tuple(positions[k].x, positions[k].y, positions[k].z, k); };
    std::vector<uint32_t> order(positions.size()), welded(positions.size());
    for (uint32_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    for (size_t k = 0; k < order.size(); ++k) {
        const bool is_same = k > 0 && positions[order[k]] == positions[order[k - 1]];
        welded[order[k]] = is_same ? welded[order[k - 1]] : order[k];
    }
    return welded;
}

uint32_t find_root(std::vector<uint32_t>& parent, uint32_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
}

std::vector<std::vector<uint32_t>> connected_parts(size_t corner_count, const std::vector<Triangle>& triangles) {
    std::vector<uint32_t> parent(corner_count);
    for (uint32_t k = 0; k < corner_count; ++k) parent[k] = k;
    for (const Triangle& t : triangles)
        for (int k = 1; k < 3; ++k) {
            const uint32_t a = find_root(parent, t[0]), b = find_root(parent, t[k]);
            parent[std::max(a, b)] = std::min(a, b);
        }
    std::map<uint32_t, std::vector<uint32_t>> parts;
    for (uint32_t t = 0; t < triangles.size(); ++t) parts[find_root(parent, triangles[t][0])].push_back(t);
    std::vector<std::vector<uint32_t>> out;
    for (auto& [root, part] : parts) out.push_back(std::move(part));
    return out;
}

using EdgeOwners = std::map<std::pair<uint32_t, uint32_t>, uint32_t>;  // directed edge -> triangle

bool is_convex_solid(std::span<const Vec3> positions, const std::vector<Triangle>& triangles,
                     const std::vector<uint32_t>& part, const EdgeOwners& owners, std::vector<Vec3>& corners) {
    std::vector<uint32_t> used;
    for (const uint32_t t : part)
        for (int k = 0; k < 3; ++k) {
            used.push_back(triangles[t][k]);
            if (!owners.count({triangles[t][(k + 1) % 3], triangles[t][k]})) return false;
        }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    if (used.size() < 4 || used.size() > kMaxPoints) return false;
    Box box = empty_box();
    for (const uint32_t k : used) include(box, positions[k]);
    const float tolerance = kConvexTolerance * length(box.high - box.low);
    for (const uint32_t t : part) {
        const Vec3d a(positions[triangles[t][0]]), b(positions[triangles[t][1]]), c(positions[triangles[t][2]]);
        const Vec3d n = normalised(cross(b - a, c - a));
        for (const uint32_t k : used)
            if (dot(n, Vec3d(positions[k]) - a) > tolerance) return false;
    }
    for (const uint32_t k : used) corners.push_back(positions[k]);
    return true;
}

using EdgeSharers = std::multimap<std::pair<uint32_t, uint32_t>, uint32_t>;  // edge, lower corner first -> triangles

std::pair<uint32_t, uint32_t> edge_between(uint32_t a, uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

// An edge is sharp when it is open, or when the far corners of all its neighbours stand more than half a degree behind
// this triangle, or before it, seen from behind. How a neighbour is wound says nothing about where it stands.
StaticTriangle make_triangle(std::span<const Vec3> positions, const std::vector<Triangle>& triangles, uint32_t t,
                             const EdgeSharers& sharers) {
    StaticTriangle out{};
    const Triangle& corners = triangles[t];
    for (int k = 0; k < 3; ++k) out.corner[k] = positions[corners[k]];
    const Vec3d a(out.corner[0]), n = normalised(cross(Vec3d(out.corner[1]) - a, Vec3d(out.corner[2]) - a));
    for (int k = 0; k < 3; ++k) {
        out.is_edge_sharp[k] = out.is_edge_sharp_behind[k] = true;
        const auto [first, last] = sharers.equal_range(edge_between(corners[k], corners[(k + 1) % 3]));
        for (auto sharer = first; sharer != last; ++sharer) {
            if (sharer->second == t) continue;
            for (const uint32_t far : triangles[sharer->second]) {
                if (far == corners[k] || far == corners[(k + 1) % 3]) continue;
                const Vec3d away = Vec3d(positions[far]) - Vec3d(positions[corners[k]]);
                const double height = dot(n, away), flat = 0.009 * length(away);
                out.is_edge_sharp[k] = out.is_edge_sharp[k] && height < -flat;
                out.is_edge_sharp_behind[k] = out.is_edge_sharp_behind[k] && height > flat;
            }
        }
    }
    return out;
}

Box box_of(const StaticTriangle& t) {
    Box box = empty_box();
    for (const Vec3 c : t.corner) include(box, c);
    return box;
}

// Halves by the median of the centres along the longest side; ties by the order the triangles came in.
void build_node(StaticMesh& mesh, uint32_t node, uint32_t first, uint32_t count) {
    Box box = empty_box();
    for (uint32_t t = first; t < first + count; ++t)
        for (const Vec3 c : mesh.triangles[t].corner) include(box, c);
    mesh.nodes[node] = {box, first, count};
    if (count <= kLeafTriangles) return;
    const Vec3 size = box.high - box.low;
    const int side = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto centre = [side](const StaticTriangle& t) {
        const Box b = box_of(t);
        return side == 0 ? b.low.x + b.high.x : side == 1 ? b.low.y + b.high.y : b.low.z + b.high.z;
    };
    const auto begin = mesh.triangles.begin() + first;
    std::stable_sort(begin, begin + count,
                     [&](const StaticTriangle& p, const StaticTriangle& q) { return centre(p) < centre(q); });
    const auto child = static_cast<uint32_t>(mesh.nodes.size());
    mesh.nodes.resize(child + 2);
    mesh.nodes[node] = {box, child, 0};
    build_node(mesh, child, first, count / 2);
    build_node(mesh, child + 1, first + count / 2, count - count / 2);
}

}  // namespace

namespace {

// Lowest corner first, and with two sides that bear also without its winding: equal triangles are equal then.
Triangle name_of(Triangle t, bool one_sided) {
    if (!one_sided) {
        std::sort(t.begin(), t.end());
        return t;
    }
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

// Triangles with area, each once, with welded corners. A closed part that has a triangle twice is still closed.
std::vector<Triangle> keep_sound(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                 const std::vector<uint32_t>& welded, StaticMesh& mesh) {
    std::vector<Triangle> kept;
    std::set<Triangle> names;
    for (uint32_t k = 0; k < triangles.size(); ++k) {
        const Triangle& t = triangles[k];
        bool is_sound = t[0] < welded.size() && t[1] < welded.size() && t[2] < welded.size();
        if (is_sound) {
            const Triangle w{welded[t[0]], welded[t[1]], welded[t[2]]};
            const Vec3d a(positions[w[0]]);
            is_sound = length(cross(Vec3d(positions[w[1]]) - a, Vec3d(positions[w[2]]) - a)) > 0 &&
                       names.insert(name_of(w, mesh.one_sided)).second;
            if (is_sound) kept.push_back(w);
        }
        if (!is_sound && mesh.left_out++ == 0) mesh.first_left = k;
    }
    return kept;
}

}  // namespace

StaticMesh sort_static_triangles(std::span<const Vec3> positions, std::span<const std::array<uint32_t, 3>> triangles,
                                 bool one_sided) {
    StaticMesh mesh;
    mesh.one_sided = one_sided;
    const std::vector<uint32_t> welded = weld(positions);
    const std::vector<Triangle> kept = keep_sound(positions, triangles, welded, mesh);
    EdgeOwners owners;
    EdgeSharers sharers;
    for (uint32_t t = 0; t < kept.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            owners.insert({{kept[t][k], kept[t][(k + 1) % 3]}, t});
            sharers.insert({edge_between(kept[t][k], kept[t][(k + 1) % 3]), t});
        }
    for (const auto& part : connected_parts(positions.size(), kept)) {
        std::vector<Vec3> corners;
        if (is_convex_solid(positions, kept, part, owners, corners))
            mesh.solids.push_back(std::move(corners));
        else
            for (const uint32_t t : part) mesh.triangles.push_back(make_triangle(positions, kept, t, sharers));
    }
    if (mesh.triangles.empty()) return mesh;
    mesh.nodes.resize(1);
    build_node(mesh, 0, 0, static_cast<uint32_t>(mesh.triangles.size()));
    return mesh;
}

}  // namespace cullet::bullet
