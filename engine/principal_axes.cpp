#include "engine/principal_axes.hpp"

namespace cullet {
namespace {

// At most ten sweeps of three rotations: convergence is quadratic, six reach rounding for any 3 x 3 tensor.
constexpr int kSweeps = 10;
constexpr double kNegligible = 1e-17;  // rad: an angle that changes no double of a turned axis

// Golub and Van Loan 8.5: the rotation in the plane (p, q) that makes a[p][q] zero. False: there is nothing to turn.
bool rotate_plane(double a[3][3], double v[3][3], int p, int q) {
    if (!(std::fabs(a[p][q]) > kNegligible * std::fabs(a[q][q] - a[p][p]))) return false;
    const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
    const double t = (theta >= 0 ? 1.0 : -1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
    const double c = 1 / std::sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 3; ++k) {
        const double x = a[k][p], y = a[k][q];
        a[k][p] = c * x - s * y;
        a[k][q] = s * x + c * y;
    }
    for (int k = 0; k < 3; ++k) {
        const double x = a[p][k], y = a[q][k];
        a[p][k] = c * x - s * y;
        a[q][k] = s * x + c * y;
    }
    for (int k = 0; k < 3; ++k) {
        const double x = v[k][p], y = v[k][q];
        v[k][p] = c * x - s * y;
        v[k][q] = s * x + c * y;
    }
    a[p][q] = a[q][p] = 0;
    return true;
}

// Shepperd's method: the largest of the four squares is divided by. Columns of m are the rotated axes.
Quat quaternion(const double m[3][3]) {
    const double squares[4] = {1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
                               1 - m[0][0] - m[1][1] + m[2][2], 1 + m[0][0] + m[1][1] + m[2][2]};
    int best = 3;
    for (int k = 0; k < 3; ++k)
        if (squares[k] > squares[best]) best = k;
    const double wx = m[2][1] - m[1][2], wy = m[0][2] - m[2][0], wz = m[1][0] - m[0][1];
    const double xy = m[0][1] + m[1][0], xz = m[0][2] + m[2][0], yz = m[1][2] + m[2][1], s = squares[best];
    double q[4] = {wx, wy, wz, s};
    if (best == 0) q[0] = s, q[1] = xy, q[2] = xz, q[3] = wx;
    if (best == 1) q[0] = xy, q[1] = s, q[2] = yz, q[3] = wy;
    if (best == 2) q[0] = xz, q[1] = yz, q[2] = s, q[3] = wz;
    const double l = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return {static_cast<float>(q[0] / l), static_cast<float>(q[1] / l), static_cast<float>(q[2] / l),
            static_cast<float>(q[3] / l)};
}

}  // namespace

PrincipalAxes principal_axes(const Sym3d& i) {
    double a[3][3] = {{i.xx, i.xy, i.xz}, {i.xy, i.yy, i.yz}, {i.xz, i.yz, i.zz}};
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    bool has_turned = true;
    for (int sweep = 0; sweep < kSweeps && has_turned; ++sweep) {
        has_turned = rotate_plane(a, v, 0, 1);
        has_turned |= rotate_plane(a, v, 0, 2);
        has_turned |= rotate_plane(a, v, 1, 2);
    }
    const auto positive = [](double x) { return x > 0 ? x : 0.0; };
    return {{positive(a[0][0]), positive(a[1][1]), positive(a[2][2])}, quaternion(v)};
}

Vec3d axis_across(const Sym3d& inertia, Vec3d normal, Inertia wanted) {
    const PrincipalAxes principal = principal_axes(inertia);
    const double sign = wanted == Inertia::Most ? 1 : -1;
    const double rank[3] = {sign * principal.moments.x, sign * principal.moments.y, sign * principal.moments.z};
    const Vec3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vec3d best;
    double most = -1e300;
    for (int i = 0; i < 3; ++i) {
        const Vec3d axis(rotate(principal.axes, unit[i]));
        const Vec3d across = axis - dot(axis, normal) * normal;
        if (length(across) < 0.5 || rank[i] <= most) continue;
        most = rank[i];
        best = across;
    }
    return normalised(best);
}

}  // namespace cullet
