// Contacts of two pieces at the crack along which they were one.
//
// Hulls about the teeth of a crack lie in each other when they are born, and an axis of least overlap of theirs leads
// anywhere: out of a shell rather than out of the crack. Until they are farther apart than contacts reach they meet at
// places of the crack itself, for a quarter of a second at most: then what still is deep in another hull is pushed out.
#pragma once
#include <LinearMath/btTransform.h>

#include <span>
#include <vector>

#include "engine/bullet/contact_patch.hpp"
#include "engine/rigid_world.hpp"

namespace cullet::bullet {

/// Places that were one point of both. In the hull frames of the bodies.
struct CrackContact {
    uint32_t count = 0;
    Vec3 on_a[kPatchPoints], on_b[kPatchPoints];
    Vec3 normal[kPatchPoints];       // unit, from b towards a, frame of b
    Vec3 normal_of_a[kPatchPoints];  // the same, frame of a
    float reach[kPatchPoints];       // m that one may slide beside the other and still face it
    float seconds = 0;               // that are left of it
    CrackContact* next = nullptr;
};

/// Touches near both hulls, as many as `near` has room for, but for those of edges so short that they have no normal.
/// World points of the hulls must be fresh.
void find_near(const Hull& a, const Hull& b, std::span<const CrackTouch> touches, std::vector<const CrackTouch*>& near);
/// Of these touches those that lie farthest apart, none of none. `at_a` and `at_b` are where the hull frames stand.
/// With `is_turned` the touches' normals lead from a towards b.
CrackContact crack_contact(std::span<const CrackTouch* const> near, const btTransform& at_a, const btTransform& at_b,
                           bool is_turned);
/// Those of its places that still face each other, of two pieces of this scale. The normal of the patch is that of its
/// first point.
Patch crack_patch(const CrackContact& contact, const btTransform& at_a, const btTransform& at_b, float scale);

}  // namespace cullet::bullet
