#include "systems/hulls/fit_box.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr uint32_t kNormals = 3;
constexpr double kAlike = 0.99;  // cosine of eight degrees: faces of one side of a slab

struct Extent {
    double low = 1e300, high = -1e300;
    void include(double x) {
        low = x < low ? x : low;
        high = x > high ? x : high;
    }
    double width() const { return high - low; }
};

struct Corners {
    Vec3d point[kMostHullPoints];  // from the first
    uint32_t count = 0;
    Corners(std::span<const Vec3> points, const ExtremePoints& hull) : count(hull.count) {
        for (uint32_t k = 0; k < count; ++k) point[k] = Vec3d(points[hull.index[k]]) - Vec3d(points[hull.index[0]]);
    }
};

/// Twice the area, along the outward normal.
Vec3d area_of(const Corners& corners, const std::array<uint8_t, 3>& face) {
    const Vec3d a = corners.point[face[0]];
    return cross(corners.point[face[1]] - a, corners.point[face[2]] - a);
}

/// Directions of the largest sides, each the sum over faces that look its way; largest face first, ties by number.
uint32_t find_sides(const Corners& corners, const ExtremePoints& hull, Vec3d (&side)[kNormals]) {
    Vec3d area[2 * kMostHullPoints];
    bool is_taken[2 * kMostHullPoints] = {};
    for (uint32_t f = 0; f < hull.face_count; ++f) area[f] = area_of(corners, hull.face[f]);
    uint32_t count = 0;
    while (count < kNormals) {
        uint32_t largest = hull.face_count;
        double most = 0;
        for (uint32_t f = 0; f < hull.face_count; ++f)
            if (const double square = dot(area[f], area[f]); !is_taken[f] && square > most) most = square, largest = f;
        if (largest == hull.face_count) break;
        const Vec3d way = normalised(area[largest]);
        Vec3d sum;
        for (uint32_t f = 0; f < hull.face_count; ++f) {
            const double rise = dot(area[f], way), least = kAlike * length(area[f]);
            // The other side of a slab makes the same box.
            if (rise < -least) is_taken[f] = true;
            if (is_taken[f] || rise < least) continue;
            is_taken[f] = true;
            sum += area[f];
        }
        is_taken[largest] = true;
        side[count++] = normalised(sum);
    }
    return count;
}

/// The edge direction, in the plane across `normal`, of the least rectangle about the corners.
Vec3d best_edge(const Corners& corners, const ExtremePoints& hull, Vec3d normal, double& area) {
    const Vec3d first = std::fabs(normal.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d u = normalised(cross(normal, first)), v = cross(normal, u);
    double x[kMostHullPoints], y[kMostHullPoints];
    for (uint32_t k = 0; k < corners.count; ++k) x[k] = dot(u, corners.point[k]), y[k] = dot(v, corners.point[k]);
    double best_x = 1, best_y = 0;
    area = 1e300;
    for (uint32_t f = 0; f < hull.face_count; ++f)
        for (int k = 0; k < 3; ++k) {
            const uint32_t a = hull.face[f][k], b = hull.face[f][(k + 1) % 3];
            if (a > b) continue;  // the face across has it the other way round
            const double dx = x[b] - x[a], dy = y[b] - y[a], square = dx * dx + dy * dy;
            if (!(square > 0)) continue;
            Extent along, across;
            for (uint32_t i = 0; i < corners.count; ++i) {
                along.include(dx * x[i] + dy * y[i]);
                across.include(dx * y[i] - dy * x[i]);
            }
            const double found = along.width() * across.width() / square;
            if (found < area) area = found, best_x = dx, best_y = dy;
        }
    return normalised(best_x * u + best_y * v);
}

}  // namespace

double hull_volume(std::span<const Vec3> points, const ExtremePoints& hull) {
    if (hull.face_count == 0) return 0;
    const Corners corners(points, hull);
    double sum = 0;
    for (uint32_t f = 0; f < hull.face_count; ++f)
        sum += dot(corners.point[hull.face[f][0]], area_of(corners, hull.face[f]));
    return sum / 6;
}

FittedBox fit_box(std::span<const Vec3> points, const ExtremePoints& hull) {
    FittedBox box;
    if (hull.face_count == 0) return box;
    const Corners corners(points, hull);
    Vec3d side[kNormals];
    const uint32_t sides = find_sides(corners, hull, side);
    double least = 1e300;
    for (uint32_t s = 0; s < sides; ++s) {
        double area = 0;
        const Vec3d edge = best_edge(corners, hull, side[s], area);
        Extent through;
        for (uint32_t k = 0; k < corners.count; ++k) through.include(dot(side[s], corners.point[k]));
        if (!(area * through.width() < least)) continue;
        least = area * through.width();
        box.axis[0] = edge, box.axis[1] = cross(side[s], edge), box.axis[2] = side[s];
    }
    Extent extent[3];
    for (const Vec3 p : points)
        for (int k = 0; k < 3; ++k) extent[k].include(dot(box.axis[k], Vec3d(p)));
    for (int k = 0; k < 3; ++k) box.centre += 0.5 * (extent[k].low + extent[k].high) * box.axis[k];
    box.half = {0.5 * extent[0].width(), 0.5 * extent[1].width(), 0.5 * extent[2].width()};
    return box;
}

}  // namespace cullet
