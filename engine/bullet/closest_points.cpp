#include "engine/bullet/closest_points.hpp"

#include <cstring>

namespace cullet::bullet {
namespace {

// Gilbert, Johnson, Keerthi 1988 with the closest point of a simplex by Voronoi regions (Ericson, Real-Time Collision
// Detection, 5.1).
struct Corner {
    Vec3d difference, a, b;  // a - b, from the centre of set a
    uint32_t index_a, index_b;
    double weight;
};

struct Simplex {
    Corner corner[4];
    int count = 0;
};

void keep(Simplex& simplex, int first, double weight_first, int second = -1, double weight_second = 0, int third = -1,
          double weight_third = 0) {
    const Simplex before = simplex;
    simplex.count = 0;
    const int kept[3] = {first, second, third};
    const double weights[3] = {weight_first, weight_second, weight_third};
    for (int k = 0; k < 3; ++k) {
        if (kept[k] < 0) continue;
        simplex.corner[simplex.count] = before.corner[kept[k]];
        simplex.corner[simplex.count++].weight = weights[k];
    }
}

Vec3d point(const Simplex& simplex) {
    Vec3d sum;
    for (int k = 0; k < simplex.count; ++k) sum += simplex.corner[k].weight * simplex.corner[k].difference;
    return sum;
}

void closest_of_segment(Simplex& simplex, int i, int j) {
    const Vec3d a = simplex.corner[i].difference, ab = simplex.corner[j].difference - a;
    const double along = -dot(a, ab), square = dot(ab, ab);
    if (along <= 0) return keep(simplex, i, 1);
    if (along >= square) return keep(simplex, j, 1);
    keep(simplex, i, 1 - along / square, j, along / square);
}

void closest_of_triangle(Simplex& simplex, int i, int j, int k) {
    const Vec3d a = simplex.corner[i].difference, b = simplex.corner[j].difference, c = simplex.corner[k].difference;
    const Vec3d ab = b - a, ac = c - a;
    const double d1 = -dot(ab, a), d2 = -dot(ac, a), d3 = -dot(ab, b), d4 = -dot(ac, b), d5 = -dot(ab, c),
                 d6 = -dot(ac, c);
    if (d1 <= 0 && d2 <= 0) return keep(simplex, i, 1);
    if (d3 >= 0 && d4 <= d3) return keep(simplex, j, 1);
    if (d6 >= 0 && d5 <= d6) return keep(simplex, k, 1);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return closest_of_segment(simplex, i, j);
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return closest_of_segment(simplex, i, k);
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return closest_of_segment(simplex, j, k);
    const double sum = va + vb + vc;
    if (!(sum > 0)) return closest_of_segment(simplex, i, j);
    keep(simplex, i, va / sum, j, vb / sum, k, vc / sum);
}

// The closest of the four faces that the origin lies in front of; false when it lies behind all of them. A flat
// tetrahedron has the origin in front of every face.
bool closest_of_tetrahedron(Simplex& simplex) {
    static constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    const Simplex whole = simplex;
    double best = -1;
    for (const auto& face : kFaces) {
        const Vec3d a = whole.corner[face[0]].difference;
        const Vec3d n = cross(whole.corner[face[1]].difference - a, whole.corner[face[2]].difference - a);
        const double opposite = dot(n, whole.corner[face[3]].difference - a), origin = -dot(n, a);
        if (origin * opposite > 0) continue;
        Simplex part = whole;
        closest_of_triangle(part, face[0], face[1], face[2]);
        const Vec3d p = point(part);
        const double square = dot(p, p);
        if (best >= 0 && square >= best) continue;
        best = square;
        simplex = part;
    }
    return best >= 0;
}

bool reduce(Simplex& simplex) {
    if (simplex.count == 1) simplex.corner[0].weight = 1;
    if (simplex.count == 2) closest_of_segment(simplex, 0, 1);
    if (simplex.count == 3) closest_of_triangle(simplex, 0, 1, 2);
    return simplex.count < 4 || closest_of_tetrahedron(simplex);
}

// 40 rounds: hulls of 32 points take 4 to 12; what is not done by then keeps its best distance.
constexpr int kRounds = 40;
constexpr double kTouching = 1e-7;  // m: closer than this has no direction and counts as touching
constexpr double kAgreed = 1e-7;    // m between distance and bound

}  // namespace

// Four lanes by the compiler's vector types: the same operations in the same order on every machine.
uint32_t support(const Points& p, Vec3 d) {
    typedef float Lanes __attribute__((vector_size(16)));
    typedef int32_t Numbers __attribute__((vector_size(16)));
    Lanes best = {-kFar, -kFar, -kFar, -kFar};
    Numbers number = {0, 1, 2, 3}, best_number = number;
    for (uint32_t k = 0; k < p.count; k += 4) {
        Lanes x, y, z;
        std::memcpy(&x, p.x + k, sizeof x);
        std::memcpy(&y, p.y + k, sizeof y);
        std::memcpy(&z, p.z + k, sizeof z);
        const Lanes along = x * d.x + y * d.y + z * d.z;
        const Numbers is_farther = along > best;
        best = is_farther ? along : best;
        best_number = is_farther ? number : best_number;
        number += 4;
    }
    int lane = 0;
    for (int k = 1; k < 4; ++k)
        if (best[k] > best[lane] || (best[k] == best[lane] && best_number[k] < best_number[lane])) lane = k;
    return static_cast<uint32_t>(best_number[lane]);
}

double gap_along(const Points& a, const Points& b, Vec3d axis) {
    const Vec3 direction = axis.to_float();
    const Vec3d low(a[support(a, -direction)]), high(b[support(b, direction)]);
    return dot(axis, (Vec3d(a.centre) - Vec3d(b.centre)) + low - high);
}

Closest closest_points(const Points& a, const Points& b, Vec3d guess, double enough) {
    const Vec3d offset = Vec3d(b.centre) - Vec3d(a.centre);
    Closest best;
    best.bound = -1e30;
    Simplex simplex;
    Vec3d v = dot(guess, guess) > 0 ? guess : -offset;
    if (!(dot(v, v) > 0)) v = {0, 1, 0};
    double square = 1e60;
    for (int round = 0; round < kRounds; ++round) {
        const double l = length(v);
        const Vec3d axis = (1 / l) * v;
        const Vec3 direction = axis.to_float();
        Corner next;
        next.index_a = support(a, -direction);
        next.index_b = support(b, direction);
        next.a = Vec3d(a[next.index_a]);
        next.b = Vec3d(b[next.index_b]) + offset;
        next.difference = next.a - next.b;
        next.weight = 0;
        const double gap = dot(axis, next.difference);
        if (gap > best.bound) best.bound = gap, best.axis = axis;
        if (gap > enough) {
            best.is_apart = true;
            best.distance = gap;
            best.axis = axis;
            return best;
        }
        bool is_known = simplex.count > 0 && l - gap < kAgreed;
        for (int k = 0; k < simplex.count; ++k)
            is_known |= simplex.corner[k].index_a == next.index_a && simplex.corner[k].index_b == next.index_b;
        if (is_known) break;
        const Simplex before = simplex;
        simplex.corner[simplex.count++] = next;
        if (!reduce(simplex)) return best;  // the origin is inside
        const Vec3d closer = point(simplex);
        const double closer_square = dot(closer, closer);
        if (closer_square < kTouching * kTouching) return best;
        if (closer_square >= square) {  // rounding: no progress, the last one was best
            simplex = before;
            break;
        }
        v = closer;
        square = closer_square;
    }
    best.is_apart = true;
    best.distance = length(v);
    best.axis = (1 / best.distance) * v;
    for (int k = 0; k < simplex.count; ++k) {
        best.on_a += simplex.corner[k].weight * simplex.corner[k].a;
        best.on_b += simplex.corner[k].weight * simplex.corner[k].b;
    }
    return best;
}

}  // namespace cullet::bullet
