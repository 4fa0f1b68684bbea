#include "systems/models/lattice/solve/principal_stress.hpp"

#include <algorithm>

namespace cullet {
namespace {

// The largest root of 4 c^3 - 3 c = r lies in [1/2, 1]; with c = 1/2 + e it is e^2 (6 + 4 e) = r + 1, whose slope does
// not vanish in e where two values meet.
double above_half(double r) {
    const double s = std::sqrt((r + 1) / 6);
    double e = s * (1 - 0.232 * s);
    for (int k = 0; k < 4 && e > 0; ++k) e -= (e * e * (1 + e * (2.0 / 3)) - s * s) / (2 * e * (1 + e));
    return e;
}

// Bad where two values are as good as equal: then any direction across the third's is one.
Vec3d across_rows(const Sym3d& m, double value, double& square) {
    const Vec3d rows[3] = {{m.xx - value, m.xy, m.xz}, {m.xy, m.yy - value, m.yz}, {m.xz, m.yz, m.zz - value}};
    Vec3d best;
    square = 0;
    for (int i = 0; i < 3; ++i) {
        const Vec3d c = cross(rows[i], rows[(i + 1) % 3]);
        if (dot(c, c) > square) square = dot(c, c), best = c;
    }
    return best;
}

Vec3d any_across(Vec3d a) {
    const double x = std::fabs(a.x), y = std::fabs(a.y), z = std::fabs(a.z);
    return normalised(cross(a, x <= y && x <= z ? Vec3d{1, 0, 0} : y <= z ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1}));
}

}  // namespace

PrincipalStress principal_stress(const Sym3d& s) {
    const double mean = (s.xx + s.yy + s.zz) / 3;
    const Sym3d d{s.xx - mean, s.yy - mean, s.zz - mean, s.xy, s.xz, s.yz};
    const double half = 0.5 * (d.xx * d.xx + d.yy * d.yy + d.zz * d.zz) + d.xy * d.xy + d.xz * d.xz + d.yz * d.yz;
    const double q = std::sqrt(half / 3);
    if (!(q > 0)) return {mean, mean, mean};
    const double r = std::clamp(determinant(d) / (2 * (q * q * q)), -1.0, 1.0);
    // For r < 0 it is the smallest value that stands alone: that of the opposite tensor is found, and turned.
    const double c = 0.5 + above_half(std::fabs(r));
    const double alone = 2 * c,
                 spread = std::sqrt(std::max(0.0, 3 * (1 - c * c)));  // 2 q cos and the other two: -c +- spread
    if (r >= 0) return {mean + q * alone, mean + q * (spread - c), mean - q * (spread + c)};
    return {mean + q * (spread + c), mean + q * (c - spread), mean - q * alone};
}

Vec3d first_direction(const Sym3d& s, const PrincipalStress& p) {
    constexpr double kEqual = 1e-6;  // of the largest difference of two values
    double square = 0;
    Vec3d way;
    if (p.first - p.second > kEqual * (p.first - p.third)) {
        way = across_rows(s, p.first, square);
    } else {
        const Vec3d third = across_rows(s, p.third, square);
        way = square > 0 ? any_across(third) : Vec3d{1, 0, 0};
    }
    way = normalised(way);
    if (!(dot(way, way) > 0)) way = {1, 0, 0};
    const double lead = std::fabs(way.x) > 1e-6 ? way.x : std::fabs(way.y) > 1e-6 ? way.y : way.z;
    return lead < 0 ? -way : way;
}

}  // namespace cullet
