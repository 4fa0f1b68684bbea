// Directions to push along, thick shell note A1.
#include "systems/structures/shell/cook/extrusion_work.hpp"

namespace cullet {
namespace {

constexpr double kSeesFace = 0.05;                // cosine; a face seen flatter than this is not seen
constexpr double kWidestCone = 0.05233595624294;  // cosine of 87 degrees
constexpr size_t kMostForTriples = 20;            // faces; above, an iteration finds the cone

struct Cone {
    Vec3d axis;
    double cosine = -2;  // of the half-angle
};

void try_axis(const std::vector<Vec3d>& normals, Vec3d axis, Cone& best) {
    const double l = length(axis);
    if (!(l > 1e-12)) return;
    axis = (1 / l) * axis;
    double least = 2;
    for (const Vec3d n : normals) least = std::min(least, dot(n, axis));
    if (least > best.cosine) best = {axis, least};
}

// The smallest cone holding some unit vectors is spanned by two or three of them. For many vectors: step toward the
// worst one by 1/2, 1/3, ... (the error falls as one over the number of steps).
Cone smallest_cone(const std::vector<Vec3d>& normals) {
    Cone best;
    const size_t n = normals.size();
    if (n > kMostForTriples) {
        Vec3d axis = normals[0];
        for (int step = 2; step < 200; ++step) {
            Vec3d worst = normals[0];
            for (const Vec3d m : normals)
                if (dot(m, axis) < dot(worst, axis)) worst = m;
            axis = normalised(axis + (1.0 / step) * (worst - axis));
            try_axis(normals, axis, best);
        }
        return best;
    }
    for (size_t i = 0; i < n; ++i) {
        try_axis(normals, normals[i], best);
        for (size_t j = i + 1; j < n; ++j) {
            try_axis(normals, normals[i] + normals[j], best);
            for (size_t k = j + 1; k < n; ++k) {
                const Vec3d axis = cross(normals[j] - normals[i], normals[k] - normals[i]);
                try_axis(normals, axis, best);
                try_axis(normals, -axis, best);
            }
        }
    }
    return best;
}

// Angles at the corners of a triangle; the third from the sum.
std::array<double, 3> corner_angles(Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d ab = normalised(b - a), bc = normalised(c - b), ca = normalised(a - c);
    const double at_a = arc_cosine(-dot(ab, ca)), at_b = arc_cosine(-dot(ab, bc));
    return {at_a, at_b, std::max(0.0, 3.14159265358979323846 - at_a - at_b)};
}

}  // namespace

double least_facing(const ExtrusionWork& work, uint32_t v, Vec3d m) {
    double least = 1;
    for (const uint32_t t : work.ring[v]) least = std::min(least, -dot(work.normals[t], m));
    return least;
}

void choose_directions(ExtrusionWork& work, const InnerSkin* skin) {
    std::vector<Vec3d> sums(work.vertex_count());
    for (uint32_t t = 0; t < work.triangle_count(); ++t) {
        const Triangle& c = work.surface.triangles[t];
        const auto angles = corner_angles(work.points[c[0]], work.points[c[1]], work.points[c[2]]);
        const bool has_way = skin && dot(skin->into_the_wall[t], skin->into_the_wall[t]) > 0;
        const Vec3d outward = has_way ? -skin->into_the_wall[t] : work.normals[t];
        for (size_t k = 0; k < 3; ++k) sums[c[k]] += angles[k] * outward;
    }
    std::vector<Vec3d> normals;
    for (uint32_t v = 0; v < work.vertex_count(); ++v) {
        Vec3d m = -normalised(sums[v]);
        double facing = least_facing(work, v, m);
        if (facing <= kSeesFace || dot(m, m) == 0) {
            normals.clear();
            for (const uint32_t t : work.ring[v]) normals.push_back(work.normals[t]);
            const Cone cone = smallest_cone(normals);
            m = -cone.axis, facing = cone.cosine;
        }
        work.directions[v] = m;
        work.facing[v] = facing;
        work.is_frozen[v] = facing < kWidestCone || !work.surface.components[work.component_of_vertex[v]].is_orientable;
        work.statistics.frozen_vertices += work.is_frozen[v];
    }
}

}  // namespace cullet
