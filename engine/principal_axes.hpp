// Principal axes and moments of an inertia tensor.
#pragma once
#include "engine/math.hpp"

namespace cullet {

struct PrincipalAxes {
    Vec3d moments;  // kg m2, never negative
    Quat axes;      // principal frame -> frame of the tensor
};

/// Cyclic Jacobi rotations in double, a fixed number of sweeps: the same bits for the same tensor. A diagonal tensor
/// keeps its axes; equal moments keep whatever axes the rotations leave.
PrincipalAxes principal_axes(const Sym3d& inertia);

}  // namespace cullet
