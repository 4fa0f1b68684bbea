#include "engine/bullet/overlap_axis.hpp"

namespace cullet::bullet {
namespace {

struct WorldEdge {
    Vec3d at, along, left, right;  // a point, the direction, the normals of both faces
};

WorldEdge world_edge(const Hull& hull, const Mat3& rotation, uint32_t number) {
    const HullEdge e = hull.edge[number];
    const Vec3d at(hull.world[e.a]);
    return {at, Vec3d(hull.world[e.b]) - at, Vec3d(rotation * hull.face_normal[e.left]),
            Vec3d(rotation * hull.face_normal[e.right])};
}

// The arcs a.left-a.right and (-b.left)-(-b.right) cross: only then do the two edges make a face of the Minkowski
// difference.
bool arcs_cross(const WorldEdge& a, const WorldEdge& b) {
    const Vec3d c = -b.left, d = -b.right;
    const Vec3d ba = cross(a.right, a.left), dc = cross(d, c);
    const double cba = dot(c, ba), dba = dot(d, ba), adc = dot(a.left, dc), bdc = dot(a.right, dc);
    return cba * dba < 0 && adc * bdc < 0 && cba * bdc > 0;
}

void try_axis(OverlapAxis& best, Vec3d axis, double gap) {
    // An axis must be better by a micrometre, so that faces win over edges that tie with them.
    if (best.is_found && gap <= best.gap + 1e-6) return;
    best = {true, axis, gap};
}

}  // namespace

OverlapAxis overlap_axis(const Hull& a, const Mat3& rotation_a, const Hull& b, const Mat3& rotation_b) {
    OverlapAxis best;
    for (uint32_t f = 0; f < b.face_count; ++f) {
        const Vec3d axis(rotation_b * b.face_normal[f]);
        if (dot(axis, axis) > 0.5) try_axis(best, axis, gap_along(a.world, b.world, axis));
    }
    if (b.one_sided && best.is_found) return best;
    for (uint32_t f = 0; f < a.face_count; ++f) {
        const Vec3d axis = -Vec3d(rotation_a * a.face_normal[f]);
        if (dot(axis, axis) > 0.5) try_axis(best, axis, gap_along(a.world, b.world, axis));
    }
    if (a.one_sided && a.face_count > 0) {
        const Vec3d axis = -Vec3d(rotation_a * a.face_normal[0]);
        return {true, axis, gap_along(a.world, b.world, axis)};
    }
    const Vec3d offset = Vec3d(b.world.centre) - Vec3d(a.world.centre);
    for (uint32_t i = 0; i < a.edge_count; ++i) {
        const WorldEdge p = world_edge(a, rotation_a, i);
        for (uint32_t j = 0; j < b.edge_count; ++j) {
            const WorldEdge q = world_edge(b, rotation_b, j);
            if (!arcs_cross(p, q)) continue;
            Vec3d axis = cross(p.along, q.along);
            const double square = dot(axis, axis);
            if (square < 1e-6 * dot(p.along, p.along) * dot(q.along, q.along))
                continue;  // parallel within 0.06 degrees
            axis = (1 / std::sqrt(square)) * axis;
            // Outwards from a is away from a's centre; from b towards a is the other way.
            if (dot(axis, p.left + p.right) > 0) axis = -axis;
            try_axis(best, axis, dot(axis, p.at - (q.at + offset)));
        }
    }
    return best;
}

}  // namespace cullet::bullet
