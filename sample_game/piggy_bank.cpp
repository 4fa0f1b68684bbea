#include <algorithm>
#include <cmath>

#include "sample_game/mesh_tools.hpp"
#include "sample_game/meshes.hpp"

namespace cullet {
namespace {

// The remesher settles at a mean edge 7 % above its target.
constexpr double kTargetPerMean = 0.935;

/// About the distance to an ellipsoid, negative inside: k (k - 1) / |grad k| with k = |p / r|. Exact on the surface,
/// where it counts.
double ellipsoid(Vec3d p, Vec3d centre, Vec3d r) {
    const Vec3d d = p - centre;
    const double k = length(Vec3d{d.x / r.x, d.y / r.y, d.z / r.z});
    const double slope = length(Vec3d{d.x / (r.x * r.x), d.y / (r.y * r.y), d.z / (r.z * r.z)});
    return slope > 0 ? k * (k - 1) / slope : -std::min(r.x, std::min(r.y, r.z));
}

/// Distance to a rod from a to b with round ends.
double rod(Vec3d p, Vec3d a, Vec3d b, double radius) {
    const Vec3d d = b - a;
    const double along = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
    return length(p - a - along * d) - radius;
}

/// Union with a fillet about `width` wide: the quadratic polynomial minimum.
double blend(double a, double b, double width) {
    const double h = std::max(width - std::fabs(a - b), 0.0) / width;
    return std::min(a, b) - 0.25 * h * h * width;
}

/// Under zero inside the pig; lengths in units of the pig's length, from the tail to the snout along x.
double pig(Vec3d p) {
    const Vec3d mirrored{p.x, p.y, std::fabs(p.z)};  // both sides at once
    double f = ellipsoid(p, {0, 0.34, 0}, {0.36, 0.255, 0.26});
    f = blend(f, ellipsoid(p, {0.29, 0.40, 0}, {0.165, 0.16, 0.17}), 0.08);
    f = blend(f, rod(p, {0.38, 0.385, 0}, {0.455, 0.38, 0}, 0.068), 0.04);
    f = blend(f, rod(mirrored, {-0.20, 0.20, 0.135}, {-0.21, 0.065, 0.145}, 0.066), 0.06);
    f = blend(f, rod(mirrored, {0.18, 0.20, 0.135}, {0.19, 0.065, 0.145}, 0.066), 0.06);
    f = blend(f, ellipsoid(mirrored, {0.25, 0.56, 0.105}, {0.034, 0.075, 0.055}), 0.035);
    return blend(f, rod(p, {-0.34, 0.42, 0}, {-0.41, 0.46, 0.01}, 0.034), 0.035);
}

Vec3d gradient(Vec3d p) {
    constexpr double h = 1e-4;
    return {(pig(p + Vec3d{h, 0, 0}) - pig(p - Vec3d{h, 0, 0})) / (2 * h),
            (pig(p + Vec3d{0, h, 0}) - pig(p - Vec3d{0, h, 0})) / (2 * h),
            (pig(p + Vec3d{0, 0, h}) - pig(p - Vec3d{0, 0, h})) / (2 * h)};
}

Vec3d onto_pig(Vec3d p) {
    for (int step = 0; step < 4; ++step) {
        const double f = pig(p);
        if (std::fabs(f) < 1e-6) break;  // a thousandth of a millimetre on half a metre
        const Vec3d g = gradient(p);
        p = p - (f / std::max(dot(g, g), 0.1)) * g;
    }
    return p;
}

}  // namespace

Mesh make_piggy_bank(float length, float edge, uint64_t seed) {
    const double scale = static_cast<double>(length),
                 wanted = std::clamp(usable_edge(static_cast<double>(edge) / scale, 1), 0.004, 0.1);
    // The seed moves the grid, and with it every vertex.
    const Vec3d shift{jitter(seed, 0, 0, 0), jitter(seed, 0, 0, 1), jitter(seed, 0, 0, 2)};
    const Vec3d low = Vec3d{-0.62, -0.13, -0.42} + (0.4 * wanted) * shift;
    MeshDraft surface = surface_of(pig, low, {0.64, 0.76, 0.44}, std::min(1.4 * wanted, 0.03));
    remesh(surface, kTargetPerMean * wanted, onto_pig);
    double front = -1e9, back = 1e9, foot = 1e9;
    for (const Vec3d p : surface.points) {
        front = std::max(front, p.x);
        back = std::min(back, p.x);
        foot = std::min(foot, p.y);
    }
    const Vec3d origin{(front + back) / 2, foot, 0};
    for (Vec3d& p : surface.points) p = (scale / (front - back)) * (p - origin);
    return to_mesh(surface, "piggy_bank");
}

}  // namespace cullet
