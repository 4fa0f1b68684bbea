// Rays, what is near, the nearest surface: the tree of bodies, then boxes of triangles, then triangles in double.
#include "cullet/query.hpp"

#include <cmath>

#include "components/body_id.hpp"
#include "systems/api/checks.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/hulls/triangle_queries.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr double kSlack = 1e-7;  // m that boxes are wider by than what rounding could take from them
constexpr double kNever = 1e300;

/// From a body's axes to the world's and back, in double. The quaternion is made a unit once more.
class Frame {
 public:
    Frame() : row_{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}} {}
    explicit Frame(const Pose& pose) : at_(pose.position) {
        const double x = pose.orientation.x, y = pose.orientation.y, z = pose.orientation.z, w = pose.orientation.w;
        const double s = 2 / (x * x + y * y + z * z + w * w);
        row_[0] = {1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)};
        row_[1] = {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)};
        row_[2] = {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)};
    }
    Vec3d turn(Vec3d v) const { return {dot(row_[0], v), dot(row_[1], v), dot(row_[2], v)}; }
    Vec3d turn_back(Vec3d v) const { return v.x * row_[0] + v.y * row_[1] + v.z * row_[2]; }
    Vec3d to_world(Vec3d p) const { return turn(p) + at_; }
    Vec3d to_body(Vec3d p) const { return turn_back(p - at_); }

 private:
    Vec3d row_[3], at_;
};

/// One body as a query meets it.
struct Target {
    const WorldData& world;
    uint32_t body;

    const Bodies& bodies() const { return world.state.bodies; }
    const StaticTriangles* triangles() const { return world.query_index->triangles(body); }
    bool is_sphere() const { return bodies().is_sphere[body] != 0; }
    bool is_box() const { return !is_sphere() && !triangles() && !bodies().structure[body].exists(); }
    bool has_layer(uint32_t mask) const { return (bodies().layer[body] & mask) != 0; }
    Vec3d centre() const { return Vec3d(bodies().position[body]); }
    Frame frame() const { return triangles() ? Frame() : Frame(pose_of(bodies(), body)); }
};

Triangle3 box_triangle(Vec3 half, uint32_t t) {
    // Corner numbers, bit k set on the far side of axis k; two triangles a face, counter-clockwise from outside.
    static constexpr uint8_t kCorner[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                               {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    const auto corner = [&](uint8_t k) {
        return Vec3d(k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z);
    };
    return {corner(kCorner[t][0]), corner(kCorner[t][1]), corner(kCorner[t][2])};
}

/// The drawn triangle of a shell.
Triangle3 drawn_triangle(const State& state, uint32_t body, uint32_t t) {
    const ViewVertex* const vertex = state.view_vertices.vertex.data() + state.bodies.view_vertices[body].first;
    const uint32_t* const index = state.view_indices.index.data() + state.bodies.view_indices[body].first + 3 * t;
    return {Vec3d(vertex[index[0]].position), Vec3d(vertex[index[1]].position), Vec3d(vertex[index[2]].position)};
}

Triangle3 triangle_of(const Target& target, uint32_t t) {
    if (const StaticTriangles* const given = target.triangles()) {
        const auto& corner = given->corners[t];
        return {Vec3d(corner[0]), Vec3d(corner[1]), Vec3d(corner[2])};
    }
    if (target.is_box()) return box_triangle(target.world.query_index->half_extents(target.body), t);
    return drawn_triangle(target.world.state, target.body, t);
}

/// visit(number, triangle) for all triangles of the body, in its frame, below boxes that are no farther than the limit
/// (see BoxLevels::visit). Of a drawn mesh's boxes the nearest comes first and the others in their order.
template <class Far, class Limit, class Visit>
void visit_triangles(const Target& target, Far&& far, Limit&& limit, Visit&& visit) {
    if (const StaticTriangles* const given = target.triangles()) {
        given->tree.visit(far, limit, [&](uint32_t t) {
            if (far(given->extents[t]) <= limit()) visit(t, triangle_of(target, t));
        });
        return;
    }
    if (target.is_box()) {
        for (uint32_t t = 0; t < 12; ++t) visit(t, triangle_of(target, t));
        return;
    }
    const Range indices = target.bodies().view_indices[target.body];
    const uint32_t count = indices.count / 3, boxes = (count + kTrianglesPerBox - 1) / kTrianglesPerBox;
    const auto far_box = [&](uint32_t k) {
        const auto& box = target.world.view_boxes.box[indices.first / kViewGranule + k];
        return far(AxisBox{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}});
    };
    const auto visit_box = [&](uint32_t k) {
        for (uint32_t t = kTrianglesPerBox * k; t < std::min(kTrianglesPerBox * (k + 1), count); ++t)
            visit(t, drawn_triangle(target.world.state, target.body, t));
    };
    uint32_t nearest = 0;
    double least = kNever;
    for (uint32_t k = 0; k < boxes; ++k)
        if (const double away = far_box(k); away < least) nearest = k, least = away;
    if (!(least <= limit())) return;
    visit_box(nearest);
    for (uint32_t k = 0; k < boxes; ++k)
        if (k != nearest && far_box(k) <= limit()) visit_box(k);
}

SurfaceKind kind_of(const Target& target, uint32_t t) {
    if (!target.bodies().structure[target.body].exists()) return SurfaceKind::Outer;
    uint32_t end = 0, run = 0;
    for (const uint32_t count : target.bodies().run_indices[target.body]) {
        end += count;
        if (3 * t < end) break;
        ++run;
    }
    return static_cast<SurfaceKind>(run / kMostDrawnMaterials);
}

/// The best place found so far.
struct Best {
    double distance;
    uint32_t body = kNone, triangle = 0;
    Vec3d place = {}, normal = {};  // world

    bool takes(double d, uint32_t b, uint32_t t) const {
        if (!(d <= distance)) return false;
        return d < distance || b < body || (b == body && t < triangle);
    }
};

SurfaceHit hit_of(const WorldData& world, const Best& best) {
    if (best.body == kNone) return {};
    const Bodies& bodies = world.state.bodies;
    SurfaceHit hit;
    hit.body = body_id(bodies, Row<Bodies>(best.body));
    hit.user_data = bodies.user_data[best.body];
    hit.place = best.place.to_float();
    hit.normal = best.normal.to_float();
    hit.distance = static_cast<float>(best.distance);
    hit.kind = kind_of({world, best.body}, best.triangle);
    hit.triangle = best.triangle;
    return hit;
}

Vec3d normal_of(const Triangle3& t) {
    return normalised(cross(t.b - t.a, t.c - t.a));
}

// ---- ray

struct Line {
    Vec3d origin, direction;  // unit
    double per[3];            // 1 / direction, or what is as good where that is 0

    Line(Vec3d o, Vec3d d) : origin(o), direction(d) {
        for (int k = 0; k < 3; ++k) per[k] = std::fabs(d[k]) > 1e-200 ? 1 / d[k] : kNever;
    }

    /// Where it enters the box; kNever where it does not.
    double far(const AxisBox& e) const {
        double from = 0, to = kNever;
        const double o[] = {origin.x, origin.y, origin.z};
        const float low[] = {e.low.x, e.low.y, e.low.z}, high[] = {e.high.x, e.high.y, e.high.z};
        for (int k = 0; k < 3; ++k) {
            const double a = (low[k] - kSlack - o[k]) * per[k], b = (high[k] + kSlack - o[k]) * per[k];
            from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
        }
        return from <= to + kSlack ? from - kSlack : kNever;
    }
};

void meet_sphere(const Target& target, const Line& line, Best& best) {
    const double r = target.bodies().radius[target.body];
    const Vec3d to_centre = target.centre() - line.origin;
    const double along = dot(to_centre, line.direction);
    const Vec3d across = to_centre - along * line.direction;
    const double half = r * r - dot(across, across);
    if (half < 0) return;
    const double root = std::sqrt(half), distance = along - root >= 0 ? along - root : along + root;
    if (distance < 0 || !best.takes(distance, target.body, 0)) return;
    const Vec3d place = line.origin + distance * line.direction;
    best = {distance, target.body, 0, place, normalised(place - target.centre())};
}

void meet_triangles(const Target& target, const Line& line, Best& best) {
    const Frame frame = target.frame();
    const Line own(frame.to_body(line.origin), frame.turn_back(line.direction));
    visit_triangles(
        target, [&](const AxisBox& e) { return own.far(e); }, [&] { return best.distance; },
        [&](uint32_t t, const Triangle3& triangle) {
            const double distance = distance_along(triangle, own.origin, own.direction);
            if (distance < 0 || !best.takes(distance, target.body, t)) return;
            best = {distance, target.body, t, line.origin + distance * line.direction, frame.turn(normal_of(triangle))};
        });
}

// ---- a point

/// A little less than the distance.
double far_from(const AxisBox& e, Vec3d p) {
    const Vec3d low = Vec3d(e.low) - p, high = p - Vec3d(e.high);
    const Vec3d out{std::max({low.x, high.x, 0.0}), std::max({low.y, high.y, 0.0}), std::max({low.z, high.z, 0.0})};
    return length(out) - kSlack;
}

void approach_sphere(const Target& target, Vec3d point, Best& best) {
    const double r = target.bodies().radius[target.body];
    const Vec3d from = point - target.centre();
    const double away = length(from), distance = std::fabs(away - r);
    if (!best.takes(distance, target.body, 0)) return;
    const Vec3d normal = away > 0 ? (1 / away) * from : Vec3d(0, 1, 0);
    best = {distance, target.body, 0, target.centre() + r * normal, normal};
}

void approach_triangles(const Target& target, Vec3d point, Best& best) {
    const Frame frame = target.frame();
    const Vec3d own = frame.to_body(point);
    visit_triangles(
        target, [&](const AxisBox& e) { return far_from(e, own); }, [&] { return best.distance; },
        [&](uint32_t t, const Triangle3& triangle) {
            const Vec3d nearest = nearest_point(triangle, own);
            const double distance = length(nearest - own);
            if (!best.takes(distance, target.body, t)) return;
            best = {distance, target.body, t, frame.to_world(nearest), frame.turn(normal_of(triangle))};
        });
}

bool is_inside_box(const Target& target, Vec3d point) {
    const Vec3d p = target.frame().to_body(point), half(target.world.query_index->half_extents(target.body));
    return std::fabs(p.x) <= half.x && std::fabs(p.y) <= half.y && std::fabs(p.z) <= half.z;
}

bool meets_ball(const Target& target, Vec3d centre, double radius) {
    if (target.is_sphere()) return length(centre - target.centre()) <= radius + target.bodies().radius[target.body];
    if (target.is_box() && is_inside_box(target, centre)) return true;
    const Vec3d own = target.frame().to_body(centre);
    bool is_met = false;
    visit_triangles(
        target, [&](const AxisBox& e) { return far_from(e, own); }, [&] { return is_met ? -1 : radius; },
        [&](uint32_t, const Triangle3& t) { is_met = is_met || length(nearest_point(t, own) - own) <= radius; });
    return is_met;
}

// ---- a box

bool meets_extent(const AxisBox& a, const AxisBox& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
}

struct WorldBox {
    Vec3d centre, half;

    /// The box round it in a body's frame.
    AxisBox in(const Frame& frame) const {
        AxisBox e;
        for (int k = 0; k < 8; ++k) {
            const Vec3d corner{k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z};
            e.include(frame.to_body(centre + corner).to_float());
        }
        const float wide = 1e-6f * (1 + static_cast<float>(length(half)) + length(e.low));
        return {e.low - Vec3{wide, wide, wide}, e.high + Vec3{wide, wide, wide}};
    }
};

bool meets_world_box(const Target& target, const WorldBox& box) {
    const AxisBox extent{(box.centre - box.half).to_float(), (box.centre + box.half).to_float()};
    if (target.is_sphere()) return far_from(extent, target.centre()) <= target.bodies().radius[target.body];
    if (target.is_box() && is_inside_box(target, box.centre)) return true;
    const Frame frame = target.frame();
    const AxisBox own = box.in(frame);
    bool is_met = false;
    visit_triangles(
        target, [&](const AxisBox& e) { return meets_extent(e, own) ? 0 : kNever; },
        [&] { return is_met ? -1.0 : 0.0; },
        [&](uint32_t, const Triangle3& t) {
            const Triangle3 in_world{frame.to_world(t.a), frame.to_world(t.b), frame.to_world(t.c)};
            is_met = is_met || meets_box(in_world, box.centre, box.half);
        });
    return is_met;
}

// ---- all bodies

/// In row order, though the tree gives them in its own: by insertion, few at a time. Those past the capacity are
/// counted.
struct Found {
    BodyId* out;
    uint32_t capacity, count = 0;

    void add(BodyId id) {
        uint32_t at = std::min(count, capacity);
        ++count;
        while (at > 0 && out[at - 1].index > id.index) {
            if (at < capacity) out[at] = out[at - 1];
            --at;
        }
        if (at < capacity) out[at] = id;
    }
};

template <class Far, class Meets>
uint32_t overlapping(const WorldData& world, uint32_t mask, Found found, Far&& far, double limit, Meets&& meets) {
    world.query_index->visit(
        far, [limit] { return limit; },
        [&](uint32_t body) {
            const Target target{world, body};
            if (target.has_layer(mask) && meets(target)) found.add(body_id(world.state.bodies, Row<Bodies>(body)));
        });
    return found.count;
}

/// No body stands farther out, so that a box may be as large as it likes.
Vec3 clamped(Vec3 corner) {
    const auto clamp = [](float x) { return std::clamp(x, -2 * kFarthest, 2 * kFarthest); };
    return {clamp(corner.x), clamp(corner.y), clamp(corner.z)};
}

}  // namespace

SurfaceHit ray(const World& world, Vec3 origin, Vec3 direction, float length_, uint32_t mask) {
    const FpMode mode;
    const WorldData& d = world.contents().data;
    const double scale = length(Vec3d(direction));
    if (!is_within(origin, kFarthest) || !(scale > 0 && scale < 1e30) || !(length_ >= 0)) return {};
    const Line line(Vec3d(origin), (1 / scale) * Vec3d(direction));
    Best best{std::min<double>(length_, 4 * kFarthest)};
    d.query_index->visit([&](const AxisBox& e) { return line.far(e); }, [&] { return best.distance; },
                         [&](uint32_t body) {
                             const Target target{d, body};
                             if (!target.has_layer(mask)) return;
                             if (target.is_sphere())
                                 meet_sphere(target, line, best);
                             else
                                 meet_triangles(target, line, best);
                         });
    return hit_of(d, best);
}

SurfaceHit closest(const World& world, Vec3 point, float reach, uint32_t mask) {
    const FpMode mode;
    const WorldData& d = world.contents().data;
    if (!is_within(point, kFarthest) || !(reach >= 0)) return {};
    const Vec3d p(point);
    Best best{std::min<double>(reach, 4 * kFarthest)};
    d.query_index->visit([&](const AxisBox& e) { return far_from(e, p); }, [&] { return best.distance; },
                         [&](uint32_t body) {
                             const Target target{d, body};
                             if (!target.has_layer(mask)) return;
                             if (target.is_sphere())
                                 approach_sphere(target, p, best);
                             else
                                 approach_triangles(target, p, best);
                         });
    return hit_of(d, best);
}

uint32_t overlap(const World& world, Vec3 centre, float radius, BodyId* out, uint32_t capacity, uint32_t mask) {
    const FpMode mode;
    const WorldData& d = world.contents().data;
    if (!is_within(centre, kFarthest) || !(radius >= 0)) return 0;
    const Vec3d p(centre);
    return overlapping(
        d, mask, {out, capacity}, [&](const AxisBox& e) { return far_from(e, p); }, radius,
        [&](const Target& target) { return meets_ball(target, p, radius); });
}

uint32_t overlap(const World& world, const Box& box, BodyId* out, uint32_t capacity, uint32_t mask) {
    const FpMode mode;
    const WorldData& d = world.contents().data;
    if (!(box.low.x <= box.high.x && box.low.y <= box.high.y && box.low.z <= box.high.z)) return 0;
    const AxisBox extent{clamped(box.low), clamped(box.high)};
    const Vec3d low(extent.low), high(extent.high);
    const WorldBox own{0.5 * (low + high), 0.5 * (high - low)};
    return overlapping(
        d, mask, {out, capacity}, [&](const AxisBox& e) { return meets_extent(e, extent) ? 0 : kNever; }, 0,
        [&](const Target& target) { return meets_world_box(target, own); });
}

}  // namespace cullet
