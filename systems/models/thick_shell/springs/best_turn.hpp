#pragma once
#include "engine/math.hpp"

namespace cullet {

/// The rotation that takes points r nearest to points x in the sense of least squares, from products[i][j] = sum m r_i
/// x_j about both centres. By Horn (1987) it is the eigenvector of largest eigenvalue of a symmetric 4 x 4 matrix, here
/// by Jacobi rotations, a fixed number of sweeps. Flat sheets are fine; points on a line leave the turn about it open,
/// all in one place any turn.
Quat best_turn(const double (&products)[3][3]);

}  // namespace cullet
