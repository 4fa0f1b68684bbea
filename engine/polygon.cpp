#include "engine/polygon.hpp"

#include <cmath>

namespace cullet {
namespace {

struct Flat {
    double x = 0, y = 0;
};

/// Twice the signed area of a triangle.
double area(Flat a, Flat b, Flat c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The corners seen along the axis that is nearest to the normal, counter-clockwise. Empty when there is no normal.
List<Flat> flattened(std::span<const Vec3d> corners) {
    Vec3d normal;
    for (size_t i = 1; i + 1 < corners.size(); ++i)
        normal = normal + cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    const double size[3] = {std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
    const double largest = std::fmax(size[0], std::fmax(size[1], size[2]));
    if (!(largest > 0) || !std::isfinite(largest)) return {};
    List<Flat> flat;
    for (const Vec3d c : corners) {
        const Vec3d p = c - corners[0];
        if (largest == size[2])
            flat.push_back(normal.z > 0 ? Flat{p.x, p.y} : Flat{p.y, p.x});
        else if (largest == size[1])
            flat.push_back(normal.y > 0 ? Flat{p.z, p.x} : Flat{p.x, p.z});
        else
            flat.push_back(normal.x > 0 ? Flat{p.y, p.z} : Flat{p.z, p.y});
    }
    return flat;
}

/// Strictly: every corner turns to the left, once round. A star that goes round twice has corners of both halves on
/// each side of some line; the sum of its turns is told by how often x changes its direction.
bool is_convex(const List<Flat>& flat) {
    const size_t n = flat.size();
    int changes = 0;
    for (size_t i = 0; i < n; ++i) {
        const Flat a = flat[i], b = flat[(i + 1) % n], c = flat[(i + 2) % n];
        if (!(area(a, b, c) > 0)) return false;
        changes += (b.x > a.x) != (c.x > b.x);
    }
    return changes <= 2;
}

List<std::array<uint32_t, 3>> fan_of(size_t n) {
    List<std::array<uint32_t, 3>> triangles;
    for (uint32_t i = 1; i + 1 < n; ++i) triangles.push_back({0, i, i + 1});
    return triangles;
}

/// What is left of the polygon while ears are cut off: a ring of corners.
struct Ring {
    const List<Flat>& flat;
    List<uint32_t> next, previous;

    explicit Ring(const List<Flat>& corners) : flat(corners), next(corners.size()), previous(corners.size()) {
        const uint32_t n = static_cast<uint32_t>(corners.size());
        for (uint32_t i = 0; i < n; ++i) next[i] = (i + 1) % n, previous[i] = (i + n - 1) % n;
    }
    /// A corner that turns to the left and whose triangle holds no other corner of the ring. One that stands in the
    /// place of a corner of the triangle does not count: rings that touch themselves have such.
    bool is_ear(uint32_t b) const {
        const uint32_t a = previous[b], c = next[b];
        if (!(area(flat[a], flat[b], flat[c]) > 0)) return false;
        for (uint32_t i = next[c]; i != a; i = next[i]) {
            const bool is_inside = area(flat[a], flat[b], flat[i]) >= 0 && area(flat[b], flat[c], flat[i]) >= 0 &&
                                   area(flat[c], flat[a], flat[i]) >= 0;
            if (is_inside && !is_at(i, a) && !is_at(i, b) && !is_at(i, c)) return false;
        }
        return true;
    }
    bool is_at(uint32_t i, uint32_t j) const { return flat[i].x == flat[j].x && flat[i].y == flat[j].y; }
    std::array<uint32_t, 3> cut(uint32_t b) {
        const uint32_t a = previous[b], c = next[b];
        next[a] = c;
        previous[c] = a;
        return {a, b, c};
    }
};

/// When no corner is an ear (it crosses itself, or is flat), the one at hand goes.
List<std::array<uint32_t, 3>> ears_of(const List<Flat>& flat) {
    Ring ring(flat);
    List<std::array<uint32_t, 3>> triangles;
    uint32_t at = 0;
    size_t left = flat.size(), tried = 0;
    while (left > 3) {
        if (!ring.is_ear(at) && tried < left) {
            at = ring.next[at];
            ++tried;
            continue;
        }
        const uint32_t next = ring.next[at];
        triangles.push_back(ring.cut(at));
        at = ring.next[next];  // not its neighbour: one corner after the other would make a fan of slivers
        --left;
        tried = 0;
    }
    triangles.push_back({ring.previous[at], at, ring.next[at]});
    return triangles;
}

}  // namespace

List<std::array<uint32_t, 3>> cut_polygon(std::span<const Vec3d> corners) {
    if (corners.size() < 3) return {};
    if (corners.size() == 3) return fan_of(3);
    const List<Flat> flat = flattened(corners);
    if (flat.empty() || is_convex(flat)) return fan_of(corners.size());
    return ears_of(flat);
}

}  // namespace cullet
