#include "systems/view/hull_edges.hpp"

#include <cmath>

namespace cullet {
namespace {

constexpr double kLeastTurn = 1e-4;  // rad off a half turn, and of what counts as beside the segment

struct Vec2d {
    double x, y;
};
double cross(Vec2d a, Vec2d b) {
    return a.x * b.y - a.y * b.x;
}

}  // namespace

bool is_hull_edge(std::span<const Vec3> points, size_t a, size_t b) {
    const Vec3d along = normalised(Vec3d(points[b] - points[a]));
    if (length(along) == 0) return false;
    const Vec3d other = std::fabs(along.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d side = normalised(cullet::cross(along, other)), up = cullet::cross(along, side);
    bool is_first = true;
    Vec2d right{}, left{};  // the wedge that holds all so far, counter-clockwise from right to left
    for (size_t k = 0; k < points.size(); ++k) {
        const Vec3d from(points[k] - points[a]);
        Vec2d at{dot(from, side), dot(from, up)};
        const double away = std::sqrt(at.x * at.x + at.y * at.y);
        if (k == a || k == b || away < kLeastTurn * length(from)) continue;
        at = {at.x / away, at.y / away};
        if (is_first) {
            right = left = at;
            is_first = false;
        } else if (cross(right, at) < 0) {
            if (cross(at, left) < kLeastTurn) return false;
            right = at;
        } else if (cross(left, at) > 0) {
            if (cross(right, at) < kLeastTurn) return false;
            left = at;
        } else if (right.x * at.x + right.y * at.y < 0 && cross(right, left) <= 0) {
            return false;  // opposite to a wedge of one direction
        }
    }
    return true;
}

}  // namespace cullet
