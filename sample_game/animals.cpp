// The animals of the paper's tables: a pig of 3,500 vertices and a cow of 3,000 vertices and 5,700 triangles.
#include <algorithm>
#include <cmath>

#include "sample_game/figure_tools.hpp"
#include "sample_game/meshes.hpp"

namespace cullet {
namespace {

/// Under zero inside; lengths in units of the animal's, from tail to snout along x, z mirrored.
double pig(Vec3d p) {
    const Vec3d m{p.x, p.y, std::fabs(p.z)};  // both sides at once
    double f = ellipsoid(p, {-0.02, 0.335, 0}, {0.335, 0.205, 0.195});
    f = blend(f, ellipsoid(p, {-0.20, 0.35, 0}, {0.17, 0.195, 0.185}), 0.08);               // haunches
    f = blend(f, ellipsoid(p, {0.29, 0.40, 0}, {0.145, 0.14, 0.135}), 0.09);                // head
    f = blend(f, tapered_rod(p, {0.36, 0.375, 0}, {0.475, 0.355, 0}, 0.075, 0.062), 0.04);  // snout
    for (const double x : {-0.235, 0.155}) {
        f = blend(f, tapered_rod(m, {x, 0.24, 0.105}, {x - 0.005, 0.115, 0.115}, 0.075, 0.045), 0.05);
        f = blend(f, rod(m, {x - 0.005, 0.13, 0.115}, {x + 0.005, 0.045, 0.117}, 0.043), 0.03);
    }
    f = blend(f, ellipsoid(m, {0.285, 0.535, 0.098}, {0.030, 0.078, 0.050}), 0.035);  // ears
    // The tail makes half a turn.
    f = blend(f, rod(p, {-0.360, 0.42, 0}, {-0.410, 0.45, 0.016}, 0.026), 0.035);
    f = blend(f, rod(p, {-0.410, 0.45, 0.016}, {-0.452, 0.505, -0.012}, 0.025), 0.015);
    return blend(f, rod(p, {-0.452, 0.505, -0.012}, {-0.425, 0.560, -0.040}, 0.025), 0.015);
}

double cow(Vec3d p) {
    const Vec3d m{p.x, p.y, std::fabs(p.z)};
    double f = ellipsoid(p, {-0.05, 0.43, 0}, {0.315, 0.165, 0.15});
    f = blend(f, ellipsoid(p, {-0.245, 0.455, 0}, {0.13, 0.145, 0.135}), 0.08);             // haunches
    f = blend(f, ellipsoid(p, {0.14, 0.445, 0}, {0.13, 0.15, 0.13}), 0.08);                 // shoulders
    f = blend(f, tapered_rod(p, {0.17, 0.49, 0}, {0.315, 0.60, 0}, 0.105, 0.08), 0.07);     // neck
    f = blend(f, ellipsoid(p, {0.345, 0.615, 0}, {0.095, 0.085, 0.078}), 0.04);             // head
    f = blend(f, tapered_rod(p, {0.375, 0.59, 0}, {0.458, 0.535, 0}, 0.064, 0.053), 0.04);  // muzzle
    for (const double x : {-0.265, 0.135}) {
        f = blend(f, tapered_rod(m, {x, 0.38, 0.085}, {x - 0.008, 0.215, 0.092}, 0.072, 0.040), 0.06);
        f = blend(f, tapered_rod(m, {x - 0.008, 0.215, 0.092}, {x, 0.06, 0.092}, 0.037, 0.034), 0.03);
        f = blend(f, rod(m, {x, 0.06, 0.092}, {x + 0.006, 0.038, 0.092}, 0.038), 0.02);  // hoof
    }
    f = blend(f, ellipsoid(p, {-0.165, 0.275, 0}, {0.075, 0.055, 0.065}), 0.05);     // udder
    f = blend(f, ellipsoid(m, {0.300, 0.635, 0.118}, {0.026, 0.030, 0.062}), 0.03);  // ears
    // Horns and tail are as thick as their triangles allow: an edge is 0.019 at 3,000 vertices.
    f = blend(f, tapered_rod(m, {0.318, 0.680, 0.045}, {0.318, 0.728, 0.104}, 0.036, 0.033), 0.025);
    f = blend(f, tapered_rod(m, {0.318, 0.728, 0.104}, {0.345, 0.800, 0.118}, 0.033, 0.029), 0.015);
    f = blend(f, rod(p, {-0.345, 0.545, 0}, {-0.420, 0.52, 0}, 0.029), 0.03);  // tail
    f = blend(f, rod(p, {-0.420, 0.52, 0}, {-0.447, 0.32, 0}, 0.028), 0.02);
    return blend(f, ellipsoid(p, {-0.450, 0.275, 0}, {0.038, 0.070, 0.038}), 0.02);
}

}  // namespace

Mesh make_pig(float length, uint32_t vertices, uint64_t seed) {
    MeshDraft surface = figure_of({pig, {-0.60, -0.13, -0.36}, {0.66, 0.74, 0.37}}, vertices, seed);
    stand(surface, static_cast<double>(length));
    return to_mesh(surface, "pig");
}

Mesh make_cow(float length, uint32_t vertices, uint64_t seed) {
    const size_t places = std::max<size_t>(vertices, 500) * 2852 / 3000;
    MeshDraft surface = figure_of({cow, {-0.62, -0.13, -0.36}, {0.66, 0.95, 0.37}}, places, seed);
    // Along the back and belly, and round the head: a seam has about 200 edges at 3,000 vertices.
    open_seam(surface, vertices, [](Vec3d p) { return (p.z > 0) != (p.x > 0.25); });
    stand(surface, static_cast<double>(length));
    return to_mesh(surface, "cow");
}

}  // namespace cullet
