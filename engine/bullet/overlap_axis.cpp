#include "engine/bullet/overlap_axis.hpp"

namespace cullet::bullet {
namespace {

// Two edges make a face of the Minkowski difference where the arcs between the normals of their faces cross on the
// Gauss sphere, b's mirrored. An arc crosses a plane where its ends lie on both sides: so all there is to know is on
// which side of the planes of its arcs the other hull's normals lie, a bit each. What float gets wrong near zero is
// harmless: an axis is measured from support points, and one lost has a face beside it that is as good.
using Sides = uint64_t;
static_assert(kMaxFaces <= 64);

/// Normals of a hull in world axes, by column.
struct Normals {
    float x[kMaxFaces], y[kMaxFaces], z[kMaxFaces];
    uint32_t count;
    Vec3 operator[](uint32_t f) const { return {x[f], y[f], z[f]}; }
};

void turn_normals(const Hull& hull, const Mat3& rotation, Normals& out) {
    out.count = hull.face_count;
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        const Vec3 n = rotation * hull.face_normal[f];
        out.x[f] = n.x, out.y[f] = n.y, out.z[f] = n.z;
    }
}

// For each edge the normals of the other hull above the plane of its arc.
void find_sides(const Hull& hull, const Normals& own, const Normals& other, Sides* sides) {
    for (uint32_t e = 0; e < hull.edge_count; ++e) {
        const Vec3 plane = cross(own[hull.edge[e].right], own[hull.edge[e].left]);
        Sides above = 0;
        for (uint32_t f = 0; f < other.count; ++f)
            above |= Sides{plane.x * other.x[f] + plane.y * other.y[f] + plane.z * other.z[f] > 0} << f;
        sides[e] = above;
    }
}

struct Search {
    const Hull &a, &b;
    Vec3d before;
    double turning;
    OverlapAxis best;
    double best_score = -1e30;

    // An axis must be better by a micrometre, so that faces win over edges that tie with them.
    double score_of(Vec3d axis, double gap) const {
        return dot(before, before) > 0 ? gap - turning * (1 - dot(axis, before)) : gap;
    }
    bool is_better(Vec3d axis, double gap) const { return !best.is_found || score_of(axis, gap) > best_score + 1e-6; }
    void try_axis(Vec3d axis, double gap) {
        if (!is_better(axis, gap)) return;
        best = {true, axis, gap};
        best_score = score_of(axis, gap);
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
    Normals normals_a, normals_b;
    Sides sides_a[kMaxEdges], sides_b[kMaxEdges];
    turn_normals(a, rotation_a, normals_a);
    turn_normals(b, rotation_b, normals_b);
    find_sides(a, normals_a, normals_b, sides_a);
    find_sides(b, normals_b, normals_a, sides_b);
    uint32_t outer_b[kMaxEdges], count_b = 0;
    for (uint32_t j = 0; j < b.edge_count; ++j)
        if (is_outer(b, b.edge[j])) outer_b[count_b++] = j;
    for (uint32_t i = 0; i < a.edge_count; ++i) {
        const HullEdge p = a.edge[i];
        if (!is_outer(a, p)) continue;
        for (uint32_t k = 0; k < count_b; ++k) {
            const HullEdge q = b.edge[outer_b[k]];
            // b's normals count mirrored; the plane of its arc stays what it is.
            const Sides left_b = ~sides_a[i] >> q.left, right_b = ~sides_a[i] >> q.right;
            const Sides left_a = sides_b[outer_b[k]] >> p.left, right_a = sides_b[outer_b[k]] >> p.right;
            if (!((left_b ^ right_b) & (left_a ^ right_a) & ~(left_b ^ right_a) & 1)) continue;
            const Vec3d along_a = Vec3d(a.world[p.b]) - Vec3d(a.world[p.a]);
            const Vec3d along_b = Vec3d(b.world[q.b]) - Vec3d(b.world[q.a]);
            Vec3d axis = cross(along_a, along_b);
            const double square = dot(axis, axis);
            if (square < 1e-6 * dot(along_a, along_a) * dot(along_b, along_b))
                continue;  // parallel within 0.06 degrees
            axis = (1 / std::sqrt(square)) * axis;
            // Outwards from a is away from a's centre; from b towards a is the other way.
            if (dot(axis, Vec3d(normals_a[p.left] + normals_a[p.right])) > 0) axis = -axis;
            const Vec3d offset = Vec3d(b.world.centre) - Vec3d(a.world.centre);
            const double gap = dot(axis, Vec3d(a.world[p.a]) - (Vec3d(b.world[q.a]) + offset));
            if (is_better(axis, gap)) try_axis(axis, gap_along(a.world, b.world, axis));
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
