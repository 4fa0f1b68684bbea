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

struct Search {
    const Hull &a, &b;
    Vec3d before;
    double turning;
    OverlapAxis best;
    double best_score = -1e30;

    // An axis must be better by a micrometre, so that faces win over edges that tie with them.
    void try_axis(Vec3d axis, double gap) {
        const bool is_new = !(dot(before, before) > 0);
        const double score = is_new ? gap : gap - turning * (1 - dot(axis, before));
        if (best.is_found && score <= best_score + 1e-6) return;
        best = {true, axis, gap};
        best_score = score;
    }
    void try_face(Vec3d axis) {
        if (dot(axis, axis) > 0.5) try_axis(axis, gap_along(a.world, b.world, axis));
    }
    void try_edges(const Mat3& rotation_a, const Mat3& rotation_b);
};

bool is_outer(const Hull& hull, const HullEdge& e) {
    return !hull.is_face_inner[e.left] && !hull.is_face_inner[e.right];
}

void Search::try_edges(const Mat3& rotation_a, const Mat3& rotation_b) {
    const Vec3d offset = Vec3d(b.world.centre) - Vec3d(a.world.centre);
    WorldEdge edges_b[kMaxEdges];
    uint32_t count_b = 0;
    for (uint32_t j = 0; j < b.edge_count; ++j)
        if (is_outer(b, b.edge[j])) edges_b[count_b++] = world_edge(b, rotation_b, j);
    for (uint32_t i = 0; i < a.edge_count; ++i) {
        if (!is_outer(a, a.edge[i])) continue;
        const WorldEdge p = world_edge(a, rotation_a, i);
        for (uint32_t j = 0; j < count_b; ++j) {
            const WorldEdge& q = edges_b[j];
            if (!arcs_cross(p, q)) continue;
            Vec3d axis = cross(p.along, q.along);
            const double square = dot(axis, axis);
            if (square < 1e-6 * dot(p.along, p.along) * dot(q.along, q.along))
                continue;  // parallel within 0.06 degrees
            axis = (1 / std::sqrt(square)) * axis;
            // Outwards from a is away from a's centre; from b towards a is the other way.
            if (dot(axis, p.left + p.right) > 0) axis = -axis;
            try_axis(axis, dot(axis, p.at - (q.at + offset)));
        }
    }
}

}  // namespace

OverlapAxis overlap_axis(const Hull& a, const Mat3& rotation_a, const Hull& b, const Mat3& rotation_b, Vec3d before,
                         double turning) {
    Search search{a, b, before, turning, {}, -1e30};
    if (a.one_sided || b.one_sided) {
        const Vec3d axis = b.one_sided ? Vec3d(rotation_b * b.face_normal[0]) : -Vec3d(rotation_a * a.face_normal[0]);
        search.try_face(axis);
        return search.best;
    }
    // Two pieces that both have nothing but seams offer those after all.
    for (const bool with_inner : {false, true}) {
        for (uint32_t f = 0; f < b.face_count; ++f)
            if (with_inner || !b.is_face_inner[f]) search.try_face(Vec3d(rotation_b * b.face_normal[f]));
        for (uint32_t f = 0; f < a.face_count; ++f)
            if (with_inner || !a.is_face_inner[f]) search.try_face(-Vec3d(rotation_a * a.face_normal[f]));
        if (search.best.is_found) break;
    }
    search.try_edges(rotation_a, rotation_b);
    return search.best;
}

}  // namespace cullet::bullet
