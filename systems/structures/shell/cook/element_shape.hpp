// When a prism element is sound: rule 2 of thick shell note A5.
#pragma once
#include "systems/structures/shell/cook/extrusion_work.hpp"
#include "systems/structures/shell/cook/tetrahedra.hpp"

namespace cullet {

inline constexpr double kLeastTurn = 0.2;  // cosine between the inner and the outer face
inline constexpr double kLeastShare =
    0.01;  // of the fair volume of a tetrahedron, area times mean depth over three. 0.05 costs
           // 0.5 to 2 % of the depth and traps corners, 0.001 gains nothing

/// Whether element t with these corner depths has an inner face that looks outward too and three tetrahedra of positive
/// volume. A corner at depth 0 excuses the tetrahedron it flattens.
inline bool is_sound(const ExtrusionWork& work, uint32_t t, const std::array<Vec3d, 3>& inner,
                     const std::array<double, 3>& depth) {
    const Triangle& c = work.surface.triangles[t];
    const double mean = (depth[0] + depth[1] + depth[2]) / 3;
    if (mean == 0) return true;
    const Vec3d normal = cross(inner[1] - inner[0], inner[2] - inner[0]);
    const double along = dot(normal, work.normals[t]);
    if (!(along > 0 && along * along >= kLeastTurn * kLeastTurn * dot(normal, normal))) return false;
    const PrismTetrahedra tets = prism_tetrahedra({work.points[c[0]], work.points[c[1]], work.points[c[2]]}, inner, c);
    const double least = kLeastShare * work.areas[t] * mean / 3;
    for (size_t k = 0; k < 3; ++k)
        if (depth[tets.flattens[k]] > 0 && !(tets.volume[k] >= least)) return false;
    return true;
}

}  // namespace cullet
