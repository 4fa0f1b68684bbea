#include "systems/hulls/triangle_test.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr double kCosineOfFold = 0.99950656036573155701;  // 1.8 degrees

bool separates(Vec3d axis, const Vec3d* a, int a_count, const Vec3d* b) {
    double a_low = dot(axis, a[0]), a_high = a_low, b_low = dot(axis, b[0]), b_high = b_low;
    for (int k = 1; k < a_count; ++k) {
        const double d = dot(axis, a[k]);
        a_low = std::min(a_low, d), a_high = std::max(a_high, d);
    }
    for (int k = 1; k < 3; ++k) {
        const double d = dot(axis, b[k]);
        b_low = std::min(b_low, d), b_high = std::max(b_high, d);
    }
    const double gap = std::max(b_low - a_high, a_low - b_high);
    return gap > 0 && gap * gap > kLeastGap * kLeastGap * dot(axis, axis);
}

// Axis number: 0 between the centroids, 1 and 2 the normals, 3 to 11 products of edges, 12 to 17 in the two planes.
Vec3d triangle_axis(int which, const Vec3d* a, const Vec3d* b) {
    const auto edge = [](const Vec3d* t, int k) { return t[(k + 1) % 3] - t[k]; };
    const auto normal = [](const Vec3d* t) { return cross(t[1] - t[0], t[2] - t[0]); };
    if (which == 0) return (a[0] + a[1] + a[2]) - (b[0] + b[1] + b[2]);
    if (which == 1) return normal(a);
    if (which == 2) return normal(b);
    if (which < 12) return cross(edge(a, (which - 3) / 3), edge(b, (which - 3) % 3));
    if (which < 15) return cross(normal(a), edge(a, which - 12));
    return cross(normal(b), edge(b, which - 15));
}

bool triangles_apart(const Vec3d* a, const Vec3d* b, uint8_t& hint) {
    if (separates(triangle_axis(hint, a, b), a, 3, b)) return true;
    for (uint8_t which = 0; which < 18; ++which)
        if (which != hint && separates(triangle_axis(which, a, b), a, 3, b)) {
            hint = which;
            return true;
        }
    return false;
}

// Segment a[0] a[1] and triangle b: between the centroids, the normal, three products of edges, three in the plane of
// b, and the direction across the segment in that plane.
Vec3d segment_axis(int which, const Vec3d* a, const Vec3d* b) {
    const Vec3d normal = cross(b[1] - b[0], b[2] - b[0]), along = a[1] - a[0];
    if (which == 0) return 1.5 * (a[0] + a[1]) - (b[0] + b[1] + b[2]);
    if (which == 1) return normal;
    if (which == 8) return cross(normal, along);
    const int k = which < 5 ? which - 2 : which - 5;
    const Vec3d edge = b[(k + 1) % 3] - b[k];
    return which < 5 ? cross(along, edge) : cross(normal, edge);
}

bool segment_apart(const Vec3d* a, const Vec3d* b, uint8_t& hint) {
    if (separates(segment_axis(hint, a, b), a, 2, b)) return true;
    for (uint8_t which = 0; which < 9; ++which)
        if (which != hint && separates(segment_axis(which, a, b), a, 2, b)) {
            hint = which;
            return true;
        }
    return false;
}

bool is_folded(Vec3d from, Vec3d to, Vec3d p, Vec3d q) {
    const Vec3d axis = normalised(to - from);
    const Vec3d a = (p - from) - dot(p - from, axis) * axis, b = (q - from) - dot(q - from, axis) * axis;
    return dot(a, b) >= kCosineOfFold * length(a) * length(b);
}

bool has_three_corners(const Corner3& t) {
    return t.id[0] != t.id[1] && t.id[1] != t.id[2] && t.id[2] != t.id[0];
}

}  // namespace

bool are_touching(const Corner3& a, const Corner3& b, AxisHint& hint) {
    if (!has_three_corners(a) || !has_three_corners(b)) return false;
    int shared = 0, a_shared = 0, b_shared = 0;  // sums of corner numbers
    size_t a_at = 0, b_at = 0;
    for (size_t k = 0; k < 3; ++k)
        for (size_t l = 0; l < 3; ++l)
            if (a.id[k] == b.id[l]) {
                ++shared;
                a_shared += static_cast<int>(k), b_shared += static_cast<int>(l);
                a_at = k, b_at = l;
            }
    if (shared == 0) return !triangles_apart(a.point.data(), b.point.data(), hint.first);
    if (shared == 1) {
        const Vec3d a_edge[2] = {a.point[(a_at + 1) % 3], a.point[(a_at + 2) % 3]};
        const Vec3d b_edge[2] = {b.point[(b_at + 1) % 3], b.point[(b_at + 2) % 3]};
        hint.first = std::min<uint8_t>(hint.first, 8), hint.second = std::min<uint8_t>(hint.second, 8);
        return !segment_apart(a_edge, b.point.data(), hint.first) ||
               !segment_apart(b_edge, a.point.data(), hint.second);
    }
    if (shared == 2) {
        const size_t a_free = static_cast<size_t>(3 - a_shared), b_free = static_cast<size_t>(3 - b_shared);
        return is_folded(a.point[(a_free + 1) % 3], a.point[(a_free + 2) % 3], a.point[a_free], b.point[b_free]);
    }
    return false;
}

Vec3d separating_axis(const Corner3& a, const Corner3& b, const AxisHint& hint) {
    for (const uint32_t i : a.id)
        for (const uint32_t j : b.id)
            if (i == j) return {};
    return normalised(triangle_axis(hint.first, a.point.data(), b.point.data()));
}

}  // namespace cullet
