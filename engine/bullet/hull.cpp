#include "engine/bullet/hull.hpp"

#include <algorithm>
#include <array>

#include "engine/bullet/wrap_hull.hpp"
#include "engine/lanes.hpp"

namespace cullet::bullet {

using namespace lanes;
namespace {

void set_points(Points& out, std::span<const Vec3> points) {
    Box box = empty_box();
    for (const Vec3 p : points) include(box, p);
    out.centre = 0.5f * (box.low + box.high);
    out.count = static_cast<uint32_t>((points.size() + 7) / 8 * 8);
    for (uint32_t k = 0; k < out.count; ++k) {
        const Vec3 p = points[k < points.size() ? k : 0] - out.centre;
        out.x[k] = p.x, out.y[k] = p.y, out.z[k] = p.z;
    }
}

struct Heights {
    float low = kFar, high = -kFar;
};

// The plane of a face stands at the outermost of all points, so that every plane is a bound whatever its normal lost.
// Eight lanes do not wait for each other; what repeats the first point changes nothing.
Heights heights_along(const Hull& hull, Vec3 normal) {
    constexpr uint32_t kEight = 8;
    const Points& p = hull.local;
    float low[kEight], high[kEight];
    std::fill_n(low, kEight, kFar);
    std::fill_n(high, kEight, -kFar);
    for (uint32_t k = 0; k < p.count; k += kEight)
        for (uint32_t i = 0; i < kEight; ++i) {
            const float h = normal.x * p.x[k + i] + normal.y * p.y[k + i] + normal.z * p.z[k + i];
            low[i] = h < low[i] ? h : low[i];
            high[i] = h > high[i] ? h : high[i];
        }
    return {*std::min_element(low, low + kEight), *std::max_element(high, high + kEight)};
}

// Newell's normal: twice the area vector of a polygon, sound for corners that are nearly in line.
Vec3d newell(const Hull& hull, uint32_t first, uint32_t end) {
    Vec3d sum;
    const Vec3d origin(hull.local[hull.corner[first]]);
    for (uint32_t c = first + 1; c + 1 < end; ++c)
        sum += cross(Vec3d(hull.local[hull.corner[c]]) - origin, Vec3d(hull.local[hull.corner[c + 1]]) - origin);
    return sum;
}

void set_normals(Hull& hull) {
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        const Vec3d area = newell(hull, hull.first_corner[f], hull.first_corner[f + 1]);
        const double size = length(area);
        // A sliver has no direction to trust: under 1e-7 of the square of the hull's radius its plane is left out.
        const bool is_sliver = !(size > 1e-7 * hull.radius * hull.radius);
        hull.face_normal[f] = is_sliver ? Vec3{} : ((1 / size) * area).to_float();
    }
}

}  // namespace

void set_local_box(Hull& hull) {
    Box box = empty_box();
    for (uint32_t k = 0; k < hull.point_count; ++k) include(box, hull.local.centre + hull.local[k]);
    hull.local_box = grown(box, hull.margin);
}

void set_scale(Hull& hull) {
    hull.scale = hull.one_sided ? 1 : scale_of_width(hull.margin, hull.thickness, hull.point_count == 1);
}

namespace {

void set_hull_points(Hull& hull, std::span<const Vec3> points, float margin, uint32_t cell) {
    hull.cell = cell;
    hull.margin = margin;
    hull.one_sided = false;
    hull.point_count = static_cast<uint32_t>(points.size());
    hull.face_count = hull.edge_count = 0;
    hull.first_corner[0] = 0;
    forget_covered(hull);
    set_points(hull.local, points);
    set_local_box(hull);
    float square = 0;
    for (uint32_t k = 0; k < hull.point_count; ++k) square = std::max(square, dot(hull.local[k], hull.local[k]));
    hull.radius = std::sqrt(square);
    hull.thickness = 2 * (hull.radius + margin);
    set_scale(hull);
}

// Of a hull that was seen in other axes before: heights change with the centre alone, which moved by `shift` (new
// axes).
void turn_faces(Hull& hull, const Mat3& turn, Vec3 shift) {
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        hull.face_normal[f] = turn * hull.face_normal[f];
        hull.face_height[f] -= dot(hull.face_normal[f], shift);
    }
}

void set_heights(Hull& hull) {
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        const Heights heights = heights_along(hull, hull.face_normal[f]);
        hull.face_height[f] = heights.high;
        const float width = heights.high - heights.low + 2 * hull.margin;
        if (dot(hull.face_normal[f], hull.face_normal[f]) > 0.5f) hull.thickness = std::min(hull.thickness, width);
    }
    set_scale(hull);
}

}  // namespace

void set_face_points(Hull& hull) {
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        hull.face_points[f] = 0;
        for (uint32_t c = hull.first_corner[f]; c < hull.first_corner[f + 1]; ++c)
            hull.face_points[f] |= 1u << hull.corner[c];
    }
}

// Three faces square to each other, and every point at half of the width along all three.
void find_box(Hull& hull) {
    constexpr float kSquare = 1e-3f;         // cosine; normals are as good as the grid of wrap_hull()
    const float near = 1e-4f * hull.radius;  // m
    hull.is_box = false;
    if (hull.point_count != 8 || hull.face_count != 6 || hull.edge_count != 12) return;
    uint32_t found = 0;
    for (uint32_t f = 0; f < hull.face_count && found < 3; ++f) {
        const Vec3 n = hull.face_normal[f];
        bool is_square = dot(n, n) > 0.5f;
        for (uint32_t k = 0; k < found; ++k) is_square = is_square && std::fabs(dot(n, hull.box_axis[k])) < kSquare;
        if (!is_square) continue;
        hull.box_axis[found] = n;
        hull.box_half[found++] = hull.face_height[f];
    }
    if (found < 3) return;
    for (uint32_t p = 0; p < hull.point_count; ++p)
        for (uint32_t k = 0; k < 3; ++k)
            if (!(std::fabs(std::fabs(dot(hull.local[p], hull.box_axis[k])) - hull.box_half[k]) < near)) return;
    hull.is_box = true;
}

void build_hull(Hull& hull, std::span<const Vec3> points, float margin, uint32_t cell) {
    points = points.first(std::min<size_t>(points.size(), kMaxPoints));
    set_hull_points(hull, points, margin, cell);
    hull.is_box = false;
    if (points.size() < 3) return;
    wrap_hull(hull);
    bool is_corner[kMaxPoints] = {};
    for (uint32_t c = 0; c < hull.first_corner[hull.face_count]; ++c) is_corner[hull.corner[c]] = true;
    const auto corners = static_cast<uint32_t>(std::count(is_corner, is_corner + hull.point_count, true));
    if (corners >= 4 && corners < hull.point_count) {
        // Points inside of the hull are of no use: again without them.
        Vec3 kept[kMaxPoints];
        uint32_t count = 0;
        for (uint32_t k = 0; k < hull.point_count; ++k)
            if (is_corner[k]) kept[count++] = points[k];
        return build_hull(hull, {kept, count}, margin, cell);
    }
    set_normals(hull);
    set_heights(hull);
    set_face_points(hull);
    find_box(hull);
}

void build_hull_like(Hull& hull, const Hull& like, const Mat3& turn, std::span<const Vec3> points, float margin,
                     uint32_t cell) {
    const uint32_t faces = like.face_count, edges = like.edge_count;  // `like` may be this hull
    const Vec3 first = turn * like.local[0];
    const float width = like.thickness - 2 * like.margin;
    if (&hull != &like) {
        std::copy(std::begin(like.first_corner), std::end(like.first_corner), hull.first_corner);
        std::copy_n(like.corner, like.first_corner[faces], hull.corner);
        std::copy_n(like.face_points, faces, hull.face_points);
        std::copy_n(like.edge, edges, hull.edge);
        std::copy_n(like.face_normal, faces, hull.face_normal);
        std::copy_n(like.face_height, faces, hull.face_height);
    }
    set_hull_points(hull, points, margin, cell);
    hull.face_count = faces;
    hull.edge_count = edges;
    hull.thickness = width + 2 * margin;
    set_scale(hull);
    turn_faces(hull, turn, first - hull.local[0]);
    find_box(hull);
}

void turn_hull(Hull& hull, const Mat3& r, Vec3 origin, float margin, uint32_t cell) {
    constexpr uint32_t kEight = 8;
    Points& p = hull.local;
    const Vec3 centre = r * (p.centre - origin);
    float low[3][kEight], high[3][kEight];
    for (int axis = 0; axis < 3; ++axis) std::fill_n(low[axis], kEight, kFar), std::fill_n(high[axis], kEight, -kFar);
    for (uint32_t k = 0; k < p.count; k += kEight)
        for (uint32_t i = 0; i < kEight; ++i) {
            const float x = p.x[k + i], y = p.y[k + i], z = p.z[k + i];
            float turned[3];
            for (int axis = 0; axis < 3; ++axis) {
                turned[axis] = r.row[axis].x * x + r.row[axis].y * y + r.row[axis].z * z;
                low[axis][i] = turned[axis] < low[axis][i] ? turned[axis] : low[axis][i];
                high[axis][i] = turned[axis] > high[axis][i] ? turned[axis] : high[axis][i];
            }
            p.x[k + i] = turned[0], p.y[k + i] = turned[1], p.z[k + i] = turned[2];
        }
    const auto least = [&](int axis) { return *std::min_element(low[axis], low[axis] + kEight); };
    const auto most = [&](int axis) { return *std::max_element(high[axis], high[axis] + kEight); };
    const Box box{{least(0), least(1), least(2)}, {most(0), most(1), most(2)}};
    // About the middle of the new box.
    const Vec3 shift = 0.5f * (box.low + box.high);
    float square[kEight] = {};
    for (uint32_t k = 0; k < p.count; k += kEight)
        for (uint32_t i = 0; i < kEight; ++i) {
            const float x = p.x[k + i] -= shift.x, y = p.y[k + i] -= shift.y, z = p.z[k + i] -= shift.z;
            const float s = x * x + y * y + z * z;
            square[i] = s > square[i] ? s : square[i];
        }
    p.centre = centre + shift;
    hull.radius = std::sqrt(*std::max_element(square, square + kEight));
    hull.local_box = grown({centre + box.low, centre + box.high}, margin);
    hull.thickness += 2 * (margin - hull.margin);
    hull.margin = margin;
    set_scale(hull);
    hull.cell = cell;
    turn_faces(hull, r, shift);
    find_box(hull);
}

void build_triangle(Hull& hull, const Vec3 (&corners)[3], uint32_t cell, bool is_turned) {
    hull.cell = cell;
    hull.margin = 0;
    hull.one_sided = true;
    set_scale(hull);
    hull.is_turned = is_turned;
    hull.is_box = false;
    hull.point_count = 3;
    hull.face_count = 1;
    hull.edge_count = 0;
    forget_covered(hull);
    set_points(hull.local, corners);
    hull.face_normal[0] =
        normalised(cross(Vec3d(corners[1]) - Vec3d(corners[0]), Vec3d(corners[2]) - Vec3d(corners[0]))).to_float();
    if (is_turned) hull.face_normal[0] = -hull.face_normal[0];
    hull.face_height[0] = dot(hull.face_normal[0], hull.local[0]);
    hull.radius = 0;
    for (uint32_t k = 0; k < 3; ++k) hull.radius = std::max(hull.radius, length(hull.local[k]));
    hull.first_corner[0] = 0, hull.first_corner[1] = 3;
    for (uint8_t k = 0; k < 3; ++k) hull.corner[k] = static_cast<uint8_t>(is_turned ? 2 - k : k);
    hull.face_points[0] = 7;
    refresh_world(hull, Mat3{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {});
}

namespace {

/// The places of a face that are asked for, from its hull's centre: its own middle, its corners in their order, the
/// middles of the edges that begin at them. Those on the rim lie `inwards` of it. Of 32 corners the last place is left
/// out.
class Places {
 public:
    Places(const Hull& hull, uint32_t face, float inwards)
        : hull_(hull),
          first_(hull.first_corner[face]),
          corners_(hull.first_corner[face + 1] - first_),
          inwards_(inwards) {
        for (uint32_t c = 0; c < corners_; ++c) middle_ += (1 / static_cast<float>(corners_)) * corner(c);
    }
    uint32_t count() const { return std::min(1 + 2 * corners_, 64u); }
    Vec3 operator[](uint32_t place) const {
        if (place == 0) return middle_;
        const uint32_t c = (place - 1) % corners_;
        return inside(place <= corners_ ? corner(c) : 0.5f * (corner(c) + corner(c + 1 == corners_ ? 0 : c + 1)));
    }
    static bool is_middle_in(uint64_t covered) { return covered & 1; }
    uint64_t all() const { return count() == 64 ? ~uint64_t{0} : (uint64_t{1} << count()) - 1; }

 private:
    Vec3 corner(uint32_t c) const { return hull_.local[hull_.corner[first_ + c]]; }
    Vec3 inside(Vec3 place) const {
        const Vec3 way = middle_ - place;
        const float far = length(way);
        return place + (far > inwards_ ? inwards_ / far : 1) * way;
    }
    const Hull& hull_;
    uint32_t first_, corners_;
    float inwards_;
    Vec3 middle_;
};

}  // namespace

void forget_covered(Hull& hull) {
    std::fill_n(hull.is_face_inner, kMaxFaces, false);
    std::fill_n(hull.covered, kMaxFaces, 0);
    hull.flush = 0;
}

namespace {

// Planes that differ by less turn no edge between them into one that is felt, and are those of cells that were cut out
// of one flat wall: within a degree, and a tenth of a millimetre (at scale 1) at the middle between the two.
constexpr float kFlushCosine = 0.99985f, kFlushHeight = 0.0001f;

bool is_flush(const Hull& hull, uint32_t f, const Hull& other, uint32_t g, Vec3 between) {
    const float own = hull.face_height[f] + hull.margin - 0.5f * dot(hull.face_normal[f], between);
    const float theirs = other.face_height[g] + other.margin + 0.5f * dot(other.face_normal[g], between);
    return std::fabs(own - theirs) < kFlushHeight * scale_of(hull, other);
}

/// The planes of a piece's faces, four side by side; the last one stands there until four are full.
class Planes {
 public:
    explicit Planes(const Hull& hull) : count_((std::min(hull.face_count, kMaxFaces) + kLanes - 1) / kLanes * kLanes) {
        for (uint32_t k = 0; k < count_; ++k) {
            const uint32_t f = std::min(k, hull.face_count - 1);
            const Vec3 n = hull.face_normal[f];
            x_[k] = n.x, y_[k] = n.y, z_[k] = n.z, height_[k] = hull.face_height[f];
        }
    }
    struct Best {
        uint32_t face;
        float value;
    };
    /// The face that looks most along a direction, and its cosine.
    Best alike(Vec3 direction) const {
        return best([&](uint32_t f) { return along(direction, f); });
    }
    /// The face whose plane a point lies farthest in front of; the point is seen from the piece's centre.
    Best foremost(Vec3 point) const {
        return best([&](uint32_t f) { return along(point, f) - load(&height_[f]); });
    }
    /// No plane has the point farther in front of it. Most places that are asked for lie before the first few.
    bool hold(Vec3 point, float margin) const {
        const Lanes most_before{margin, margin, margin, margin};
        for (uint32_t f = 0; f < count_; f += kLanes)
            if (_mm_movemask_ps(along(point, f) - load(&height_[f]) > most_before) != 0) return false;
        return true;
    }

 private:
    static_assert(kMaxFaces % kLanes == 0);
    Lanes along(Vec3 v, uint32_t f) const { return v.x * load(&x_[f]) + v.y * load(&y_[f]) + v.z * load(&z_[f]); }
    template <class Value>
    Best best(Value value) const {
        Lanes highest{-kFar, -kFar, -kFar, -kFar}, at{}, number{0, 1, 2, 3};
        for (uint32_t f = 0; f < count_; f += kLanes, number = number + static_cast<float>(kLanes)) {
            const Lanes here = value(f);
            at = here > highest ? number : at;
            highest = most(here, highest);
        }
        Best first{0, -kFar};
        for (uint32_t k = 0; k < kLanes; ++k)
            if (highest[k] > first.value) first = {static_cast<uint32_t>(at[k]), highest[k]};
        return first;
    }
    uint32_t count_;
    std::array<float, kMaxFaces> x_, y_, z_, height_;
};

float highest_point(const Hull& hull, Vec3 up) {
    const Points& p = hull.local;
    Lanes highest{-kFar, -kFar, -kFar, -kFar};
    for (uint32_t k = 0; k < p.count; k += kLanes)
        highest = most(up.x * load(&p.x[k]) + up.y * load(&p.y[k]) + up.z * load(&p.z[k]), highest);
    return std::max({highest[0], highest[1], highest[2], highest[3]});
}

float lowest_corner(const Hull& hull, uint32_t face, Vec3 up) {
    float lowest = kFar;
    for (uint32_t c = hull.first_corner[face]; c < hull.first_corner[face + 1]; ++c)
        lowest = std::min(lowest, dot(up, hull.local[hull.corner[c]]));
    return lowest;
}

}  // namespace

// Most faces are told off by one plane of the other: that which the hull's centre lies farthest in front of. Heights
// over it are found for all points at once, then each face costs a look at its corners. Of the rest most have nothing
// of the other before them, or look where a face of the other does and lie over that one.
void mark_covered(Hull& hull, const Hull& other, bool is_whole) {
    const Vec3 between = other.local.centre - hull.local.centre;
    if (&hull == &other || length(between) > hull.radius + other.radius + kSeamRange || other.face_count < 4) return;
    // Past the margins of both and half a millimetre more (at scale 1), so that faces which lie on each other count and
    // parallel walls do not.
    const float flush = 0.0005f * scale_of(hull, other), outside = hull.margin + other.margin + flush;
    // If all are asked for, those on the rim may be as far away as where the other one leans back by 30 degrees.
    const float leaning = is_whole ? 0.58f * outside : 0;
    // A place between two neighbours lies in both.
    const float inside = other.margin + 2e-6f * (hull.radius + other.radius);
    const Planes planes(other);
    const uint32_t foremost = planes.foremost(-1 * between).face;
    const Vec3 up = other.face_normal[foremost];
    float height[kMaxPoints];
    const Points& points = hull.local;
    for (uint32_t k = 0; k < points.count; ++k)
        height[k] = up.x * points.x[k] + up.y * points.y[k] + up.z * points.z[k];
    // Of a face's lowest corner, at most: from there it is `outside` to the place asked for.
    const float highest = dot(up, between) + other.face_height[foremost] + other.margin + 1.58f * outside;
    uint64_t are_flush = 0;
    bool is_any = false;
    for (uint32_t f = 0; f < hull.face_count; ++f) {
        if (hull.is_face_inner[f]) continue;
        float lowest = kFar;
        for (uint32_t c = hull.first_corner[f]; c < hull.first_corner[f + 1]; ++c)
            lowest = std::min(lowest, height[hull.corner[c]]);
        if (lowest > highest) continue;
        const auto [alike, cosine] = planes.alike(hull.face_normal[f]);
        if (cosine > kFlushCosine && is_flush(hull, f, other, alike, between)) are_flush |= uint64_t{1} << f;
        const float before_face =
            highest_point(other, hull.face_normal[f]) + dot(hull.face_normal[f], between) - hull.face_height[f];
        if (before_face + other.margin + leaning < 0.999f * outside) continue;
        const Vec3 out = other.face_normal[alike];
        const float over = lowest_corner(hull, f, out) - dot(out, between) + outside * cosine;
        if (over > other.face_height[alike] + other.margin + leaning + 0.001f * outside) continue;
        const Places places(hull, f, flush);
        const Vec3 before = outside * hull.face_normal[f] - between;
        for (uint32_t s = 0; s < places.count(); ++s) {
            if (hull.covered[f] >> s & 1) continue;
            // Of what moves the middle tells, and whether this piece covers any place.
            if (!is_whole && s > 0 && is_any) continue;
            const Vec3 p = places[s] + before;
            const bool is_covered = planes.hold(p, inside + (s == 0 ? 0 : leaning));
            hull.covered[f] |= uint64_t{is_covered} << s;
            is_any = is_any || is_covered;
        }
        hull.is_face_inner[f] = is_whole ? hull.covered[f] == places.all() : places.is_middle_in(hull.covered[f]);
    }
    if (is_any) hull.flush |= are_flush;
}

void transform_points(const Hull& hull, const Mat3& r, Vec3 position, Points& out) {
    const Points& in = hull.local;
    out.count = in.count;
    out.centre = r * in.centre + position;
    for (uint32_t k = 0; k < in.count; ++k) {
        const float x = in.x[k], y = in.y[k], z = in.z[k];
        out.x[k] = r.row[0].x * x + r.row[0].y * y + r.row[0].z * z;
        out.y[k] = r.row[1].x * x + r.row[1].y * y + r.row[1].z * z;
        out.z[k] = r.row[2].x * x + r.row[2].y * y + r.row[2].z * z;
    }
}

void refresh_world(Hull& hull, const Mat3& rotation, Vec3 position) {
    transform_points(hull, rotation, position, hull.world);
    Box box = empty_box();
    for (uint32_t k = 0; k < hull.point_count; ++k) include(box, hull.world[k]);
    hull.world_box = grown({box.low + hull.world.centre, box.high + hull.world.centre}, hull.margin);
}

}  // namespace cullet::bullet
