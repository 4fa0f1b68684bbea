// Where a piece of debris meets what is larger. It is a ball that stands against faces pushed out by its radius, so
// that it stops up to 0.7 radii early at a sharp edge. Nobody sees that of debris, and it takes no search for the
// closest point.
#include <algorithm>

#include "engine/bullet/bullet_world.hpp"
#include "engine/bullet/sides.hpp"

namespace cullet::bullet {
namespace {

// m between it and what it has met, or its next step would begin in it: at most a tenth of its radius.
constexpr float kClear = 2e-4f;
// m that it may be in something and is still pushed out of it. Of what the game moves or what sleeps, beyond its
// radius; of what moves by forces at all, at most a third of it: debris is born among pieces that it overlaps, which
// must not throw it. Of a static piece it is always pushed out: below a floor it would fall for ever.
constexpr float kDeepest = 0.01f, kDeepestInFree = 0.001f;

struct Way {
    Vec3 from, along;
    float radius, deepest;
};

/// A convex piece, all in its own axes (Cyrus and Beck 1978). `share` is what was found so far, and beaten to count.
bool meets_hull(const Hull& hull, const Way& way, float& share, Vec3& normal, float& depth) {
    float enters = -1, leaves = 1, least_deep = -kFar;
    uint32_t face = 0, out = 0;
    const Vec3 start = way.from - hull.local.centre;
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        const float before = dot(hull.face_normal[f], start) - hull.face_height[f] - hull.margin - way.radius;
        const float going = dot(hull.face_normal[f], way.along), after = before + going;
        if (before > 0) {
            if (after >= 0) return false;
            const float at = before / -going;
            if (at > enters) enters = at, face = f;
        } else {
            if (after > 0) leaves = std::min(leaves, -before / going);
            if (!hull.is_face_inner[f] && before > least_deep) least_deep = before, out = f;
        }
    }
    if (enters >= 0) {
        if (enters > leaves || enters >= share || hull.is_face_inner[face]) return false;
        share = enters, normal = hull.face_normal[face], depth = 0;
        return true;
    }
    // It begins in it. What other pieces cover on all sides has no way out.
    if (least_deep == -kFar || -least_deep > way.deepest || share <= 0) return false;
    if (dot(hull.face_normal[out], way.along) > -least_deep) return false;  // on its way out
    share = 0, normal = hull.face_normal[out], depth = -least_deep;
    return true;
}

/// |from + t along - centre| = radii.
bool meets_ball(Vec3 centre, float radii, const Way& way, float& share, Vec3& normal, float& depth) {
    const Vec3 start = way.from - centre;
    const float square = dot(way.along, way.along), half = dot(start, way.along),
                over = dot(start, start) - radii * radii;
    if (half >= 0) return false;
    if (over <= 0) {
        const float distance = length(start);
        if (radii - distance > way.deepest || !(distance > 0) || share <= 0) return false;
        share = 0, normal = (1 / distance) * start, depth = radii - distance;
        return true;
    }
    const float root = half * half - square * over;
    if (!(root > 0) || !(square > 0)) return false;
    const float at = (-half - std::sqrt(root)) / square;
    if (at >= share) return false;
    share = at, normal = normalised(start + at * way.along), depth = 0;
    return true;
}

/// Seen along its normal, and a little beside it: what crosses an edge misses neither of its triangles.
bool is_over(const StaticTriangle& triangle, Vec3 front, Vec3 place) {
    const float beside = clearance_at(place);
    for (int k = 0; k < 3; ++k) {
        const Vec3 edge = triangle.corner[(k + 1) % 3] - triangle.corner[k];
        if (dot(cross(front, edge), place - triangle.corner[k]) < -beside * length(edge)) return false;
    }
    return true;
}

/// On the side that it comes from; from behind a one-sided triangle is not there. Faces that are pushed out leave a gap
/// over a ridge: what gets into it is stopped by its centre.
bool meets_triangle(const StaticTriangle& triangle, bool one_sided, const Way& way, float& share, Vec3& normal,
                    float& depth) {
    const Vec3* c = triangle.corner;
    const Vec3 front = normalised(cross(c[1] - c[0], c[2] - c[0]));
    const float side = !one_sided && dot(front, way.from - c[0]) < 0 ? -1.0f : 1.0f;
    const Vec3 n = side * front;
    const float going = dot(n, way.along), height = dot(n, way.from - c[0]), over = height - way.radius;
    if (!(going < 0) || over + going > 0 || -over > way.deepest) return false;
    const float at = std::max(0.0f, over / -going);
    if (at >= share) return false;
    if (is_over(triangle, front, way.from + at * way.along)) {
        share = at, normal = n, depth = std::max(0.0f, -over);
        return true;
    }
    const float across = height / -going;
    if (height < 0 || across >= share || !is_over(triangle, front, way.from + across * way.along)) return false;
    share = across, normal = n, depth = 0;
    return true;
}

}  // namespace

// The tree names bodies in no order to rely on: of equal shares the lower id counts.
bool BulletWorld::first_touch_of(bool of_static, Vec3 from, Vec3 to, float seconds, float radius, float least_reach,
                                 RigidTouch& out) const {
    Box box{from, from};
    include(box, to);
    box = grown(box, radius + farthest_way_);  // the tree holds bodies where they were before the step
    float share = 1;
    Vec3 normal, met_from;
    float depth = 0;
    RigidId met = kNoRigid;
    tree_.visit(box, [&](uint32_t id) {
        const Body& body = bodies_[id];
        const bool is_static = body.kind == RigidKind::Static;
        if (!body.is_used || body.is_soft || (!is_static && (of_static || body.reach < least_reach))) return;
        float nearest = 1, found_depth = 0;
        Vec3 found;
        bool is_met = false;
        const btTransform at = body.hulls_at(body.bullet->getWorldTransform());
        const Mat3 rotation = rotation_of(at);
        const Vec3 origin = from_bullet(at.getOrigin());
        // What moves has come from where the ball was that much nearer to it.
        const Vec3 start = from + seconds * body.moved_fraction * velocity_at(body, from);
        const float deepest = body.is_free() ? std::min(kDeepestInFree, radius / 3) : radius + kDeepest;
        const Way way{transposed_times(rotation, start - origin), transposed_times(rotation, to - start), radius,
                      is_static ? kFar : deepest};
        Box local{way.from, way.from};
        include(local, way.from + way.along);
        for (const Hull* hull = body.hulls; hull; hull = hull->next) {
            if (!overlap(hull->local_box, local, radius)) continue;
            if (hull->face_count > 0
                    ? meets_hull(*hull, way, nearest, found, found_depth)
                    : meets_ball(hull->local.centre, hull->margin + radius, way, nearest, found, found_depth))
                is_met = true;
        }
        found = rotation * found;
        if (body.mesh)
            visit_triangles(*body.mesh, box, [&](uint32_t t) {
                if (meets_triangle(body.mesh->triangles[t], body.mesh->one_sided, {from, to - from, radius, deepest},
                                   nearest, found, found_depth))
                    is_met = true;
            });
        if (!is_met || nearest > share || (nearest == share && id > met)) return;
        share = nearest, normal = found, depth = found_depth, met = id, met_from = start;
    });
    if (met == kNoRigid) return false;
    const Body& body = bodies_[met];
    const Vec3 place = met_from + share * (to - met_from) + (depth + std::min(kClear, 0.1f * radius)) * normal;
    const bool is_still = !body.is_free() && body.kind != RigidKind::Kinematic;
    out = {share, place, normal, velocity_at(body, place - radius * normal), is_still};
    return true;
}

// What moves and has come over it pushes it into nothing that stands: a press would drive it through the floor.
bool BulletWorld::first_touch(Vec3 from, Vec3 to, float seconds, float radius, float least_reach,
                              RigidTouch& out) const {
    if (!first_touch_of(false, from, to, seconds, radius, least_reach, out)) return false;
    RigidTouch stop;
    if (!out.is_still && first_touch_of(true, from, out.place, 0, radius, least_reach, stop)) out.place = stop.place;
    return true;
}

}  // namespace cullet::bullet
