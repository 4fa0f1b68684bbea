// What soft bodies ask: who is near, and where is its surface.
#include <algorithm>

#include "engine/bullet/bullet_world.hpp"
#include "engine/bullet/sides.hpp"
#include "engine/rigid_allocations.hpp"

namespace cullet::bullet {
namespace {

constexpr float kFarIn = 0.05f;  // m past a triangle that still count as in it

/// Greatest distance of the point over the faces of a hull, both in the hull's axes; `inner` ones count when asked.
/// Below 0 inside. -kFar: no faces.
float face_distance(const Hull& hull, Vec3 point, bool with_inner, uint32_t& face) {
    float most = -kFar;
    const Vec3 from = point - hull.local.centre;
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        if (!with_inner && hull.is_face_inner[f]) continue;
        const float distance = dot(hull.face_normal[f], from) - hull.face_height[f] - hull.margin;
        if (distance > most) most = distance, face = f;
    }
    return most;
}

Vec3 closest_on_segment(Vec3 a, Vec3 b, Vec3 p) {
    const Vec3 along = b - a;
    const float square = dot(along, along), t = square > 0 ? dot(p - a, along) / square : 0;
    return a + std::clamp(t, 0.0f, 1.0f) * along;
}

/// Of a triangle seen from behind or from its front. False: the point is not above it, nor just below.
bool triangle_surface(const StaticTriangle& triangle, bool is_behind, Vec3 p, float reach, RigidSurface& out) {
    const Vec3 *c = triangle.corner, front = normalised(cross(c[1] - c[0], c[2] - c[0])),
               n = is_behind ? -front : front;
    const float height = dot(n, p - c[0]);
    if (!(dot(n, n) > 0) || height > reach || height < -kFarIn) return false;
    bool is_above = true;
    float nearest = kFar;
    Vec3 edge_point;
    for (int k = 0; k < 3; ++k) {
        const Vec3 a = c[k], b = c[(k + 1) % 3];
        if (dot(cross(front, b - a), p - a) >= 0) continue;
        is_above = false;
        const Vec3 on = closest_on_segment(a, b, p);
        const float square = dot(p - on, p - on);
        const bool is_sharp = is_behind ? triangle.is_edge_sharp_behind[k] : triangle.is_edge_sharp[k];
        if (!is_sharp || square >= nearest) continue;
        nearest = square;
        edge_point = on;
    }
    if (is_above) {
        out = {p - height * n, n, height};
        return true;
    }
    const float distance = std::sqrt(nearest);
    if (height < 0 || !(distance < reach) || !(distance > 0)) return false;
    out = {edge_point, (1 / distance) * (p - edge_point), distance};
    return true;
}

}  // namespace

// Whoever lies on it may lose its support, or gain it.
void BulletWorld::set_soft(RigidId id, bool is_soft) {
    if (!is_known(id) || bodies_[id].is_soft == is_soft) return;
    Body& body = bodies_[id];
    if (body.kind == RigidKind::Dynamic) {
        if (is_soft)
            hold(id);
        else
            release(id);
    }
    InsideRigidEngine guard(counts_.allocations);
    body.is_soft = is_soft;
    wake_touching(id);
    if (!is_soft) return;
    for (const SortedManifold& m : manifolds_)
        if (m.manifold && (m.a == id || m.b == id)) m.manifold->setNumContacts(0);
}

bool BulletWorld::may_meet(RigidId a, RigidId b) const {
    if (!is_known(a) || !is_known(b)) return false;
    return bodies_[a].meets_layer_of(bodies_[b]);
}

uint32_t BulletWorld::near_bodies(Vec3 low, Vec3 high, std::span<RigidId> out) const {
    uint32_t count = 0;
    for (RigidId id = 0; id < body_end_ && count < out.size(); ++id)
        if (bodies_[id].is_used && overlap(bodies_[id].shape.box, {low, high}, 0)) out[count++] = id;
    return count;
}

bool BulletWorld::nearest_surface(RigidId id, Vec3 point, float reach, RigidSurface& out, const Vec3* seen_from) const {
    if (!is_known(id)) return false;
    const Body& body = bodies_[id];
    const btTransform at = body.hulls_at(body.bullet->getWorldTransform());
    const Mat3 rotation = rotation_of(at);
    const Vec3 origin = from_bullet(at.getOrigin()), local = transposed_times(rotation, point - origin);
    const Box near = grown({point, point}, reach);
    const Hull* nearest = nullptr;
    float least = reach;
    uint32_t face = 0;
    for (const Hull* hull = body.hulls; hull; hull = hull->next) {
        if (hull->face_count == 0 || !overlap(hull->world_box, near, 0)) continue;
        uint32_t found = 0;
        const float distance = face_distance(*hull, local, true, found);
        if (distance >= least) continue;
        least = distance;
        nearest = hull;
        face = found;
    }
    if (nearest && least < 0 && nearest->is_face_inner[face]) {
        least = face_distance(*nearest, local, false, face);
        if (least <= -kFar) nearest = nullptr;
    }
    if (nearest) {
        const Vec3 n = rotation * nearest->face_normal[face];
        out = {point - least * n, n, least};
    }
    if (!body.mesh) return nearest != nullptr;
    bool is_found = nearest != nullptr;
    // Triangles stand in the world's axes, but for a shift (static_mesh.hpp).
    visit_triangles(*body.mesh, near, [&](uint32_t t) {
        RigidSurface surface;
        const StaticTriangle& triangle = body.mesh->triangles[t];
        const bool is_turned = !body.mesh->one_sided && is_behind(triangle, seen_from ? *seen_from : point);
        if (!triangle_surface(triangle, is_turned, point, reach, surface)) return;
        if (is_found && std::fabs(surface.distance) >= std::fabs(out.distance)) return;
        out = surface;
        is_found = true;
    });
    return is_found;
}

}  // namespace cullet::bullet
