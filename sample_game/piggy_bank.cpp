#include <algorithm>
#include <cmath>

#include "sample_game/figure_tools.hpp"
#include "sample_game/meshes.hpp"

namespace cullet {
namespace {

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

}  // namespace

Mesh make_piggy_bank(float length, float edge, uint64_t seed) {
    const double scale = static_cast<double>(length),
                 wanted = std::clamp(usable_edge(static_cast<double>(edge) / scale, 1), 0.004, 0.1);
    // The seed moves the grid, and with it every vertex.
    const Vec3d shift{jitter(seed, 0, 0, 0), jitter(seed, 0, 0, 1), jitter(seed, 0, 0, 2)};
    const Figure figure{pig, Vec3d{-0.62, -0.13, -0.42} + (0.4 * wanted) * shift, {0.64, 0.76, 0.44}};
    MeshDraft surface = surface_of(pig, figure.low, figure.high, std::min(1.4 * wanted, 0.03));
    remesh(surface, kTargetPerMean * wanted, [&figure](Vec3d p) { return onto(figure, p); });
    stand(surface, scale);
    return to_mesh(surface, "piggy_bank");
}

}  // namespace cullet
