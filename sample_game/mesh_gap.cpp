#include "sample_game/mesh_gap.hpp"

#include <algorithm>
#include <cmath>

namespace cullet {
namespace {

double point_segment_gap(Vec3d p, Vec3d a, Vec3d b) {
    const Vec3d along = b - a;
    const double square = dot(along, along);
    const double t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
    return length(p - (a + t * along));
}

// Where the nearest points of the two lines lie inside of both segments that is the gap; else an end is nearest.
double segment_gap(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
    double least = std::min({point_segment_gap(a, c, d), point_segment_gap(b, c, d), point_segment_gap(c, a, b),
                             point_segment_gap(d, a, b)});
    const Vec3d u = b - a, v = d - c, w = c - a;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), determinant = uu * vv - uv * uv;
    if (!(determinant > 1e-12 * uu * vv)) return least;
    const double s = (dot(u, w) * vv - dot(v, w) * uv) / determinant;
    const double t = (dot(u, w) * uv - dot(v, w) * uu) / determinant;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) least = std::min(least, length(w + t * v - s * u));
    return least;
}

// The foot of the point on the triangle's plane lies in the triangle.
bool is_over(Vec3d foot, const Corners& triangle, Vec3d normal) {
    for (size_t k = 0; k < 3; ++k) {
        const Vec3d along = triangle[(k + 1) % 3] - triangle[k];
        if (dot(cross(along, foot - triangle[k]), normal) < 0) return false;
    }
    return true;
}

Vec3d normal_of(const Corners& t) {
    return cross(t[1] - t[0], t[2] - t[0]);
}

bool pierces(Vec3d a, Vec3d b, const Corners& triangle, Vec3d normal) {
    const double above = dot(a - triangle[0], normal), below = dot(b - triangle[0], normal);
    if (above * below > 0 || above == below) return false;
    return is_over(a + (above / (above - below)) * (b - a), triangle, normal);
}

}  // namespace

double point_gap(Vec3d point, const Corners& triangle) {
    const Vec3d normal = normal_of(triangle);
    const double size = length(normal);
    if (size > 0) {
        const double height = dot(point - triangle[0], normal) / size;
        if (is_over(point - (height / size) * normal, triangle, normal)) return std::fabs(height);
    }
    double least = point_segment_gap(point, triangle[0], triangle[1]);
    least = std::min(least, point_segment_gap(point, triangle[1], triangle[2]));
    return std::min(least, point_segment_gap(point, triangle[2], triangle[0]));
}

double triangle_gap(const Corners& a, const Corners& b) {
    const Vec3d normal_a = normal_of(a), normal_b = normal_of(b);
    double least = 1e30;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3d from = a[k], to = a[(k + 1) % 3];
        if (pierces(from, to, b, normal_b) || pierces(b[k], b[(k + 1) % 3], a, normal_a)) return 0;
        least = std::min({least, point_gap(from, b), point_gap(b[k], a)});
        for (size_t j = 0; j < 3; ++j) least = std::min(least, segment_gap(from, to, b[j], b[(j + 1) % 3]));
    }
    return least;
}

}  // namespace cullet
