#include "sample_game/fallen_through.hpp"

#include <cmath>

namespace cullet {
namespace {

/// Where a vertical line meets a triangle.
struct Meeting {
    double height = 0;     // m
    bool faces_up = true;  // the triangle's outside is above it
};

/// Corners and edges belong to the triangle. What is seen from its edge does not meet the line.
bool meets(const Corners& c, double x, double z, Meeting& meeting) {
    const auto turn = [&](Vec3d a, Vec3d b) { return (a.z - z) * (b.x - x) - (a.x - x) * (b.z - z); };
    const double u = turn(c[0], c[1]), v = turn(c[1], c[2]), w = turn(c[2], c[0]), sum = u + v + w;
    if (sum == 0 || !((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) return false;
    meeting = {(v * c[0].y + w * c[1].y + u * c[2].y) / sum, sum > 0};
    return true;
}

}  // namespace

bool has_fallen_through(const DrawnSolid& body, std::span<const DrawnSolid> never_moving) {
    const Vec3d middle = 0.5 * (Vec3d(body.all.low) + Vec3d(body.all.high));
    const double highest = static_cast<double>(body.all.high.y);
    Meeting above{HUGE_VAL, false}, beneath{-HUGE_VAL, false};
    for (const DrawnSolid& solid : never_moving)
        for (size_t t = 0; t < solid.triangles.size(); ++t) {
            const Vec3d low(solid.bounds[t].low), high(solid.bounds[t].high);
            if (middle.x < low.x || middle.x > high.x || middle.z < low.z || middle.z > high.z) continue;
            Meeting here;
            if (!meets(solid.corners(t), middle.x, middle.z, here)) continue;
            if (here.height >= highest && here.height < above.height) above = here;
            // Of a pillar's foot and the floor that it stands on the floor counts.
            if (here.height <= middle.y &&
                (here.height > beneath.height || (here.height == beneath.height && here.faces_up)))
                beneath = here;
        }
    if (above.height == HUGE_VAL) return false;
    const bool is_inside = above.faces_up && !beneath.faces_up;  // between the upper side of a solid and its underside
    return beneath.height == -HUGE_VAL || is_inside;
}

}  // namespace cullet
