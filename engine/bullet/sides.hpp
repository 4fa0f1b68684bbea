// On which side of a static triangle a piece is. A piece is convex, so that no sheet passes through it: the side of one
// point in it is its side, whatever else of it has been pressed through. BulletWorld sees to it that no step, birth or
// spawn takes that point across (bring_back.cpp); so nothing needs to be remembered.
#pragma once
#include "engine/bullet/body.hpp"

namespace cullet::bullet {

/// The mean of the piece's points where its hull frame stands so: bit for bit the same wherever it is asked.
Vec3 inner_point(const Hull& hull, const Mat3& rotation, Vec3 origin);
inline Vec3 inner_point(const Hull& hull, const btTransform& hulls_at) {
    return inner_point(hull, rotation_of(hulls_at), from_bullet(hulls_at.getOrigin()));
}

/// The point lies behind the triangle: where its corners run clockwise.
bool is_behind(const StaticTriangle& triangle, Vec3 point);

/// Triangle t with its face towards `seen_from`; of a one-sided mesh its front.
void build_seen_triangle(Hull& hull, const StaticMesh& mesh, uint32_t t, uint32_t cell, Vec3 seen_from);

/// An odd number of other triangles of the mesh stand between a point and a place on triangle t: what is behind t there
/// is before the surface that t belongs to. A ridge's far side is so seen over the near one.
bool is_hidden(const StaticMesh& mesh, uint32_t t, Vec3 from, Vec3 place);

/// Where a way passes a triangle that bears on the side that it comes from.
struct Crossing {
    double share = 2;  // of the way, 0 to 1; 2: nowhere
    Vec3 normal;       // unit, to the side that it comes from
    float depth = 0;   // m that its end is to go back along the normal, so as to be clear of the triangle
};

/// The first one; of equal ones that of the lowest triangle. A way that ends nearer than `clear` m in front of a
/// triangle passes it, too, unless it led away from it.
Crossing first_crossing(const StaticMesh& mesh, Vec3 from, Vec3 to, float clear);

/// Where a sheet cuts a way: the plane of the triangle there, with its normal to the side that the way comes from.
struct Cut {
    Vec3 place, normal;
    bool bears = true, bears_back = true;  // against who comes so, and the other way round: one-sided sheets do one
};

/// The way from one place over another one to a third ends on the other side of a triangle, that it goes through; the
/// lowest one. A way that goes around the sheet, or comes back through it, is not cut.
bool find_cut(const StaticMesh& mesh, Vec3 from, Vec3 over, Vec3 to, Cut& cut);

/// m that inner points keep from triangles: more than what rounding moves them by at such a place, and much less than
/// half of the thinnest piece.
float clearance_at(Vec3 place);

}  // namespace cullet::bullet
