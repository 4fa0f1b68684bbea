// One convex piece as the bridge holds it: its points and its faces in Bullet's body frame, and its points in world
// axes as of the last refresh. The body that others meet is this core, grown by `margin` on all sides.
#pragma once
#include <cstdint>
#include <span>

#include "engine/bullet/lengths.hpp"
#include "engine/math.hpp"

namespace cullet::bullet {

inline constexpr uint32_t kMaxPoints = 32;                 // bits of a face's mask of points
inline constexpr uint32_t kMaxFaces = 2 * kMaxPoints - 4;  // Euler, all faces triangles
inline constexpr uint32_t kMaxEdges = 3 * kMaxPoints - 6;
inline constexpr uint32_t kMaxCorners = 2 * kMaxEdges;  // corners of all faces together
inline constexpr float kSeamRange = 0.01f;              // m between the spheres of two pieces that may cover faces

struct Box {
    Vec3 low, high;
};
inline bool overlap(const Box& a, const Box& b, float grown) {
    return a.low.x <= b.high.x + grown && b.low.x <= a.high.x + grown && a.low.y <= b.high.y + grown &&
           b.low.y <= a.high.y + grown && a.low.z <= b.high.z + grown && b.low.z <= a.high.z + grown;
}
inline void include(Box& box, Vec3 p) {
    box.low = {p.x < box.low.x ? p.x : box.low.x, p.y < box.low.y ? p.y : box.low.y, p.z < box.low.z ? p.z : box.low.z};
    box.high = {p.x > box.high.x ? p.x : box.high.x, p.y > box.high.y ? p.y : box.high.y,
                p.z > box.high.z ? p.z : box.high.z};
}
inline Box grown(const Box& box, float r) {
    return {box.low - Vec3{r, r, r}, box.high + Vec3{r, r, r}};
}
inline bool holds(const Box& box, const Box& inner) {
    return box.low.x <= inner.low.x && box.low.y <= inner.low.y && box.low.z <= inner.low.z &&
           box.high.x >= inner.high.x && box.high.y >= inner.high.y && box.high.z >= inner.high.z;
}
inline constexpr float kFar = 1e30f;
inline Box empty_box() {
    return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
}

/// At most 32 points about a centre, in some axes. `count` is a multiple of 8; the rest repeats the first point.
struct alignas(16) Points {
    Vec3 centre;
    uint32_t count = 0;
    float x[kMaxPoints], y[kMaxPoints], z[kMaxPoints];
    Vec3 operator[](uint32_t k) const { return {x[k], y[k], z[k]}; }  // from the centre
};

struct HullEdge {
    uint8_t a, b;         // points
    uint8_t left, right;  // faces
};

/// What walks over all pieces of a body read stands first, in two cache lines.
struct Hull {
    Hull* next = nullptr;  // of the same body, or free
    uint32_t cell = 0, ordinal = 0, point_count = 0, face_count = 0, edge_count = 0;
    float margin = 0;
    float radius = 0;        // of the points about their centre, without the margin
    float thickness = 0;     // the least width over its face normals, with both margins; a sphere's diameter
    float scale = 1;         // see lengths.hpp
    uint64_t flush = 0;      // faces, as bits, that go on in the plane of a face of a piece beside this one
    bool one_sided = false;  // a static triangle: only the face that it is built with pushes
    bool is_turned = false;  // that is its back
    bool has_seams = false;  // what others cover of it is known, see seams.hpp
    bool is_box = false;     // its core is one, with these
    Vec3 box_axis[3];        // outward normals of three faces, hull frame
    float box_half[3];       // m, from the centre
    Box world_box;           // with the margin
    Box local_box;           // with the margin
    Points local;            // hull frame of the body
    Points world;            // refreshed once a step while the body is awake
    Vec3 face_normal[kMaxFaces];
    float face_height[kMaxFaces];  // normal . point, from the centre
    // Seams between the pieces of one body: nothing is pushed out through what is inner. Of each face the places that
    // others cover, see mark_covered().
    bool is_face_inner[kMaxFaces];
    uint64_t covered[kMaxFaces];
    uint16_t first_corner[kMaxFaces + 1];
    uint8_t corner[kMaxCorners];
    uint32_t face_points[kMaxFaces];  // its corners as bits, by point
    HullEdge edge[kMaxEdges];
};

inline float scale_of(const Hull& hull) {
    return hull.scale;
}
inline float scale_of(const Hull& a, const Hull& b) {
    return std::min(scale_of(a), scale_of(b));
}

/// Fills everything but world columns and `next`. More than 32 points: the rest is left out. Points in a plane get the
/// two faces of their polygon; points on a line get none.
void build_hull(Hull& hull, std::span<const Vec3> points, float margin, uint32_t cell);
/// The same, of the points that `like` was made of, seen in other axes: `turn` takes a direction from its axes into
/// these. Corners and edges are copied and normals turned, which costs a tenth of finding them. `like` may be
/// the hull itself.
void build_hull_like(Hull& hull, const Hull& like, const Mat3& turn, std::span<const Vec3> points, float margin,
                     uint32_t cell);
/// A hull seen from `origin` and in axes that `turn` takes its old ones to: points, normals and bounds are turned where
/// they stand. World columns stay to be done.
void turn_hull(Hull& hull, const Mat3& turn, Vec3 origin, float margin, uint32_t cell);
/// A static triangle in world axes: one face, to the side that its corners run counter-clockwise around, or to the
/// other one.
void build_triangle(Hull& hull, const Vec3 (&corners)[3], uint32_t cell, bool is_turned = false);
/// Finds out whether the core is a box, from points and faces.
void find_box(Hull& hull);
/// Of its faces' corners.
void set_face_points(Hull& hull);
/// Of its local points.
void set_local_box(Hull& hull);
/// Of its margin and width; a static triangle is as good as thick. Contacts ask for it a dozen times each.
void set_scale(Hull& hull);
/// Marks what another piece of the same body covers of the faces of `hull`, and which lie in one plane with faces of a
/// piece that covers any: places just outside of their corners, of the middles of their edges, and of their own middle.
/// With `is_whole` a face is inner when all of them are covered, by whomever; else, once `other` covers one place, of
/// its further faces the middles alone are looked at. (The riser of a stair is covered in its
/// middle by the step before, if both stand on the ground, and is to be struck above.) Else its middle tells.
void mark_covered(Hull& hull, const Hull& other, bool is_whole = false);
/// Nothing is known to cover it.
void forget_covered(Hull& hull);
/// World points and box for a body at `position` with its axes along the columns of `rotation`.
void refresh_world(Hull& hull, const Mat3& rotation, Vec3 position);
/// World points only, into another column.
void transform_points(const Hull& hull, const Mat3& rotation, Vec3 position, Points& out);

}  // namespace cullet::bullet
