#include "engine/bullet/sides.hpp"

#include <algorithm>
#include <tuple>

namespace cullet::bullet {
namespace {

constexpr float kClear = 1e-5f;        // m; a sheet of 0.2 mm has its middle at ten times that
constexpr float kRounding = 2.5e-7f;   // of a coordinate: two steps of a float
constexpr double kBesideEdges = 1e-5;  // m past its edges that a triangle reaches: ways through an edge pass neither
constexpr double kBesideShare = 1e-6;  // of its size, the same

constexpr float kInto = 0.05f;  // of the way to a place on a triangle, that is looked at beside it

double height_over(const StaticTriangle& triangle, Vec3d normal, Vec3 point) {
    return dot(normal, Vec3d(point) - Vec3d(triangle.corner[0]));
}

Vec3d normal_of(const StaticTriangle& triangle) {
    const Vec3d a(triangle.corner[0]);
    return normalised(cross(Vec3d(triangle.corner[1]) - a, Vec3d(triangle.corner[2]) - a));
}

bool is_over(const StaticTriangle& triangle, Vec3d normal, Vec3d place) {
    for (int k = 0; k < 3; ++k) {
        const Vec3d from(triangle.corner[k]), edge = Vec3d(triangle.corner[(k + 1) % 3]) - from;
        const double size = length(edge), inside = dot(cross(normal, edge), place - from);
        if (inside < -size * (kBesideEdges + kBesideShare * size)) return false;
    }
    return true;
}

void try_triangle(const StaticTriangle& triangle, bool one_sided, Vec3 from, Vec3 to, double clear, Crossing& first) {
    const Vec3d normal = normal_of(triangle);
    const double start = height_over(triangle, normal, from), end = height_over(triangle, normal, to);
    const double side = start < 0 ? -1 : 1, before = side * start, after = side * end;
    if ((one_sided && side < 0) || after >= clear || after >= before) return;
    const double share = after < 0 ? before / (before - after) : 1;
    if (share >= first.share || !is_over(triangle, normal, Vec3d(from) + share * (Vec3d(to) - Vec3d(from)))) return;
    first = {share, (side * normal).to_float(), static_cast<float>(clear - after)};
}

// On which side of an edge, between corners seen from `from`, a way passes. A way through the edge itself passes as one
// that is turned by next to nothing, along x first: always the same, so that of two triangles at an edge, or of a fan
// about a corner, one is crossed. The other way round every value is the negative to the last bit.
bool is_left_of(Vec3d way, Vec3d a, Vec3d b) {
    const Vec3d side = cross(a, b);
    for (const double turned : {dot(way, side), side.x, side.y, side.z})
        if (turned != 0) return turned < 0;
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// The line through both places goes through the triangle.
bool is_on_line(const StaticTriangle& triangle, Vec3d from, Vec3d to) {
    const Vec3d a = Vec3d(triangle.corner[0]) - from, b = Vec3d(triangle.corner[1]) - from,
                c = Vec3d(triangle.corner[2]) - from, way = to - from;
    const bool ab = is_left_of(way, a, b), bc = is_left_of(way, b, c), ca = is_left_of(way, c, a);
    return ab == bc && bc == ca;
}

bool is_crossed(const StaticTriangle& triangle, Vec3 from, Vec3 to) {
    const Vec3d normal = normal_of(triangle);
    const bool starts_behind = height_over(triangle, normal, from) < 0,
               ends_behind = height_over(triangle, normal, to) < 0;
    return starts_behind != ends_behind && is_on_line(triangle, Vec3d(from), Vec3d(to));
}

}  // namespace

Vec3 inner_point(const Hull& hull, const Mat3& rotation, Vec3 origin) {
    const Points& p = hull.local;
    float x = 0, y = 0, z = 0;
    for (uint32_t k = 0; k < hull.point_count; ++k) x += p.x[k], y += p.y[k], z += p.z[k];
    const float share = 1 / static_cast<float>(std::max(hull.point_count, 1u));
    return origin + rotation * (p.centre + share * Vec3{x, y, z});
}

bool is_behind(const StaticTriangle& triangle, Vec3 point) {
    return height_over(triangle, normal_of(triangle), point) < 0;
}

void build_seen_triangle(Hull& hull, const StaticMesh& mesh, uint32_t t, uint32_t cell, Vec3 seen_from) {
    const StaticTriangle& triangle = mesh.triangles[t];
    build_triangle(hull, triangle.corner, cell, !mesh.one_sided && is_behind(triangle, seen_from));
}

bool is_hidden(const StaticMesh& mesh, uint32_t t, Vec3 from, Vec3 place) {
    const Vec3* c = mesh.triangles[t].corner;
    // A little into the triangle: a place on an edge is one of the neighbour, too.
    const Vec3 middle = (1.0f / 3) * (c[0] + c[1] + c[2]), inwards = middle - place;
    const float far = length(inwards), into = std::min(far, kInto * length(place - from));
    const Vec3 to = far > 0 ? place + (into / far) * inwards : place;
    Box box{from, from};
    include(box, to);
    bool is_odd = false;
    visit_triangles(mesh, box, [&](uint32_t k) {
        if (k != t && is_crossed(mesh.triangles[k], from, to)) is_odd = !is_odd;
    });
    return is_odd;
}

Crossing first_crossing(const StaticMesh& mesh, Vec3 from, Vec3 to, float clear) {
    Crossing first;
    Box box{from, from};
    include(box, to);
    uint32_t lowest = 0;
    visit_triangles(mesh, grown(box, 2 * clear), [&](uint32_t t) {
        Crossing found;
        try_triangle(mesh.triangles[t], mesh.one_sided, from, to, static_cast<double>(clear), found);
        if (found.share > first.share || (found.share == first.share && t > lowest) || found.share > 1) return;
        first = found, lowest = t;
    });
    return first;
}

bool find_cut(const StaticMesh& mesh, Vec3 from, Vec3 over, Vec3 to, Cut& cut) {
    Box box{from, from};
    include(box, over), include(box, to);
    bool is_cut = false;
    uint32_t lowest = 0;
    visit_triangles(mesh, box, [&](uint32_t t) {
        if (is_cut && t > lowest) return;
        const StaticTriangle& triangle = mesh.triangles[t];
        const Vec3d normal = normal_of(triangle);
        const double start = height_over(triangle, normal, from), end = height_over(triangle, normal, to);
        const double side = start < 0 ? -1 : 1;
        if (!(side * end < 0)) return;
        // The plane is passed on one half of the way or on the other, at its middle on the second one.
        const bool is_first = side * height_over(triangle, normal, over) < 0;
        if (!is_on_line(triangle, Vec3d(is_first ? from : over), Vec3d(is_first ? over : to))) return;
        is_cut = true, lowest = t;
        cut = {triangle.corner[0], (side * normal).to_float(), !mesh.one_sided || side > 0,
               !mesh.one_sided || side < 0};
    });
    return is_cut;
}

float clearance_at(Vec3 place) {
    return kClear + kRounding * std::max({std::fabs(place.x), std::fabs(place.y), std::fabs(place.z)});
}

}  // namespace cullet::bullet
