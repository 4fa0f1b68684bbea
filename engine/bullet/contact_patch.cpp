#include "engine/bullet/contact_patch.hpp"

#include <algorithm>

#include "engine/bullet/box_patch.hpp"
#include "engine/bullet/closest_points.hpp"
#include "engine/bullet/contact_spots.hpp"
#include "engine/bullet/overlap_axis.hpp"
#include "engine/lanes.hpp"

namespace cullet::bullet {

using namespace lanes;

PatchFrame make_frame(Vec3 n) {
    // The world axis least along the normal, ties to x then y, gives the first direction.
    const Vec3 s{std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)};
    const Vec3 axis = s.x <= s.y && s.x <= s.z ? Vec3{1, 0, 0} : s.y <= s.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    const Vec3 right = normalised(cross(axis, n));
    return {n, right, cross(n, right)};
}

namespace {

// Height of a supporting plane over the patch's plane: at + slope_x x + slope_y y.
struct Plane {
    float at, slope_x, slope_y;
};

constexpr float kFlat = 1e-10f;  // m2, twice an area, of scale 1

// The side of a hull that looks at the other one: its supporting planes, and the outline of its points in the patch's
// plane.
struct Side {
    Plane plane[kMaxFaces + 1];  // and one written in vain
    uint32_t plane_count = 0;
    Spot outline[kMaxPoints];
    uint32_t outline_count = 0;
    Spot bulge[kMaxPoints];  // low points inside of the outline
    uint32_t bulge_count = 0;
    float flat = kFlat;  // m2, see convex_outline()
};

// A face belongs to the outline when its normal is within 60 degrees of the direction it should look in: the top face
// of a thin shard never does. Its plane bounds the surface out to 84 degrees; steeper ones only magnify rounding.
constexpr float kFacingCosine = 0.5f;
constexpr float kPlaneCosine = 0.1f;
// Lengths are those of a piece of scale 1. Points this close to the support plane belong to the outline too, whatever
// their faces.
constexpr float kSupportDepth = 0.0002f;  // m
// What bulges towards the other hull touches with points inside of its outline: those this close to the support plane
// are offered too. At 0 a curved shard rocks for ever from one of its low points to the other and sinks by 4 mm.
constexpr float kBulgeDepth = 0.003f;  // m

constexpr float kApart = 1e-5f;   // m between cores, below which the direction between them is rounding
constexpr float kAsDeep = 1e-4f;  // m, of two spots of a patch

float area(const Spot& a, const Spot& b, const Spot& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Andrew's monotone chain; points within a hundredth of a square millimetre of a line are left out.
uint32_t convex_outline(Spot* spots, uint32_t count, float flat, Spot* out) {
    std::sort(spots, spots + count, [](const Spot& a, const Spot& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    uint32_t n = 0;
    for (uint32_t k = 0; k < count; ++k) {
        if (k > 0 && spots[k].x == spots[k - 1].x && spots[k].y == spots[k - 1].y) continue;
        while (n >= 2 && area(out[n - 2], out[n - 1], spots[k]) <= flat) --n;
        out[n++] = spots[k];
    }
    const uint32_t lower = n + 1;
    for (uint32_t k = count; k-- > 0;) {
        if (spots[k].x == out[n - 1].x && spots[k].y == out[n - 1].y) continue;
        while (n >= lower && area(out[n - 2], out[n - 1], spots[k]) <= flat) --n;
        out[n++] = spots[k];
    }
    return n > 1 ? n - 1 : n;
}

bool is_inside(const Spot& spot, const Side& side) {
    if (side.outline_count < 3) return false;
    const Spot* from = &side.outline[side.outline_count - 1];
    for (uint32_t e = 0; e < side.outline_count; from = &side.outline[e++])
        if (!(area(*from, side.outline[e], spot) > side.flat)) return false;
    return true;
}

// Of pieces that overlap by more, m, all that lies in the other is offered.
// `sign` -1: the side that looks down the normal (hull a); +1: up (hull b). `offset` is the hull's centre in the frame.
void look(const Hull& hull, const Mat3& rotation, const PatchFrame& frame, Vec3 offset, float sign, float overlap,
          Side& side) {
    const float scale = scale_of(hull);
    side.flat = scale * scale * kFlat;
    const Vec3 n = transposed_times(rotation, frame.normal), right = transposed_times(rotation, frame.right),
               forward = transposed_times(rotation, frame.forward);
    const float ox = dot(offset, frame.right), oy = dot(offset, frame.forward), oz = dot(offset, frame.normal);
    uint32_t facing_points = 0;
    for (uint32_t first = 0; first < hull.face_count; first += kLanes) {
        const LaneVec normal = load(&hull.face_normal[first]);
        const Lanes along = normal.x * n.x + normal.y * n.y + normal.z * n.z;
        const Lanes sx = -(normal.x * right.x + normal.y * right.y + normal.z * right.z) / along,
                    sy = -(normal.x * forward.x + normal.y * forward.y + normal.z * forward.z) / along,
                    at = oz + load(&hull.face_height[first]) / along - sx * ox - sy * oy;
        // All are written, and the next one over those that look away: whether one does is anyone's guess.
        for (uint32_t k = 0; k < kLanes && first + k < hull.face_count; ++k) {
            const float facing = sign * along[k];
            side.plane[side.plane_count] = {at[k], sx[k], sy[k]};
            side.plane_count += facing >= kPlaneCosine;
            facing_points |= facing >= kFacingCosine ? hull.face_points[first + k] : 0;
        }
    }
    alignas(Lanes) float height[kMaxPoints];  // towards the other hull
    const Points& points = hull.local;
    Lanes tops = Lanes{} - kFar;
    for (uint32_t k = 0; k < points.count; k += kLanes) {
        const Lanes high = sign * (load(points.x + k) * n.x + load(points.y + k) * n.y + load(points.z + k) * n.z);
        store(high, height + k);
        tops = most(high, tops);
    }
    const float top = std::max(std::max(tops[0], tops[1]), std::max(tops[2], tops[3]));
    const auto spot_at = [&](uint32_t k) {
        const Vec3 p = points[k];
        return Spot{ox + dot(p, right), oy + dot(p, forward), 0, 0};
    };
    Spot spots[kMaxPoints + 1];
    uint32_t count = 0;
    for (uint32_t k = 0; k < hull.point_count; ++k) {
        spots[count] = spot_at(k);
        count += (facing_points >> k & 1) != 0 || height[k] > top - scale * kSupportDepth;
    }
    Spot chain[2 * kMaxPoints + 2];
    side.outline_count = convex_outline(spots, count, side.flat, chain);
    std::copy_n(chain, side.outline_count, side.outline);
    if (side.plane_count == 0) side.plane[side.plane_count++] = {oz + sign * top, 0, 0};
    // Points of the outline are not inside of it.
    for (uint32_t k = 0; k < hull.point_count && side.outline_count >= 3; ++k) {
        if (!(height[k] > top - std::max(scale * kBulgeDepth, overlap))) continue;
        const Spot spot = spot_at(k);
        if (is_inside(spot, side)) side.bulge[side.bulge_count++] = spot;
    }
}

// Sutherland and Hodgman: what of the polygon (or segment, or point) `spots` lies in the convex `clip`.
uint32_t clip_outline(const Side& subject, const Side& clip, Spot* spots) {
    Spot other[2 * kMaxPoints];
    uint32_t count = subject.outline_count;
    std::copy_n(subject.outline, count, spots);
    for (uint32_t e = 0; e < clip.outline_count && count > 0; ++e) {
        const Spot &p = clip.outline[e], &q = clip.outline[e + 1 == clip.outline_count ? 0 : e + 1];
        uint32_t kept = 0;
        float there = area(p, q, spots[0]);
        for (uint32_t k = 0; k < count; ++k) {
            const Spot &now = spots[k], &next = spots[k + 1 == count ? 0 : k + 1];
            const float here = there;
            there = area(p, q, next);
            if (here >= 0) other[kept++] = now;
            if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
                const float t = here / (here - there);
                other[kept++] = {now.x + t * (next.x - now.x), now.y + t * (next.y - now.y), 0, 0};
            }
            if (count == 1) break;
        }
        count = std::min(kept, 2 * kMaxPoints - 2);
        std::copy_n(other, count, spots);
    }
    return count;
}

// Four spots at a time: `count` is made up to whole lanes by repeating the last one.
void measure(Spot* spots, uint32_t count, const Side& a, const Side& b) {
    static_assert(sizeof(Spot) == sizeof(Lanes) && 4 * kMaxPoints % kLanes == 0);
    for (uint32_t k = count; k % kLanes != 0; ++k) spots[k] = spots[count - 1];
    for (uint32_t first = 0; first < count; first += kLanes) {
        float* const at = &spots[first].x;
        Lanes x = load(at), y = load(at + 4), low_a = load(at + 8), high_b = load(at + 12);
        transpose(x, y, low_a, high_b);
        low_a = Lanes{} - kFar, high_b = Lanes{} + kFar;
        for (uint32_t k = 0; k < a.plane_count; ++k)
            low_a = most(a.plane[k].at + a.plane[k].slope_x * x + a.plane[k].slope_y * y, low_a);
        for (uint32_t k = 0; k < b.plane_count; ++k)
            high_b = least(b.plane[k].at + b.plane[k].slope_x * x + b.plane[k].slope_y * y, high_b);
        transpose(x, y, low_a, high_b);
        store(x, at), store(y, at + 4), store(low_a, at + 8), store(high_b, at + 12);
    }
}

// A millimetre of depth counts as 20 mm of distance: a shard that rocks on two spots must have both of them, whatever
// lies farther out and does not touch yet. At 0 it rocks on for ever, each step on the spot that it was given, and
// sinks by 9 mm; the noise of a level patch (a micrometre) moves no choice.
constexpr float kPatchDepthWeight = 20;

float flat_distance(const Spot& a, const Spot& b) {
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

// Among spots where the cores overlap place alone counts: what is stuck deep in a floor needs its corners.
float raised(const Spot& s) {
    return kPatchDepthWeight * std::max(gap(s), 0.0f);
}

template <class Value>
uint32_t pick(const Spot* spots, uint32_t count, Value&& value) {
    uint32_t best = 0;
    float most = -kFar;
    for (uint32_t k = 0; k < count; ++k) {
        const float v = value(spots[k]);
        if (v > most) best = k, most = v;
    }
    return best;
}

// Some of the four may be one spot.
void choose_corners(const Spot* spots, uint32_t count, uint32_t (&four)[kPatchPoints]) {
    four[0] = pick(spots, count, [&](const Spot& s) { return s.x + 0.37f * s.y - raised(s); });
    const Spot& first = spots[four[0]];
    four[1] = pick(spots, count, [&](const Spot& s) { return flat_distance(s, first) - raised(s); });
    const Spot& second = spots[four[1]];
    // A thousandth of a millimetre: where both are one spot, all areas are zero.
    const float base = flat_distance(first, second) + 1e-6f;
    const auto beside = [&](const Spot& s) { return area(first, second, s) / base; };
    four[2] = pick(spots, count, [&](const Spot& s) { return beside(s) - raised(s); });
    four[3] = pick(spots, count, [&](const Spot& s) { return -beside(s) - raised(s); });
}

// Four of many: the extreme ones of a fixed direction, then of area, so that a resting patch picks the same corners
// every step. The deepest takes a place that is left, or that of the nearest of them, when none of them is within 0.1
// mm of it. In the place of the shallowest it took the only spot at the other end of a bent slab, which rocked from one
// end to the other, 17 mm deep in a floor with both.
int choose_four(const Spot* spots, uint32_t count, float scale, uint32_t (&chosen)[kPatchPoints]) {
    if (count <= kPatchPoints) {
        for (uint32_t k = 0; k < count; ++k) chosen[k] = k;
        return static_cast<int>(count);
    }
    uint32_t four[kPatchPoints];
    choose_corners(spots, count, four);
    int kept = 0;
    float least = kFar;
    for (const uint32_t k : four) {
        if (std::find(chosen, chosen + kept, k) != chosen + kept) continue;
        chosen[kept++] = k;
        least = std::min(least, gap(spots[k]));
    }
    const uint32_t deepest = pick(spots, count, [](const Spot& s) { return -gap(s); });
    if (!(gap(spots[deepest]) < least - scale * kAsDeep)) return kept;
    if (kept < kPatchPoints) {
        chosen[kept++] = deepest;
        return kept;
    }
    *std::min_element(chosen, chosen + kept, [&](uint32_t a, uint32_t b) {
        return flat_distance(spots[a], spots[deepest]) < flat_distance(spots[b], spots[deepest]);
    }) = deepest;
    return kept;
}

// m, see overlap_axis(). The own axis of two pieces was seen while they were still apart and is the truth; a
// neighbour's is a hint.
constexpr double kOwnTurning = 0.004;
constexpr double kBorrowedTurning = 0.003;

}  // namespace

bool is_through_seam(const Hull& hull, const Mat3& rotation, Vec3 outwards) {
    const Vec3 local = transposed_times(rotation, outwards);
    for (uint32_t f = 0; f < hull.face_count; ++f)
        if (hull.is_face_inner[f] && dot(hull.face_normal[f], local) > 0.8f) return true;
    return false;
}

namespace {

struct Touch {
    bool is_near = false, is_through_seam = false;
    Vec3 normal;
    float gap = 0;  // of the cores
    float room = 0;
    Vec3 middle;  // between the closest points, from the centre of a
};

Touch find_touch(const Hull& a, const Mat3& rotation_a, const Hull& b, const Mat3& rotation_b, Vec3& guess,
                 bool is_own_guess) {
    const float scale = scale_of(a, b), reach = scale * kContactRange + a.margin + b.margin;
    const Vec3d before(guess);
    const Closest closest = closest_points(a.world, b.world, before, reach);
    guess = closest.axis.to_float();
    Touch touch;
    if (closest.is_apart && closest.bound > reach) {
        touch.room = static_cast<float>(closest.bound - reach);
        return touch;
    }
    // Closer than this the direction between the points is rounding: take the axis of least overlap.
    if (closest.is_apart && closest.distance > static_cast<double>(scale * kApart)) {
        if (closest.distance > reach) return touch;
        touch.is_through_seam = is_through_seam(a, rotation_a, -guess) || is_through_seam(b, rotation_b, guess);
        touch.is_near = true;
        touch.gap = static_cast<float>(closest.distance);
        touch.normal = guess;
        touch.middle = (0.5 * (closest.on_a + closest.on_b)).to_float();
        return touch;
    }
    touch.is_near = true;
    const OverlapAxis least =
        overlap_axis(a, rotation_a, b, rotation_b, before,
                     static_cast<double>(scale) * (is_own_guess ? kOwnTurning : kBorrowedTurning));
    if (least.is_found) {
        guess = least.axis.to_float();
        touch.gap = static_cast<float>(least.gap);
    } else {
        touch.gap = std::min(0.0f, static_cast<float>(closest.bound));
    }
    touch.normal = guess;
    const Vec3 low = a.world[support(a.world, -guess)], offset = b.world.centre - a.world.centre;
    const Vec3 high = b.world[support(b.world, guess)] + offset;
    // A crossing of edges lies near both support points; the smaller hull's is the better one.
    touch.middle = a.radius <= b.radius ? low : high;
    return touch;
}

void add_point(Patch& patch, const Hull& a, const Hull& b, Vec3 from_centre, float low_a, float high_b) {
    const float distance = low_a - a.margin - high_b - b.margin;
    if (distance > scale_of(a, b) * kContactRange || patch.count == kPatchPoints) return;
    const Vec3 flat = a.world.centre + from_centre;
    patch.point[patch.count++] = {flat + (low_a - a.margin) * patch.normal, flat + (high_b + b.margin) * patch.normal,
                                  distance, patch.normal};
}

// The touch itself as a point: all there is for spheres, corners and crossing edges.
void add_touch(Patch& patch, const Hull& a, const Hull& b, const Touch& touch) {
    const float height = dot(touch.middle, touch.normal);
    const bool is_apart = touch.gap > scale_of(a, b) * kApart;
    const float low = is_apart ? height + 0.5f * touch.gap : a.radius <= b.radius ? height : height + touch.gap;
    add_point(patch, a, b, touch.middle - height * touch.normal, low, low - touch.gap);
}

void set_nearest(Patch& patch, const Hull& a, const Hull& b, const Touch& touch) {
    patch.has_nearest = touch.gap > scale_of(a, b) * kApart;
    if (!patch.has_nearest) return;
    const Vec3 middle = a.world.centre + touch.middle;
    patch.nearest_on_a = middle + (0.5f * touch.gap - a.margin) * touch.normal;
    patch.nearest_on_b = middle - (0.5f * touch.gap - b.margin) * touch.normal;
}

}  // namespace

void add_best_spots(Patch& patch, const Hull& a, const Hull& b, const PatchFrame& frame, const Spot* spots,
                    uint32_t count) {
    uint32_t chosen[kPatchPoints];
    const int kept = choose_four(spots, count, scale_of(a, b), chosen);
    for (int k = 0; k < kept && patch.count < kPatchPoints; ++k) {
        const Spot& s = spots[chosen[k]];
        add_point(patch, a, b, s.x * frame.right + s.y * frame.forward, s.low_a, s.high_b);
    }
}

namespace {

// Where the sides that face each other lie over each other, no farther apart than contacts reach. With a frame of its
// own, so that none on the stack is large.
[[gnu::noinline]] uint32_t facing_spots(const Hull& a, const Mat3& rotation_a, const Hull& b, const Mat3& rotation_b,
                                        const PatchFrame& frame, float overlap, Spot (&spots)[4 * kMaxPoints]) {
    if (a.point_count == 1 || b.point_count == 1) return 0;
    Side side_a, side_b;
    look(a, rotation_a, frame, {}, -1, overlap, side_a);
    look(b, rotation_b, frame, b.world.centre - a.world.centre, 1, overlap, side_b);
    uint32_t count = 0;
    if (side_b.outline_count >= 3)
        count = clip_outline(side_a, side_b, spots);
    else if (side_a.outline_count >= 3)
        count = clip_outline(side_b, side_a, spots);
    for (uint32_t k = 0; k < side_a.bulge_count; ++k)
        if (is_inside(side_a.bulge[k], side_b)) spots[count++] = side_a.bulge[k];
    for (uint32_t k = 0; k < side_b.bulge_count; ++k)
        if (is_inside(side_b.bulge[k], side_a)) spots[count++] = side_b.bulge[k];
    const float reach = scale_of(a, b) * kContactRange + a.margin + b.margin;
    uint32_t kept = 0;
    measure(spots, count, side_a, side_b);
    for (uint32_t k = 0; k < count; ++k)
        if (gap(spots[k]) <= reach) spots[kept++] = spots[k];
    return kept;
}

// A ball over a face, or this little past its edges.
constexpr float kPastEdge = 0.0005f;  // m

bool is_over(const Spot& spot, const Side& side, float slack) {
    if (side.outline_count < 3) return false;
    const Spot* from = &side.outline[side.outline_count - 1];
    for (uint32_t e = 0; e < side.outline_count; from = &side.outline[e++]) {
        const Spot& to = side.outline[e];
        const float size = std::sqrt((to.x - from->x) * (to.x - from->x) + (to.y - from->y) * (to.y - from->y));
        if (area(*from, to, spot) < -slack * size) return false;
    }
    return true;
}

// The lowest point of a ball over the side of the other hull.
[[gnu::noinline]] void add_ball(Patch& patch, const Hull& a, const Mat3& rotation_a, const Hull& b,
                                const Mat3& rotation_b, const PatchFrame& frame) {
    const bool is_a_ball = a.point_count == 1;
    const Vec3 to_b = b.world.centre - a.world.centre, at = is_a_ball ? Vec3{} : to_b;
    Side side;
    look(is_a_ball ? b : a, is_a_ball ? rotation_b : rotation_a, frame, is_a_ball ? to_b : Vec3{},
         is_a_ball ? 1.0f : -1.0f, 0, side);
    Spot spot{dot(at, frame.right), dot(at, frame.forward), 0, 0};
    if (!is_over(spot, side, scale_of(a, b) * kPastEdge + (is_a_ball ? b.margin : a.margin))) return;
    spot.low_a = spot.high_b = dot(at, patch.normal);
    for (uint32_t k = 0; k < side.plane_count; ++k) {
        const Plane& plane = side.plane[k];
        const float height = plane.at + plane.slope_x * spot.x + plane.slope_y * spot.y;
        if (k == 0 || (is_a_ball ? height < spot.high_b : height > spot.low_a))
            (is_a_ball ? spot.high_b : spot.low_a) = height;
    }
    if (gap(spot) <= scale_of(a, b) * kContactRange + a.margin + b.margin) add_best_spots(patch, a, b, frame, &spot, 1);
}

}  // namespace

Patch patch_along(const Hull& a, const Mat3& rotation_a, const Hull& b, const Mat3& rotation_b, Vec3 normal) {
    Patch patch;
    patch.normal = normal;
    const PatchFrame frame = make_frame(normal);
    Spot spots[4 * kMaxPoints];
    const auto apart = static_cast<float>(gap_along(a.world, b.world, Vec3d(normal)));
    const uint32_t count = facing_spots(a, rotation_a, b, rotation_b, frame, std::max(0.0f, -apart), spots);
    add_best_spots(patch, a, b, frame, spots, count);
    if (a.point_count == 1 || b.point_count == 1) add_ball(patch, a, rotation_a, b, rotation_b, frame);
    return patch;
}

Patch contact_patch(const Hull& a, const Mat3& rotation_a, const Hull& b, const Mat3& rotation_b, Vec3& guess,
                    bool is_own_guess) {
    Patch patch;
    if (box_patch(a, rotation_a, b, rotation_b, guess, patch)) return patch;
    const Touch touch = find_touch(a, rotation_a, b, rotation_b, guess, is_own_guess);
    patch.room = touch.room;
    if (!touch.is_near) return patch;
    patch.normal = touch.normal;
    patch.is_through_seam = touch.is_through_seam;
    set_nearest(patch, a, b, touch);
    Spot spots[4 * kMaxPoints];
    const float scale = scale_of(a, b);
    const PatchFrame frame = make_frame(touch.normal);
    const uint32_t count = facing_spots(a, rotation_a, b, rotation_b, frame, std::max(0.0f, -touch.gap), spots);
    float shallow = kFar;
    for (uint32_t k = 0; k < count; ++k) shallow = std::min(shallow, gap(spots[k]));
    // Of a triangle that the cores lie in, the spots over it are all that lies in it: the least overlap is that of what
    // goes on past its edges.
    const bool is_measured = (a.one_sided || b.one_sided) && !(touch.gap > 0) && count > 0;
    if (!is_measured && touch.gap < shallow - scale * kAsDeep) {
        add_touch(patch, a, b, touch);
        // Keep room: the touch is the deepest point of the patch, the corners that lie around it are held up by it.
        if (count == 0) return patch;
    }
    add_best_spots(patch, a, b, frame, spots, count);
    return patch;
}

float separation(const Hull& a, const Hull& b, Vec3& guess, float enough) {
    const float margins = a.margin + b.margin;
    const Closest closest = closest_points(a.world, b.world, Vec3d(guess), enough + margins);
    if (!closest.is_apart) return -1;
    guess = closest.axis.to_float();
    return static_cast<float>(closest.distance) - margins;
}

}  // namespace cullet::bullet
