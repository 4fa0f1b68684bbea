// What contact_patch() and box_patch() share: spots in the plane of a patch, of which four are chosen.
#pragma once
#include "engine/bullet/contact_patch.hpp"

namespace cullet::bullet {

/// The plane frame of a patch: origin at the centre of a, heights along the normal.
struct PatchFrame {
    Vec3 normal, right, forward;
};
PatchFrame make_frame(Vec3 normal);

/// Without values of its own: hundreds stand on the stack for each touch, of which few are used.
struct Spot {
    float x, y;           // in the plane
    float low_a, high_b;  // heights of the facing surfaces of the cores
};
inline float gap(const Spot& s) {
    return s.low_a - s.high_b;
}

/// At most four of the spots become points of the patch: those that hold best.
void add_best_spots(Patch& patch, const Hull& a, const Hull& b, const PatchFrame& frame, const Spot* spots,
                    uint32_t count);
/// Is a direction out of the hull one through a seam of it?
bool is_through_seam(const Hull& hull, const Mat3& rotation, Vec3 outwards);

}  // namespace cullet::bullet
