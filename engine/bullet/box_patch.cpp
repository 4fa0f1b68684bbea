#include "engine/bullet/box_patch.hpp"

#include <algorithm>
#include <utility>

#include "engine/bullet/contact_spots.hpp"

namespace cullet::bullet {
namespace {

constexpr float kApart = 1e-5f;    // m: closer cores have no direction between them to trust
constexpr float kAsNear = 1e-5f;   // m, between the face's gap and that of the nearest point above it
constexpr float kClearly = 1e-6f;  // m that a later face must be better by, so that ties keep their face
// Faces more parallel than this (1.1 degrees) touch along any direction between their normals: the one nearest to the
// last one. Along the normal of one of them, be it always the upper one's, a stack leans ever farther to the side that
// it leans to.
constexpr float kParallel = 0.9998f;
constexpr uint32_t kMostCorners = 8;

/// The core of a box about its centre, world axes.
struct Core {
    Vec3 axis[3];
    float half[3];
};
Core core_of(const Hull& hull, const Mat3& rotation) {
    Core core;
    for (int k = 0; k < 3; ++k) core.axis[k] = rotation * hull.box_axis[k], core.half[k] = hull.box_half[k];
    return core;
}

/// A face of one of the two: its axis, which of the two it is of, and the gap between the cores along it.
struct Facing {
    bool is_of_b = true;
    int axis = 0;
    float gap = -kFar;
    Vec3 normal;  // from b towards a
};

Facing widest_gap(const Core& a, const Core& b, Vec3 to_a) {
    float cosine[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) cosine[i][j] = std::fabs(dot(a.axis[i], b.axis[j]));
    Facing best;
    const auto try_face = [&](bool is_of_b, int axis, Vec3 along, float own, float other) {
        const float way = dot(to_a, along), gap = std::fabs(way) - own - other;
        if (gap > best.gap + kClearly) best = {is_of_b, axis, gap, way < 0 ? -along : along};
    };
    for (int j = 0; j < 3; ++j)
        try_face(true, j, b.axis[j], b.half[j],
                 cosine[0][j] * a.half[0] + cosine[1][j] * a.half[1] + cosine[2][j] * a.half[2]);
    for (int i = 0; i < 3; ++i)
        try_face(false, i, a.axis[i], a.half[i],
                 cosine[i][0] * b.half[0] + cosine[i][1] * b.half[1] + cosine[i][2] * b.half[2]);
    return best;
}

// The direction between two unit vectors that is nearest to a third one; midway when that is zero.
Vec3 nearest_between(Vec3 from, Vec3 to, Vec3 wanted) {
    const Vec3 way = to - from;
    const float square = dot(way, way);
    if (!(square > 0)) return from;
    const float share = dot(wanted, wanted) > 0 ? std::clamp(dot(wanted - from, way) / square, 0.0f, 1.0f) : 0.5f;
    return normalised(from + share * way);
}

/// A point over the face, in its own two axes; `height` over it.
struct Corner {
    float x, y, height;
};

// Sutherland and Hodgman at one side of the face: keeps what has sign * (x or y) <= most.
template <float Corner::*Along>
uint32_t clip(const Corner* in, uint32_t count, float sign, float most, Corner* out) {
    uint32_t kept = 0;
    for (uint32_t k = 0; k < count; ++k) {
        const Corner &now = in[k], &next = in[k + 1 == count ? 0 : k + 1];
        const float here = most - sign * (now.*Along), there = most - sign * (next.*Along);
        if (here >= 0 && kept < kMostCorners) out[kept++] = now;
        if (!((here > 0 && there < 0) || (here < 0 && there > 0)) || kept == kMostCorners) continue;
        const float t = here / (here - there);
        out[kept++] = {now.x + t * (next.x - now.x), now.y + t * (next.y - now.y),
                       now.height + t * (next.height - now.height)};
    }
    return kept;
}

/// The face of a box that looks most against a direction: its axis and outward normal.
struct Looking {
    int axis = 0;
    Vec3 normal;
};
Looking looks_against(const Core& core, Vec3 direction) {
    Looking out;
    float most = -1;
    for (int k = 0; k < 3; ++k) {
        const float cosine = dot(core.axis[k], direction);
        if (std::fabs(cosine) > most) most = std::fabs(cosine), out = {k, cosine > 0 ? -core.axis[k] : core.axis[k]};
    }
    return out;
}

// The looking face of `other`, cut to what lies above the facing one. `to_other` leads between the centres, `out` is
// the facing one's normal, `x` and `y` are the axes of its sides.
uint32_t cut_above(const Core& own, const Core& other, const Looking& looking, int face, int x, int y, Vec3 out,
                   Vec3 to_other, Corner (&corners)[kMostCorners]) {
    const int u = (looking.axis + 1) % 3, v = (looking.axis + 2) % 3;
    const Vec3 middle = to_other + other.half[looking.axis] * looking.normal;
    const Vec3 side_u = other.half[u] * other.axis[u], side_v = other.half[v] * other.axis[v];
    const auto seen = [&](Vec3 p) { return Corner{dot(p, own.axis[x]), dot(p, own.axis[y]), dot(p, out)}; };
    const Corner at = seen(middle), by_u = seen(side_u), by_v = seen(side_v);
    constexpr float kSigns[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    Corner cut[kMostCorners];
    for (int k = 0; k < 4; ++k) {
        const float p = kSigns[k][0], q = kSigns[k][1];
        corners[k] = {at.x + p * by_u.x + q * by_v.x, at.y + p * by_u.y + q * by_v.y,
                      at.height + p * by_u.height + q * by_v.height - own.half[face]};
    }
    uint32_t count = clip<&Corner::x>(corners, 4, 1, own.half[x], cut);
    count = clip<&Corner::x>(cut, count, -1, own.half[x], corners);
    count = clip<&Corner::y>(corners, count, 1, own.half[y], cut);
    return clip<&Corner::y>(cut, count, -1, own.half[y], corners);
}

// What is solved last holds best: the deepest, so that a stack which leans is lifted where it leans to.
void sort_by_depth(Spot* spots, uint32_t count) {
    for (uint32_t end = 1; end < count; ++end)
        for (uint32_t k = end; k > 0 && gap(spots[k]) > gap(spots[k - 1]); --k) std::swap(spots[k], spots[k - 1]);
}

}  // namespace

// By the separating axis theorem the gap along any axis is at most the distance; a point above the face that is as near
// as its gap shows that it is the distance.
bool box_patch(const Hull& a, const Mat3& rotation_a, const Hull& b, const Mat3& rotation_b, Vec3& guess,
               Patch& patch) {
    if (!a.is_box || !b.is_box) return false;
    const Core core_a = core_of(a, rotation_a), core_b = core_of(b, rotation_b);
    const Vec3 to_a = a.world.centre - b.world.centre;
    const Facing facing = widest_gap(core_a, core_b, to_a);
    const float reach = scale_of(a, b) * kContactRange + a.margin + b.margin;
    if (facing.gap > reach) {
        guess = facing.normal;
        patch.room = facing.gap - reach;
        return true;
    }
    if (facing.gap < kApart) return false;
    const Core &own = facing.is_of_b ? core_b : core_a, &other = facing.is_of_b ? core_a : core_b;
    const Vec3 out = facing.is_of_b ? facing.normal : -facing.normal, to_other = facing.is_of_b ? to_a : -to_a;
    const int x = (facing.axis + 1) % 3, y = (facing.axis + 2) % 3;
    Corner corners[kMostCorners];
    const Looking looking = looks_against(other, out);
    const uint32_t count = cut_above(own, other, looking, facing.axis, x, y, out, to_other, corners);
    float nearest = kFar;
    for (uint32_t k = 0; k < count; ++k) nearest = std::min(nearest, corners[k].height);
    if (nearest > facing.gap + kAsNear) return false;
    const bool is_parallel = -dot(looking.normal, out) > kParallel;
    const Vec3 before = facing.is_of_b ? guess : -guess;
    const Vec3 along = is_parallel ? nearest_between(out, -looking.normal, before) : out;  // to the other one
    guess = patch.normal = facing.is_of_b ? along : -along;
    patch.is_through_seam =
        is_through_seam(a, rotation_a, -patch.normal) || is_through_seam(b, rotation_b, patch.normal);
    const PatchFrame frame = make_frame(patch.normal);
    const Vec3 from_a = facing.is_of_b ? -to_a : Vec3{};  // the centre of the face's box
    const float stretched = 1 / dot(along, out);
    Spot spots[kMostCorners];
    uint32_t kept = 0;
    for (uint32_t k = 0; k < count; ++k) {
        const Corner& c = corners[k];
        const float apart = stretched * c.height;
        if (apart > reach) continue;
        const Vec3 p = from_a + c.x * own.axis[x] + c.y * own.axis[y] + (c.height + own.half[facing.axis]) * out;
        const float height = dot(p, patch.normal);
        spots[kept++] = {dot(p, frame.right), dot(p, frame.forward), facing.is_of_b ? height : height + apart,
                         facing.is_of_b ? height - apart : height};
    }
    sort_by_depth(spots, kept);
    add_best_spots(patch, a, b, frame, spots, kept);
    return true;
}

}  // namespace cullet::bullet
