#include "systems/cook/crease_normals.hpp"
#include "systems/cook/disjoint_sets.hpp"

#include <algorithm>
#include <numeric>

namespace cullet {
namespace {

constexpr uint32_t kNoTriangle = ~0u;
constexpr double kPi = 3.14159265358979323846;

using Corners = std::span<const std::array<uint32_t, 3>>;

/// Angles at the corners of a triangle; the third from the sum.
std::array<double, 3> angles_of(Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d ab = normalised(b - a), bc = normalised(c - b), ca = normalised(a - c);
    const double at_a = arc_cosine(-dot(ab, ca)), at_b = arc_cosine(-dot(ab, bc));
    return {at_a, at_b, std::max(0.0, kPi - at_a - at_b)};
}

uint32_t corner_at(Corners corner, uint32_t triangle, uint32_t vertex) {
    const auto& c = corner[triangle];
    return 3 * triangle + (c[0] == vertex ? 0u : c[1] == vertex ? 1u : 2u);
}

}  // namespace

std::vector<Vec3> crease_normals(std::span<const Vec3d> position, Corners corner, Corners neighbour) {
    const auto count = static_cast<uint32_t>(corner.size());
    std::vector<Vec3d> flat(count), sum(3 * size_t{count});
    for (uint32_t t = 0; t < count; ++t) {
        const auto& c = corner[t];
        flat[t] = normalised(cross(position[c[1]] - position[c[0]], position[c[2]] - position[c[0]]));
    }
    DisjointSets groups(3 * size_t{count});
    for (uint32_t t = 0; t < count; ++t)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t other = neighbour[t][k], next = (k + 1) % 3;
            if (other == kNoTriangle || other < t || !(dot(flat[t], flat[other]) > kCreaseCosine)) continue;
            groups.unite(3 * t + k, corner_at(corner, other, corner[t][k]));
            groups.unite(3 * t + next, corner_at(corner, other, corner[t][next]));
        }
    for (uint32_t t = 0; t < count; ++t) {
        const auto& c = corner[t];
        const auto angles = angles_of(position[c[0]], position[c[1]], position[c[2]]);
        for (uint32_t k = 0; k < 3; ++k) sum[groups.find(3 * t + k)] += angles[k] * flat[t];
    }
    std::vector<Vec3> normals(3 * size_t{count});
    for (uint32_t c = 0; c < normals.size(); ++c) {
        Vec3d n = normalised(sum[groups.find(c)]);
        if (!(dot(n, n) > 0.5)) n = flat[c / 3];
        if (!(dot(n, n) > 0.5)) n = {0, 1, 0};
        normals[c] = n.to_float();
    }
    return normals;
}

void give_crease_normals(Mesh& mesh, const Surface& surface) {
    const std::vector<Vec3> normals = crease_normals(surface.positions, surface.triangles, surface.neighbours);
    mesh.corner_normals.assign(3 * mesh.triangles.size(), Vec3{0, 1, 0});
    for (size_t t = 0; t < surface.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k)
            mesh.corner_normals[3 * size_t{surface.source_triangles[t]} + surface.source_corners[t][k]] =
                normals[3 * t + k];
}

}  // namespace cullet
