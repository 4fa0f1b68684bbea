// Convex hulls by brute force: what the choice of hull points is measured with.
#pragma once
#include <algorithm>
#include <vector>

#include "engine/random.hpp"
#include "sample_game/mesh_gap.hpp"

namespace cullet {

/// The faces of a convex hull as triangles, with outward planes.
struct HullFaces {
    std::vector<Corners> triangles;
    std::vector<Vec3d> normal;
    std::vector<double> height;
};

/// Every triple with all other points on one side is a face. Points are shaken by 1e-7 m first, so that no four lie in
/// a plane. O(n^4).
inline HullFaces hull_faces(std::vector<Vec3d> p) {
    const Random random{5};
    for (uint32_t i = 0; i < p.size(); ++i)
        p[i] = p[i] + 1e-7 * Vec3d(random.uniform(i, 0), random.uniform(i, 1), random.uniform(i, 2));
    HullFaces hull;
    for (size_t i = 0; i < p.size(); ++i)
        for (size_t j = i + 1; j < p.size(); ++j)
            for (size_t k = j + 1; k < p.size(); ++k) {
                Vec3d n = normalised(cross(p[j] - p[i], p[k] - p[i]));
                bool is_above = false, is_below = false;
                for (size_t l = 0; l < p.size() && !(is_above && is_below); ++l) {
                    if (l == i || l == j || l == k) continue;
                    (dot(n, p[l] - p[i]) > 0 ? is_above : is_below) = true;
                }
                if (is_above && is_below) continue;
                if (is_above) n = -n;
                hull.triangles.push_back({p[i], p[j], p[k]});
                hull.normal.push_back(n);
                hull.height.push_back(dot(n, p[i]));
            }
    return hull;
}

/// How far a point lies above the highest face plane: negative inside, where it is the distance to the surface.
inline double plane_gap(const HullFaces& hull, Vec3d point) {
    double most = -1e30;
    for (size_t f = 0; f < hull.normal.size(); ++f) most = std::max(most, dot(hull.normal[f], point) - hull.height[f]);
    return most;
}

/// Distance to the hull, negative inside.
inline double hull_gap(const HullFaces& hull, Vec3d point) {
    const double above = plane_gap(hull, point);
    if (above <= 0 || hull.normal.empty()) return above;
    double least = 1e30;
    for (const Corners& t : hull.triangles) least = std::min(least, point_gap(point, t));
    return least;
}

}  // namespace cullet
