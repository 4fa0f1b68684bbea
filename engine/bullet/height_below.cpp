#include <algorithm>

#include "engine/bullet/bullet_world.hpp"

namespace cullet::bullet {
namespace {

// Height of a triangle at (x, z), or `fallback` when the vertical line misses it.
float height_of(const StaticTriangle& triangle, Vec3 p, float fallback) {
    const Vec3 a = triangle.corner[0], b = triangle.corner[1], c = triangle.corner[2];
    const float area = (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
    if (area == 0) return fallback;
    const float u = ((p.x - a.x) * (c.z - a.z) - (c.x - a.x) * (p.z - a.z)) / area;
    const float v = ((b.x - a.x) * (p.z - a.z) - (p.x - a.x) * (b.z - a.z)) / area;
    return u < 0 || v < 0 || u + v > 1 ? fallback : a.y + u * (b.y - a.y) + v * (c.y - a.y);
}

}  // namespace

// A convex part of static triangles counts as its bounds, which is exact for level boxes; all else that does not move
// is passed over: a pinned wall's crumb would rest in the air where the wall was. For crumbs, which come to rest on
// floors and tables.
float BulletWorld::height_below(Vec3 point, float fallback) const {
    float height = fallback;
    const auto raise = [&](float candidate) {
        if (candidate <= point.y) height = std::max(height, candidate);
    };
    for (RigidId id = 0; id < body_end_; ++id) {
        const Body& body = bodies_[id];
        if (!body.is_used || body.kind != RigidKind::Static || !body.is_level) continue;
        const Box& box = body.shape.box;
        if (point.x < box.low.x || point.x > box.high.x || point.z < box.low.z || point.z > box.high.z) continue;
        for (const Hull* hull = body.hulls; hull; hull = hull->next) {
            const Box& part = hull->world_box;
            if (point.x >= part.low.x && point.x <= part.high.x && point.z >= part.low.z && point.z <= part.high.z)
                raise(part.high.y);
        }
        if (!body.mesh) continue;
        visit_triangles(*body.mesh, {{point.x, -kFar, point.z}, point},
                        [&](uint32_t t) { raise(height_of(body.mesh->triangles[t], point, fallback)); });
    }
    return height;
}

}  // namespace cullet::bullet
