#include "systems/hulls/hull_edges.hpp"

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
double dot(Vec2d a, Vec2d b) {
    return a.x * b.x + a.y * b.y;
}

}  // namespace

bool is_hull_edge(std::span<const Vec3> points, size_t a, size_t b) {
    const Vec3d along = normalised(Vec3d(points[b] - points[a]));
    if (length(along) == 0) return false;
    const Vec3d other = std::fabs(along.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d side = normalised(cullet::cross(along, other)), up = cullet::cross(along, side);
    bool is_first = true;
    Vec2d right{}, left{};  // the wedge that holds all so far, counter-clockwise from right to left
    // Whether to turn left from p to q takes less than half a turn, and surely so.
    const auto is_less_than_half = [](Vec2d p, Vec2d q) {
        return cross(p, q) >= kLeastTurn * std::sqrt(dot(p, p) * dot(q, q));
    };
    for (size_t k = 0; k < points.size(); ++k) {
        const Vec3d from(points[k] - points[a]);
        const Vec2d at{dot(from, side), dot(from, up)};
        if (k == a || k == b || dot(at, at) < kLeastTurn * kLeastTurn * dot(from, from)) continue;
        if (is_first) {
            right = left = at;
            is_first = false;
        } else if (cross(right, at) < 0) {
            if (!is_less_than_half(at, left)) return false;
            right = at;
        } else if (cross(left, at) > 0) {
            if (!is_less_than_half(right, at)) return false;
            left = at;
        } else if (dot(right, at) < 0 && cross(right, left) <= 0) {
            return false;  // opposite to a wedge of one direction
        }
    }
    return true;
}

}  // namespace cullet
