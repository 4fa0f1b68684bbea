#include "systems/models/thick_shell/springs/best_turn.hpp"

namespace cullet {
namespace {

constexpr int kSweeps = 12;  // off-diagonals fall quadratically; 6 reach 1e-16

void rotate_pair(double (&a)[4][4], double (&vectors)[4][4], int p, int q) {
    const double off = a[p][q];
    if (!(off < 0 || off > 0)) return;
    const double theta = (a[q][q] - a[p][p]) / (2 * off);
    const double t = (theta < 0 ? -1.0 : 1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
    const double c = 1 / std::sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 4; ++k) {
        const double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 4; ++k) {
        const double pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
    }
    for (int k = 0; k < 4; ++k) {
        const double kp = vectors[k][p], kq = vectors[k][q];
        vectors[k][p] = c * kp - s * kq, vectors[k][q] = s * kp + c * kq;
    }
}

}  // namespace

Quat best_turn(const double (&m)[3][3]) {
    double a[4][4] = {{m[0][0] + m[1][1] + m[2][2], m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]},
                      {0, m[0][0] - m[1][1] - m[2][2], m[0][1] + m[1][0], m[2][0] + m[0][2]},
                      {0, 0, m[1][1] - m[0][0] - m[2][2], m[1][2] + m[2][1]},
                      {0, 0, 0, m[2][2] - m[0][0] - m[1][1]}};
    double vectors[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) a[i][j] = a[j][i];
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (int p = 0; p < 4; ++p)
            for (int q = p + 1; q < 4; ++q) rotate_pair(a, vectors, p, q);
    int best = 0;
    for (int k = 1; k < 4; ++k)
        if (a[k][k] > a[best][best]) best = k;
    double w[4];
    for (int k = 0; k < 4; ++k) w[k] = (vectors[0][best] < 0 ? -1 : 1) * vectors[k][best];
    Quat turn{static_cast<float>(w[1]), static_cast<float>(w[2]), static_cast<float>(w[3]), static_cast<float>(w[0])};
    return normalised(turn);
}

}  // namespace cullet
