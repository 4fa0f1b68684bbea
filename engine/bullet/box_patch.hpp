// Contact of two boxes that look at each other with a face: what bricks do, cheaper than any two hulls.
#pragma once
#include "engine/bullet/contact_patch.hpp"

namespace cullet::bullet {

/// Writes what contact_patch() would find and returns true when the face along which two boxes are farthest apart is
/// where they are nearest: nothing is left to search for then. False, with nothing written, for other shapes, for
/// corners and edges that meet, and where the cores overlap.
bool box_patch(const Hull& a, const Mat3& rotation_a, const Hull& b, const Mat3& rotation_b, Vec3& guess, Patch& patch);

}  // namespace cullet::bullet
