// Orthotropic plane stress: stiffness by the angle to the grain, for materials that have one.
#pragma once
#include <cmath>

#include "engine/math.hpp"

namespace cullet {

/// Engineering constants of a material that is the same in all directions across its grain.
struct GrainModuli {
    double along = 0, across = 0, shear = 0, poisson = 0;  // Pa, Pa, Pa, 1: contraction across for stretch along
    Vec3d grain;                                           // unit, body frame
};

/// sigma = C eps in some axes, eps = (xx, yy, gamma).
struct PlaneStiffness {
    double c11 = 0, c12 = 0, c16 = 0, c22 = 0, c26 = 0, c66 = 0;  // Pa

    /// a . C b
    double product(const double (&a)[3], const double (&b)[3]) const {
        return a[0] * (c11 * b[0] + c12 * b[1] + c16 * b[2]) + a[1] * (c12 * b[0] + c22 * b[1] + c26 * b[2]) +
               a[2] * (c16 * b[0] + c26 * b[1] + c66 * b[2]);
    }
};

/// In unit axes x, y of a plane. Compliances along and across the grain's projection come first. A plane that the grain
/// leaves at an angle has those of the tensor turned about the axis across (Lekhnitskii, Anisotropic Plates, 1968,
/// section 9). nu and the transverse shear are taken as those of the plane along and across. Then the turn in the
/// plane. A plane upright on the grain is isotropic with the modulus across.
inline PlaneStiffness grain_stiffness(const GrainModuli& m, Vec3d x, Vec3d y) {
    const double gx = dot(m.grain, x), gy = dot(m.grain, y);
    const double in_plane = gx * gx + gy * gy;  // squared cosine of the grain's angle to the plane
    const double p = in_plane > 1 ? 1 : in_plane, q = 1 - p;
    const double s11 = p * p / m.along + q * q / m.across + p * q * (1 / m.shear - 2 * m.poisson / m.along);
    const double s22 = 1 / m.across;
    const double s12 = -m.poisson * (p / m.along + q / m.across);
    const double s66 = p / m.shear + q * 2 * (1 + m.poisson) / m.across;
    const double d = s11 * s22 - s12 * s12;
    const double q11 = s22 / d, q22 = s11 / d, q12 = -s12 / d, q66 = 1 / s66;
    const double size = std::sqrt(in_plane);
    const double c = size > 1e-6 ? gx / size : 1, s = size > 1e-6 ? gy / size : 0;
    const double cc = c * c, ss = s * s, cs = c * s;
    const double a = q11 - q12 - 2 * q66, b = q12 - q22 + 2 * q66;
    PlaneStiffness k;
    k.c11 = q11 * cc * cc + 2 * (q12 + 2 * q66) * ss * cc + q22 * ss * ss;
    k.c22 = q11 * ss * ss + 2 * (q12 + 2 * q66) * ss * cc + q22 * cc * cc;
    k.c12 = (q11 + q22 - 4 * q66) * ss * cc + q12 * (ss * ss + cc * cc);
    k.c66 = (q11 + q22 - 2 * q12 - 2 * q66) * ss * cc + q66 * (ss * ss + cc * cc);
    k.c16 = a * cs * cc + b * cs * ss;
    k.c26 = a * cs * ss + b * cs * cc;
    return k;
}

}  // namespace cullet
