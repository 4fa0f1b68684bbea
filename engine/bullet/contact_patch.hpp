// Contact points of two convex pieces: the whole patch at once, from nothing but this step's poses. (Bullet's own
// algorithm adds one point a step to a cache; a body that is held would then not come back to the same bits.)
#pragma once
#include "engine/bullet/hull.hpp"

namespace cullet::bullet {

inline constexpr int kPatchPoints = 4;  // what Bullet's cache holds

struct PatchPoint {
    Vec3 on_a, on_b;  // world, on the surfaces with their margins
    float distance;   // m, negative when they overlap
    Vec3 normal;      // world, unit, from b towards a
};

struct Patch {
    int count = 0;
    Vec3 normal;  // of all points, but where a crack has several
    // The direction leads out of one of the two through a seam: the touch may be the neighbouring piece's affair.
    bool is_through_seam = false;
    // Where the two are nearest to each other, while their cores are apart and not both boxes. The points of a patch
    // along a slant normal may all lie beside it, far down a side.
    bool has_nearest = false;
    Vec3 nearest_on_a, nearest_on_b;  // world, on the surfaces with their margins
    float room = 0;  // m that the two may move against each other before they have a contact; 0 when they have
    PatchPoint point[kPatchPoints];
};

/// World points of both hulls must be fresh. `guess` is last step's axis for these two (`is_own_guess`), or one
/// borrowed from a neighbour, or zero; it becomes this step's.
Patch contact_patch(const Hull& a, const Mat3& rotation_a, const Hull& b, const Mat3& rotation_b, Vec3& guess,
                    bool is_own_guess);

/// The points of the two where a normal from b towards a is given: none where no part of one lies over the other.
Patch patch_along(const Hull& a, const Mat3& rotation_a, const Hull& b, const Mat3& rotation_b, Vec3 normal);

/// The gap between the grown hulls (cores less both margins), bounded from below once above `enough`; -1 when the cores
/// overlap.
float separation(const Hull& a, const Hull& b, Vec3& guess, float enough);

}  // namespace cullet::bullet
