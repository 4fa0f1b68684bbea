#include "engine/bullet/closest_points.hpp"

#include <algorithm>

#include "engine/lanes.hpp"

namespace cullet::bullet {

using namespace lanes;
namespace {

// Gilbert, Johnson, Keerthi 1988 with the closest point of a simplex by Voronoi regions (Ericson, Real-Time Collision
// Detection, 5.1).
struct Simplex {
    Vec3d difference[4];  // a - b, from the centre of set a
    uint32_t index_a[4], index_b[4];
    double weight[4];
    int count = 0;
};

// The corners of a simplex that carry its closest point to the origin.
struct Part {
    int count = 0;
    int kept[3];
    double weight[3];
};

Part part_of(int i) {
    return {1, {i, 0, 0}, {1, 0, 0}};
}

Part closest_of_segment(const Simplex& simplex, int i, int j) {
    const Vec3d a = simplex.difference[i], ab = simplex.difference[j] - a;
    const double along = -dot(a, ab), square = dot(ab, ab);
    if (along <= 0) return part_of(i);
    if (along >= square) return part_of(j);
    return {2, {i, j, 0}, {1 - along / square, along / square, 0}};
}

Part closest_of_triangle(const Simplex& simplex, int i, int j, int k) {
    const Vec3d a = simplex.difference[i], b = simplex.difference[j], c = simplex.difference[k];
    const Vec3d ab = b - a, ac = c - a;
    const double d1 = -dot(ab, a), d2 = -dot(ac, a), d3 = -dot(ab, b), d4 = -dot(ac, b), d5 = -dot(ab, c),
                 d6 = -dot(ac, c);
    if (d1 <= 0 && d2 <= 0) return part_of(i);
    if (d3 >= 0 && d4 <= d3) return part_of(j);
    if (d6 >= 0 && d5 <= d6) return part_of(k);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return closest_of_segment(simplex, i, j);
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return closest_of_segment(simplex, i, k);
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return closest_of_segment(simplex, j, k);
    const double sum = va + vb + vc;
    if (!(sum > 0)) return closest_of_segment(simplex, i, j);
    return {3, {i, j, k}, {va / sum, vb / sum, vc / sum}};
}

Vec3d point(const Simplex& simplex, const Part& part) {
    Vec3d sum;
    for (int k = 0; k < part.count; ++k) sum += part.weight[k] * simplex.difference[part.kept[k]];
    return sum;
}

// The closest of the four faces that the origin lies in front of; no corner at all when it lies behind all of them. A
// flat tetrahedron has the origin in front of every face.
Part closest_of_tetrahedron(const Simplex& simplex) {
    static constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    Part nearest;
    double best = -1;
    for (const auto& face : kFaces) {
        const Vec3d a = simplex.difference[face[0]];
        const Vec3d n = cross(simplex.difference[face[1]] - a, simplex.difference[face[2]] - a);
        const double origin = -dot(n, a), opposite = dot(n, simplex.difference[face[3]] - a);
        if (origin * opposite > 0) continue;
        const Part part = closest_of_triangle(simplex, face[0], face[1], face[2]);
        const Vec3d p = point(simplex, part);
        const double square = dot(p, p);
        if (best >= 0 && square >= best) continue;
        best = square;
        nearest = part;
    }
    return nearest;
}

Part closest_part(const Simplex& simplex) {
    switch (simplex.count) {
        case 1:
            return part_of(0);
        case 2:
            return closest_of_segment(simplex, 0, 1);
        case 3:
            return closest_of_triangle(simplex, 0, 1, 2);
        default:
            return closest_of_tetrahedron(simplex);
    }
}

// Drops all corners but those of `part`, whose order is kept.
void keep(Simplex& simplex, const Part& part) {
    Simplex kept;
    kept.count = part.count;
    for (int k = 0; k < part.count; ++k) {
        const int from = part.kept[k];
        kept.difference[k] = simplex.difference[from];
        kept.index_a[k] = simplex.index_a[from], kept.index_b[k] = simplex.index_b[from];
        kept.weight[k] = part.weight[k];
    }
    for (int k = 0; k < kept.count; ++k) {
        simplex.difference[k] = kept.difference[k];
        simplex.index_a[k] = kept.index_a[k], simplex.index_b[k] = kept.index_b[k];
        simplex.weight[k] = kept.weight[k];
    }
    simplex.count = kept.count;
}

// 40 rounds: hulls of 32 points take 4 to 12; what is not done by then keeps its best distance.
constexpr int kRounds = 40;
constexpr double kTouching = 1e-7;  // m: closer than this has no direction and counts as touching
constexpr double kAgreed = 1e-7;    // m between distance and bound

}  // namespace

// Without a branch, for which of the lanes has it is anyone's guess.
uint32_t support(const Points& p, Vec3 d) {
    typedef int32_t Numbers __attribute__((vector_size(16)));
    Lanes best = Lanes{} - kFar;
    Numbers number = {0, 1, 2, 3}, best_number = number;
    for (uint32_t k = 0; k < p.count; k += kLanes) {
        const Lanes along = load(p.x + k) * d.x + load(p.y + k) * d.y + load(p.z + k) * d.z;
        const Numbers is_farther = along > best;
        best = most(along, best);
        best_number = is_farther ? number : best_number;
        number += static_cast<int32_t>(kLanes);
    }
    Lanes top = most(best, __builtin_shufflevector(best, best, 2, 3, 0, 1));
    top = most(top, __builtin_shufflevector(top, top, 1, 0, 3, 2));
    const Numbers none = {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX};
    Numbers lowest = best == top ? best_number : none, other = __builtin_shufflevector(lowest, lowest, 2, 3, 0, 1);
    lowest = other < lowest ? other : lowest;
    other = __builtin_shufflevector(lowest, lowest, 1, 0, 3, 2);
    lowest = other < lowest ? other : lowest;
    return static_cast<uint32_t>(lowest[0]);
}

double gap_along(const Points& a, const Points& b, Vec3d axis) {
    const Vec3 direction = axis.to_float();
    const Vec3d low(a[support(a, -direction)]), high(b[support(b, direction)]);
    return dot(axis, (Vec3d(a.centre) - Vec3d(b.centre)) + low - high);
}

Closest closest_points(const Points& a, const Points& b, Vec3d guess, double enough, const Ways& ways) {
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
        const uint32_t index_a = support(a, -direction), index_b = support(b, direction);
        const Vec3d difference = Vec3d(a[index_a]) - (Vec3d(b[index_b]) + offset);
        const double gap = dot(axis, difference);
        if (gap > best.bound) best.bound = gap, best.axis = axis;
        if (gap > enough + std::max(0.0, dot(axis, ways.first)) + std::max(0.0, dot(axis, ways.second))) {
            best.is_beyond = true;
            best.is_apart = true;
            best.distance = gap;
            best.axis = axis;
            return best;
        }
        bool is_known = simplex.count > 0 && l - gap < kAgreed;
        for (int k = 0; k < simplex.count; ++k)
            is_known |= simplex.index_a[k] == index_a && simplex.index_b[k] == index_b;
        if (is_known) break;
        const int count = simplex.count++;
        simplex.difference[count] = difference;
        simplex.index_a[count] = index_a, simplex.index_b[count] = index_b;
        const Part part = closest_part(simplex);
        if (part.count == 0) return best;  // the origin is inside
        const Vec3d closer = point(simplex, part);
        const double closer_square = dot(closer, closer);
        if (closer_square < kTouching * kTouching) return best;
        if (closer_square >= square) {  // rounding: no progress, the last one was best
            simplex.count = count;
            break;
        }
        keep(simplex, part);
        v = closer;
        square = closer_square;
    }
    best.is_apart = true;
    best.distance = length(v);
    best.axis = (1 / best.distance) * v;
    for (int k = 0; k < simplex.count; ++k) {
        best.on_a += simplex.weight[k] * Vec3d(a[simplex.index_a[k]]);
        best.on_b += simplex.weight[k] * (Vec3d(b[simplex.index_b[k]]) + offset);
    }
    return best;
}

}  // namespace cullet::bullet
