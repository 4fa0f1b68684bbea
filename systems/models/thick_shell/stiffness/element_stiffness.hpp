// Stiffness terms of single triangles and hinges, in double.
#pragma once
#include "components/shell_rows.hpp"
#include "systems/cook/materials.hpp"
#include "systems/models/thick_shell/stiffness/grain_stiffness.hpp"

namespace cullet {

/// Plane stress: sigma_xx = c11 xx + c12 yy, sigma_yy = c12 xx + c11 yy, sigma_xy = c33 gamma. Of a material with a
/// grain `grain` alone counts.
struct PlaneStress {
    double c11 = 0, c12 = 0, c33 = 0;  // Pa
    bool has_grain = false;
    GrainModuli grain{};
};
inline PlaneStress plane_stress(Tables<const Materials, const MaterialTraits, const Structures> state,
                                Row<Structures> shell) {
    const Row<Materials> material = state.structures.material[shell];
    const double e = state.materials.young_modulus[material], nu = state.materials.poisson_ratio[material];
    const TraitsRow traits = material_traits({state.materials, state.material_traits}, material);
    if (traits.has_grain())
        return {0, 0, 0, true, {e, traits.across_young_modulus, traits.shear_modulus, nu, Vec3d(traits.grain)}};
    const double c = e / (1 - nu * nu);
    return {c, nu * c, 0.5 * (1 - nu) * c};
}

/// What one triangle does to forces, unscaled.
struct TriangleTerms {
    Vec3d x, y;                 // axes in the plane
    double g[3][2];             // gradient of each corner's shape function, 1/m
    double volume;              // area * h, m3
    const PlaneStress& stress;  // Pa; the caller's, which is more than the rest of a triangle
    PlaneStiffness full;        // in x, y; of a material with a grain

    TriangleTerms(const TriangleSprings& springs, uint32_t row, const PlaneStress& c)
        : x(springs.axis_x[row]),
          y(springs.axis_y[row]),
          volume(double{springs.area[row]} * springs.thickness[row]),
          stress(c) {
        const Vec3 i = springs.inverse_edges[row];
        g[1][0] = i.x, g[1][1] = i.y;
        g[2][0] = 0, g[2][1] = i.z;
        g[0][0] = -g[1][0], g[0][1] = -(g[1][1] + g[2][1]);
        if (stress.has_grain) full = grain_stiffness(stress.grain, x, y);
    }
    double trace(int i) const {
        if (!stress.has_grain) return isotropic_trace(i);
        const double a = g[i][0], b = g[i][1];
        return volume *
               ((full.c11 + full.c66) * a * a + (full.c22 + full.c66) * b * b + 2 * (full.c16 + full.c26) * a * b);
    }
    double isotropic_trace(int i) const {
        return volume * (stress.c11 + stress.c33) * (g[i][0] * g[i][0] + g[i][1] * g[i][1]);
    }
    /// Adds s * d f_i / d u_j = -s A h B_i^T C B_j to k, by rows.
    void add_block(int i, int j, double s, double* k) const {
        const double a = g[i][0], b = g[i][1], c = g[j][0], d = g[j][1], f = -s * volume;
        double xx = f * (stress.c11 * a * c + stress.c33 * b * d);
        double xy = f * (stress.c12 * a * d + stress.c33 * b * c);
        double yx = f * (stress.c12 * b * c + stress.c33 * a * d);
        double yy = f * (stress.c11 * b * d + stress.c33 * a * c);
        if (stress.has_grain) {
            const double bix[3] = {a, 0, b}, biy[3] = {0, b, a}, bjx[3] = {c, 0, d}, bjy[3] = {0, d, c};
            xx = f * full.product(bix, bjx), xy = f * full.product(bix, bjy);
            yx = f * full.product(biy, bjx), yy = f * full.product(biy, bjy);
        }
        const double p[3] = {x.x, x.y, x.z}, q[3] = {y.x, y.y, y.z};
        for (int r = 0; r < 3; ++r) {
            const double to_x = p[r] * xx + q[r] * yx, to_y = p[r] * xy + q[r] * yy;
            for (int t = 0; t < 3; ++t) k[3 * r + t] += to_x * p[t] + to_y * q[t];
        }
    }
};

inline double hinge_trace(const Hinges& hinges, uint32_t row, int i) {
    const auto& g = hinges.gradient[row];
    const double x = g[3 * i], y = g[3 * i + 1], z = g[3 * i + 2];
    return hinges.stiffness[row] * (x * x + y * y + z * z);
}

}  // namespace cullet
