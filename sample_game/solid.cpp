#include "sample_game/solid.hpp"

namespace cullet {
namespace {

/// 1 where the ray from p along x goes out through the triangle, -1 where it comes in, 0 where it misses.
int crossing(Vec3d p, const Corners& c) {
    const auto turn = [&](Vec3d a, Vec3d b) { return (a.y - p.y) * (b.z - p.z) - (a.z - p.z) * (b.y - p.y); };
    const double u = turn(c[0], c[1]), v = turn(c[1], c[2]), w = turn(c[2], c[0]), sum = u + v + w;
    if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) return 0;
    const double x = (v * c[0].x + w * c[1].x + u * c[2].x) / sum;
    return x <= p.x ? 0 : sum > 0 ? 1 : -1;
}

}  // namespace

void DrawnSolid::finish() {
    for (const auto& t : triangles) {
        Bounds& b = bounds.emplace_back();
        for (const uint32_t k : t) b.include(points[k]), all.include(points[k]);
    }
}

// The winding number: a ray along x leaves a closed mesh once more than it enters it from inside, and as often from
// outside. The ray starts a fifth of a micrometre beside p, so that it meets no corner and no edge. Needs no ray
// scene, of which Embree bears no thousand; solid angles cost ten times as much.
bool DrawnSolid::holds(Vec3 p) const {
    if (!all.holds(p)) return false;
    const Vec3d from = Vec3d(p) + Vec3d(0, 1.37e-7, 1.71e-7);
    int leaves = 0;
    for (size_t t = 0; t < triangles.size(); ++t)
        if (bounds[t].high.x >= p.x && bounds[t].holds_across(p)) leaves += crossing(from, corners(t));
    return leaves > 0;
}

double DrawnSolid::depth(Vec3 p) const {
    double least = 1e30;
    for (size_t t = 0; t < triangles.size(); ++t)
        if (bounds[t].squared_gap(p) <= least * least) least = std::min(least, point_gap(Vec3d(p), corners(t)));
    return least;
}

DrawnSolid solid_of(const BodyView& view) {
    DrawnSolid solid;
    for (uint32_t v = 0; v < view.vertex_count; ++v)
        solid.points.push_back(to_world(view.pose, view.vertices[v].position));
    for (uint32_t i = 0; i + 2 < view.index_count; i += 3)
        solid.triangles.push_back({view.indices[i], view.indices[i + 1], view.indices[i + 2]});
    solid.finish();
    return solid;
}

double deepest(const DrawnSolid& inner, const DrawnSolid& outer) {
    double most = 0;
    if (!inner.all.is_within(outer.all, 0)) return most;
    for (const Vec3 p : inner.points)
        if (outer.holds(p)) most = std::max(most, outer.depth(p));
    return most;
}

}  // namespace cullet
