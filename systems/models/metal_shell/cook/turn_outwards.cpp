#include "systems/models/metal_shell/cook/turn_outwards.hpp"

#include <cmath>
#include <utility>

namespace cullet {
namespace {

constexpr double kBulges = 0.02;  // volume over area to the power of 3/2, of half a ball 0.1

/// A part's area and what it faces.
struct Part {
    double area = 0, around = 0;  // m2, m2 times m: sum of areas times place along the normal
    Vec3d first, facing;          // by area
};

Vec3d across(const Surface& surface, uint32_t t) {
    const Triangle& c = surface.triangles[t];
    const Vec3d p = surface.positions[c[0]];
    return 0.5 * cross(surface.positions[c[1]] - p, surface.positions[c[2]] - p);
}

bool faces_inwards(const Part& part, Vec3d middle) {
    if (!(part.area > 0)) return false;
    const double size = part.area * std::sqrt(part.area);
    // Seen from its own middle a part that bulges faces away from there, closed by nothing or not.
    const double bulge = (part.around - dot((1 / part.area) * part.first, part.facing)) / 3;
    if (std::fabs(bulge) > kBulges * size) return bulge < 0;
    return (part.around - dot(middle, part.facing)) / 3 < -kBulges * size;
}

// A normal of the mesh's own goes with the winding, unless it contradicted it.
void turn(Mesh& mesh, const Surface& surface, uint32_t t) {
    const uint32_t source = surface.source_triangles[t];
    const auto& corner = surface.source_corners[t];
    const auto& given = mesh.triangles[source];
    const std::array<uint32_t, 3> wanted{given[corner[0]], given[corner[2]], given[corner[1]]};
    const Vec3d out = -across(surface, t);
    std::array<Vec3, 3> normals;
    std::array<Vec2, 3> uvs;
    const std::array<size_t, 3> from{corner[0], corner[2], corner[1]};
    for (size_t k = 0; k < 3; ++k) {
        const size_t at = 3 * size_t{source} + from[k];
        if (!mesh.corner_normals.empty())
            normals[k] =
                dot(Vec3d(mesh.corner_normals[at]), out) < 0 ? -mesh.corner_normals[at] : mesh.corner_normals[at];
        if (!mesh.corner_uvs.empty()) uvs[k] = mesh.corner_uvs[at];
    }
    for (size_t k = 0; k < 3; ++k) {
        const size_t at = 3 * size_t{source} + k;
        if (!mesh.corner_normals.empty()) mesh.corner_normals[at] = normals[k];
        if (!mesh.corner_uvs.empty()) mesh.corner_uvs[at] = uvs[k];
    }
    mesh.triangles[source] = wanted;
}

}  // namespace

uint32_t turn_outwards(Mesh& mesh, const Surface& surface) {
    std::vector<Part> parts(surface.components.size());
    Vec3d sum;
    double area = 0;
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        Part& part = parts[surface.component_of[t]];
        const Vec3d facing = across(surface, t);
        const Triangle& c = surface.triangles[t];
        const Vec3d centroid =
            (1.0 / 3) * (surface.positions[c[0]] + surface.positions[c[1]] + surface.positions[c[2]]);
        const double own = length(facing);
        part.area += own, part.around += dot(centroid, facing);
        part.first += own * centroid, part.facing += facing;
        sum += own * centroid, area += own;
    }
    if (!(area > 0)) return 0;
    uint32_t turned = 0;
    std::vector<uint8_t> is_turned(parts.size());
    for (uint32_t p = 0; p < parts.size(); ++p) {
        const SurfaceComponent& component = surface.components[p];
        if (component.is_closed || !component.is_orientable) continue;
        is_turned[p] = faces_inwards(parts[p], (1 / area) * sum);
        turned += is_turned[p];
    }
    for (uint32_t t = 0; t < surface.triangles.size() && turned > 0; ++t)
        if (is_turned[surface.component_of[t]]) turn(mesh, surface, t);
    return turned;
}

}  // namespace cullet
