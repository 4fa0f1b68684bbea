#include "sample_game/figure_tools.hpp"

#include <algorithm>
#include <cmath>

namespace cullet {
namespace {

// Vertices aimed at before the longest edges are split: what is split looks less even than what is remeshed, and the
// remesher misses its aim by some percent.
constexpr double kAim = 0.95;
constexpr double kEquilateral = 1.1547005383792515;  // vertices a square edge: 2 / sqrt(3)

Vec3d gradient(const Figure& figure, Vec3d p) {
    constexpr double h = 1e-4;
    const auto& f = figure.f;
    return {(f(p + Vec3d{h, 0, 0}) - f(p - Vec3d{h, 0, 0})) / (2 * h),
            (f(p + Vec3d{0, h, 0}) - f(p - Vec3d{0, h, 0})) / (2 * h),
            (f(p + Vec3d{0, 0, h}) - f(p - Vec3d{0, 0, h})) / (2 * h)};
}

double area_of(const MeshDraft& s) {
    double area = 0;
    for (const Triangle& t : s.triangles)
        area += 0.5 * length(cross(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]]));
    return area;
}

}  // namespace

double ellipsoid(Vec3d p, Vec3d centre, Vec3d r) {
    const Vec3d d = p - centre;
    const double k = length(Vec3d{d.x / r.x, d.y / r.y, d.z / r.z});
    const double slope = length(Vec3d{d.x / (r.x * r.x), d.y / (r.y * r.y), d.z / (r.z * r.z)});
    return slope > 0 ? k * (k - 1) / slope : -std::min(r.x, std::min(r.y, r.z));
}

double rod(Vec3d p, Vec3d a, Vec3d b, double radius) {
    const Vec3d d = b - a;
    const double along = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
    return length(p - a - along * d) - radius;
}

double tapered_rod(Vec3d p, Vec3d a, Vec3d b, double radius_a, double radius_b) {
    const Vec3d d = b - a;
    const double along = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
    return length(p - a - along * d) - (radius_a + along * (radius_b - radius_a));
}

double blend(double a, double b, double width) {
    const double h = std::max(width - std::fabs(a - b), 0.0) / width;
    return std::min(a, b) - 0.25 * h * h * width;
}

Vec3d onto(const Figure& figure, Vec3d p) {
    for (int step = 0; step < 4; ++step) {
        const double f = figure.f(p);
        if (std::fabs(f) < 1e-6) break;  // a thousandth of a millimetre on a metre
        const Vec3d g = gradient(figure, p);
        p = p - (f / std::max(dot(g, g), 0.1)) * g;
    }
    return p;
}

MeshDraft figure_of(const Figure& figure, size_t vertices, uint64_t seed) {
    vertices = std::clamp(vertices, size_t{500}, size_t{200'000});
    const auto project = [&figure](Vec3d p) { return onto(figure, p); };
    const MeshDraft coarse = surface_of(figure.f, figure.low, figure.high, 0.03);
    double edge = std::sqrt(kEquilateral * area_of(coarse) / (kAim * static_cast<double>(vertices)));
    // The seed moves the grid, and with it every vertex.
    const Vec3d shift{jitter(seed, 0, 0, 0), jitter(seed, 0, 0, 1), jitter(seed, 0, 0, 2)};
    const Vec3d low = figure.low + (0.02 * shift);
    MeshDraft surface;
    for (int attempt = 0; attempt < 8; ++attempt, edge *= 1.03) {
        surface = surface_of(figure.f, low, figure.high, std::min(1.4 * edge, 0.03));
        remesh(surface, kTargetPerMean * edge, project);
        if (surface.points.size() <= vertices) break;
    }
    split_longest(surface, vertices, project);
    flip_to_delaunay(surface);
    return surface;
}

void stand(MeshDraft& surface, double length) {
    double front = -1e9, back = 1e9, foot = 1e9;
    for (const Vec3d p : surface.points) {
        front = std::max(front, p.x);
        back = std::min(back, p.x);
        foot = std::min(foot, p.y);
    }
    const Vec3d origin{(front + back) / 2, foot, 0};
    for (Vec3d& p : surface.points) p = (length / (front - back)) * (p - origin);
}

}  // namespace cullet
