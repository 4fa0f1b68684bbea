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

enum class Inertia : uint8_t { Least, Most };
/// The principal axis of least or most inertia, what of it is across `normal`, unit: of those that are within 60
/// degrees of across it.
Vec3d axis_across(const Sym3d& inertia, Vec3d normal, Inertia wanted);

}  // namespace cullet
