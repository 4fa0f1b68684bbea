#include "tests/support/motion_contacts.hpp"

#include <algorithm>

#include "systems/structures/shell/cook/pair_list.hpp"
#include "systems/structures/shell/cook/tetrahedra.hpp"
#include "tests/support/shell_checks.hpp"

namespace cullet::test {
namespace {

constexpr double kWeight = 1e-6;  // tolerance of barycentric weights and of the place on an edge

double determinant(Vec3d a, Vec3d b, Vec3d c) {
    return dot(a, cross(b, c));
}

// Sign changes of a0 + a1 t + a2 t^2 + a3 t^3 in [0, 1], between the zeros of its derivative, by halving.
void add_roots(const std::array<double, 4>& a, std::vector<double>& roots) {
    const auto value = [&](double t) { return a[0] + t * (a[1] + t * (a[2] + t * a[3])); };
    std::vector<double> ends{0, 1};
    const double p = 3 * a[3], q = 2 * a[2], r = a[1], under = q * q - 4 * p * r;
    if (under >= 0) {
        const double s = -0.5 * (q + (q < 0 ? -1 : 1) * std::sqrt(under));
        for (const double t : {p != 0 ? s / p : -1, s != 0 ? r / s : -1})
            if (t > 0 && t < 1) ends.push_back(t);
    }
    std::sort(ends.begin(), ends.end());
    for (size_t k = 0; k < ends.size(); ++k) {
        if (value(ends[k]) == 0) roots.push_back(ends[k]);
        if (k + 1 == ends.size()) break;
        double low = ends[k], high = ends[k + 1];
        if (!(value(low) * value(high) < 0)) continue;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (value(low) * value(middle) <= 0 ? high : low) = middle;
        }
        roots.push_back(0.5 * (low + high));
    }
}

struct Sweep {
    Vec3d low, high;
    explicit Sweep(std::initializer_list<const MovingPoint*> points) : low((*points.begin())->from), high(low) {
        for (const MovingPoint* p : points)
            for (const Vec3d q : {p->from, p->to}) {
                low = {std::min(low.x, q.x), std::min(low.y, q.y), std::min(low.z, q.z)};
                high = {std::max(high.x, q.x), std::max(high.y, q.y), std::max(high.z, q.z)};
            }
    }
    bool overlaps(const Sweep& s, double slack) const {
        return low.x <= s.high.x + slack && s.low.x <= high.x + slack && low.y <= s.high.y + slack &&
               s.low.y <= high.y + slack && low.z <= s.high.z + slack && s.low.z <= high.z + slack;
    }
};

/// Faces with moving corners; `id` tells corners that are one point all the time.
struct MovingShell {
    ShellFaces faces;
    std::vector<MovingPoint> points;  // local; outer, then inner
    std::vector<uint32_t> id;
    uint32_t count;

    MovingShell(const Surface& s, const std::vector<Vec3d>& direction, const std::vector<double>& from,
                const std::vector<double>& to)
        : faces(s), count(static_cast<uint32_t>(s.positions.size())) {
        const LocalFrame frame(s.low, s.diagonal);
        for (uint32_t v = 0; v < count; ++v) points.push_back({frame(s.positions[v]), frame(s.positions[v])});
        for (uint32_t v = 0; v < count; ++v)
            points.push_back(
                {frame(s.positions[v] + from[v] * direction[v]), frame(s.positions[v] + to[v] * direction[v])});
        for (uint32_t v = 0; v < 2 * count; ++v)
            id.push_back(v >= count && from[v - count] == 0 && to[v - count] == 0 ? v - count : v);
    }
    uint32_t vertex(uint32_t corner) const { return corner < count ? corner : corner - count; }
    uint32_t triangle(const Surface& s, uint32_t face) const {
        const auto triangles = static_cast<uint32_t>(s.triangles.size());
        if (face < triangles) return face;
        return face < 2 * triangles ? face - triangles : s.border_edges[(face - 2 * triangles) / 2].triangle;
    }
    bool is_outer(const Surface& s, uint32_t face) const { return face < s.triangles.size(); }
    bool has_three_corners(uint32_t face) const {
        const Triangle& c = faces.corners[face];
        return id[c[0]] != id[c[1]] && id[c[1]] != id[c[2]] && id[c[2]] != id[c[0]];
    }
    CheckedFace checked(const Surface& s, uint32_t face) const {
        const Triangle& c = faces.corners[face];
        return {{points[c[0]].to, points[c[1]].to, points[c[2]].to},
                {vertex(c[0]), vertex(c[1]), vertex(c[2])},
                triangle(s, face),
                is_outer(s, face)};
    }
    bool touch(uint32_t f, uint32_t g) const {
        const Triangle &a = faces.corners[f], &b = faces.corners[g];
        const auto one = [&](const Triangle& p, const Triangle& t) {
            for (const uint32_t v : p) {
                if (id[v] == id[t[0]] || id[v] == id[t[1]] || id[v] == id[t[2]]) continue;
                if (point_touches(points[v], {points[t[0]], points[t[1]], points[t[2]]})) return true;
            }
            return false;
        };
        if (one(a, b) || one(b, a)) return true;
        for (size_t k = 0; k < 3; ++k)
            for (size_t l = 0; l < 3; ++l) {
                const uint32_t p = a[k], q = a[(k + 1) % 3], r = b[l], s = b[(l + 1) % 3];
                if (id[p] == id[r] || id[p] == id[s] || id[q] == id[r] || id[q] == id[s]) continue;
                if (edges_touch(points[p], points[q], points[r], points[s])) return true;
            }
        return false;
    }
};

template <class Test>
FacePairs find_pairs(const Surface& s, const MovingShell& shell, Test test) {
    std::vector<TreeBox> boxes(shell.faces.corners.size());
    for (uint32_t f = 0; f < boxes.size(); ++f)
        for (const uint32_t c : shell.faces.corners[f])
            boxes[f].grow(shell.points[c].from), boxes[f].grow(shell.points[c].to);
    FacePairs pairs;
    BoxTree(boxes).for_each_overlap([&](uint32_t a, uint32_t b) {
        if (a > b) std::swap(a, b);
        if (!shell.has_three_corners(a) || !shell.has_three_corners(b)) return true;
        if (!is_excused(s, shell.checked(s, a), shell.checked(s, b)) && test(a, b)) pairs.push_back({a, b});
        return true;
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace

std::vector<double> coplanar_times(const std::array<MovingPoint, 4>& p) {
    std::array<Vec3d, 3> x, u;
    double size = 0;
    for (size_t k = 0; k < 3; ++k) {
        x[k] = p[k + 1].from - p[0].from;
        u[k] = (p[k + 1].to - p[0].to) - x[k];
        size = std::max({size, length(x[k]), length(u[k])});
    }
    const std::array<double, 4> a{
        determinant(x[0], x[1], x[2]),
        determinant(u[0], x[1], x[2]) + determinant(x[0], u[1], x[2]) + determinant(x[0], x[1], u[2]),
        determinant(x[0], u[1], u[2]) + determinant(u[0], x[1], u[2]) + determinant(u[0], u[1], x[2]),
        determinant(u[0], u[1], u[2])};
    const double most = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2]), std::fabs(a[3])});
    if (most <= 1e-15 * size * size * size) return {-1};
    std::vector<double> times;
    add_roots(a, times);
    return times;
}

bool point_touches(const MovingPoint& p, const std::array<MovingPoint, 3>& t) {
    if (!Sweep({&p}).overlaps(Sweep({&t[0], &t[1], &t[2]}), 1e-9)) return false;
    const auto is_in = [&](double time) {
        const Vec3d a = t[0].at(time), b = t[1].at(time) - a, c = t[2].at(time) - a, q = p.at(time) - a;
        const Vec3d n = cross(b, c);
        const double nn = dot(n, n);
        if (!(nn > 0)) return false;
        const double v = dot(cross(q, c), n) / nn, w = dot(cross(b, q), n) / nn;
        return v >= -kWeight && w >= -kWeight && v + w <= 1 + kWeight;
    };
    const std::vector<double> times = coplanar_times({t[0], t[1], t[2], p});
    if (times == std::vector<double>{-1}) return is_in(0) || is_in(0.5) || is_in(1);
    return std::any_of(times.begin(), times.end(), is_in);
}

bool edges_touch(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c, const MovingPoint& d) {
    if (!Sweep({&a, &b}).overlaps(Sweep({&c, &d}), 1e-9)) return false;
    const auto cross_at = [&](double time) {
        const Vec3d p = a.at(time), e = b.at(time) - p, q = c.at(time), f = d.at(time) - q, n = cross(e, f);
        const double nn = dot(n, n);
        if (!(nn > 1e-24 * dot(e, e) * dot(f, f))) return false;  // parallel: their ends touch faces
        const double s = dot(cross(q - p, f), n) / nn, u = dot(cross(q - p, e), n) / nn;
        return s >= -kWeight && s <= 1 + kWeight && u >= -kWeight && u <= 1 + kWeight;
    };
    const std::vector<double> times = coplanar_times({a, b, c, d});
    if (times == std::vector<double>{-1}) return cross_at(0) || cross_at(0.5) || cross_at(1);
    return std::any_of(times.begin(), times.end(), cross_at);
}

FacePairs contacts_of_motion(const Surface& s, const std::vector<Vec3d>& direction, const std::vector<double>& from,
                             const std::vector<double>& to) {
    const MovingShell shell(s, direction, from, to);
    return find_pairs(s, shell, [&](uint32_t a, uint32_t b) { return shell.touch(a, b); });
}

FacePairs meetings_at(const Surface& s, const std::vector<Vec3d>& direction, const std::vector<double>& depth) {
    const MovingShell shell(s, direction, depth, depth);
    return find_pairs(s, shell, [&](uint32_t a, uint32_t b) {
        return triangles_meet(shell.checked(s, a).point, shell.checked(s, b).point);
    });
}

std::vector<double> push_by_motion(const Surface& s, const std::vector<Vec3d>& direction,
                                   const std::vector<double>& start, const std::vector<double>& cap, uint32_t rounds) {
    const auto count = static_cast<uint32_t>(s.positions.size());
    std::vector<double> depth = start, step(count);
    for (uint32_t v = 0; v < count; ++v) step[v] = cap[v] / rounds;
    for (uint32_t round = 0; round < 3 * rounds; ++round) {
        std::vector<double> trial(count);
        for (uint32_t v = 0; v < count; ++v) trial[v] = std::min(depth[v] + step[v], cap[v]);
        // What is bad goes back, with what moved beside it, until nothing is.
        for (bool is_good = false; !is_good;) {
            std::vector<uint8_t> is_bad(count);
            for (const Triangle& c : s.triangles) {
                std::array<Vec3d, 3> outer, inner;
                for (size_t k = 0; k < 3; ++k)
                    outer[k] = s.positions[c[k]], inner[k] = outer[k] + trial[c[k]] * direction[c[k]];
                const PrismTetrahedra tets = prism_tetrahedra(outer, inner, c);
                for (size_t k = 0; k < 3; ++k)
                    if (trial[c[tets.flattens[k]]] > 0 && !(tets.volume[k] > 0))
                        is_bad[c[0]] = is_bad[c[1]] = is_bad[c[2]] = 1;
            }
            const ShellFaces faces(s);
            for (const auto& pair : contacts_of_motion(s, direction, depth, trial))
                for (const uint32_t face : pair)
                    for (const uint32_t corner : faces.corners[face])
                        if (corner >= count) is_bad[corner - count] = 1;
            is_good = true;
            for (uint32_t v = 0; v < count; ++v) {
                if (!is_bad[v] || !(trial[v] > depth[v])) continue;
                trial[v] = depth[v];
                step[v] /= 2;
                is_good = false;
            }
        }
        depth = trial;
    }
    return depth;
}

}  // namespace cullet::test
