#include "systems/models/metal_shell/strike/lay_front.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "components/body_id.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/models/metal_shell/shared/metal_view.hpp"
#include "systems/world_data.hpp"

namespace cullet {
namespace {

constexpr double kAhead = 0.02;  // of the body's diagonal: what lies farther ahead of the touch strikes later, or never
constexpr double kDeepest = 0.35;  // of the body's extent along the push: what lies farther back does not come to it
constexpr double kFlat = 1e-3;     // of the body's diagonal
constexpr double kBorder = 1.02;   // of the body's width

/// Place across the push and along it, from the touch.
struct Across {
    double u, v, along;
};

struct Extent {
    double low_u = 1e30, high_u = -1e30, low_v = 1e30, high_v = -1e30;
    void include(const Across& p) {
        low_u = std::min(low_u, p.u), high_u = std::max(high_u, p.u);
        low_v = std::min(low_v, p.v), high_v = std::max(high_v, p.v);
    }
};

/// How the grid lies, and what of the striker counts.
struct Aim {
    Vec3d point, push, u, v;
    Extent body;
    double ahead = 0, behind = 0;  // m along the push, from the touch
    double flat = 0;               // m

    Across of(Vec3d place) const {
        const Vec3d from = place - point;
        return {dot(from, u), dot(from, v), dot(from, push)};
    }
};

/// The same aim, body frame, in the frame that a pose leads to.
Aim seen_from(const Aim& aim, const Pose& struck, const Pose& frame) {
    const auto turned = [&](Vec3d way) {
        return Vec3d(rotate(conjugate(frame.orientation), rotate(struck.orientation, way.to_float())));
    };
    Aim seen = aim;
    seen.point = Vec3d(to_body(frame, to_world(struck, aim.point.to_float())));
    seen.push = turned(aim.push), seen.u = turned(aim.u), seen.v = turned(aim.v);
    return seen;
}

/// Calls f(where its corners are for the aim) for each triangle of the striker. Each is looked at where it stands, so
/// that none is turned into another frame. Of sheet metal the outer side will do.
template <class F>
void for_each_triangle(Read<MetalRows> rows, const QueryIndex& index, Row<Bodies> striker, const TouchPoses& poses,
                       const Aim& aim, F&& f) {
    const Bodies& bodies = rows.bodies;
    if (const StaticTriangles* triangles = index.triangles(striker)) {
        const Aim world = seen_from(aim, poses.struck, {});
        for (const auto& c : triangles->corners)
            f({world.of(Vec3d(c[0])), world.of(Vec3d(c[1])), world.of(Vec3d(c[2]))});
        return;
    }
    const Aim own = seen_from(aim, poses.struck, poses.striker);
    if (const Row<Structures> structure = bodies.structure[striker]; structure.exists()) {
        const Range &vertices = bodies.view_vertices[striker], &indices = bodies.view_indices[striker];
        uint32_t count = indices.count;
        if (metal_of(rows, structure).exists()) {
            const auto& runs = bodies.run_indices[striker];
            count = std::min(count, std::accumulate(runs.begin(), runs.begin() + kMostDrawnMaterials, 0u));
        }
        const auto corner = [&](uint32_t k) {
            const uint32_t vertex = rows.view_indices.index[indices.first + k];
            return own.of(Vec3d(rows.view_vertices.vertex[vertices.first + vertex].position));
        };
        for (uint32_t k = 0; k + 2 < count; k += 3) f({corner(k), corner(k + 1), corner(k + 2)});
        return;
    }
    const Vec3 h = index.half_extents(striker);
    if (!(h.x > 0)) return;
    const auto corner = [&](int k) {
        return own.of(Vec3d(Vec3{k & 1 ? h.x : -h.x, k & 2 ? h.y : -h.y, k & 4 ? h.z : -h.z}));
    };
    static constexpr int kSides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& s : kSides) {
        f({corner(s[0]), corner(s[1]), corner(s[2])});
        f({corner(s[0]), corner(s[2]), corner(s[3])});
    }
}

// Rows run along the axis of the striker that is most square to the push: so an upright pole is straight on the grid.
Aim aim_at(Read<MetalRows> rows, Row<Tasks> task, const TouchPoses& poses, Vec3d point, Vec3d push) {
    Aim aim;
    aim.point = point, aim.push = push;
    Vec3d best;
    double least = 2;
    for (const Vec3 axis : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}) {
        const Vec3d in_body(rotate(conjugate(poses.struck.orientation), rotate(poses.striker.orientation, axis)));
        if (const double along = std::fabs(dot(in_body, push)); along < least - 1e-6) least = along, best = in_body;
    }
    aim.v = normalised(best - dot(best, push) * push);
    aim.u = cross(aim.v, push);
    const ShellRows& shells = rows;
    const Row<Shells> shell = shells.shell_of(rows.tasks.working[task]);
    const Range& vertices = shells.shells.vertices[shell];
    double low = 1e30, high = -1e30;
    for (uint32_t v = 0; v < vertices.count; ++v) {
        const Across p = aim.of(Vec3d(rows.shell_rows.vertices.rest[vertices.first + v]));
        aim.body.include(p);
        low = std::min(low, p.along), high = std::max(high, p.along);
    }
    const Vec3d size(aim.body.high_u - aim.body.low_u, aim.body.high_v - aim.body.low_v, high - low);
    const double diagonal = length(size);
    aim.ahead = kAhead * diagonal, aim.behind = -kDeepest * std::max(size.z, 0.1 * diagonal),
    aim.flat = kFlat * diagonal;
    const double beside_u = (kBorder - 1) * size.x + aim.flat, beside_v = (kBorder - 1) * size.y + aim.flat;
    aim.body.low_u -= beside_u, aim.body.high_u += beside_u;
    aim.body.low_v -= beside_v, aim.body.high_v += beside_v;
    return aim;
}

bool is_in_the_way(const Aim& aim, const Across (&c)[3]) {
    const auto [low_u, high_u] = std::minmax({c[0].u, c[1].u, c[2].u});
    const auto [low_v, high_v] = std::minmax({c[0].v, c[1].v, c[2].v});
    const double most = std::max({c[0].along, c[1].along, c[2].along}),
                 least = std::min({c[0].along, c[1].along, c[2].along});
    return high_u >= aim.body.low_u && low_u <= aim.body.high_u && high_v >= aim.body.low_v &&
           low_v <= aim.body.high_v && most >= aim.behind && least <= aim.ahead;
}

/// Middles of the cells of the grid in a triangle keep how far it has come there, where it is the farthest.
class FrontGrid {
 public:
    FrontGrid(std::array<float, kFrontRows>* rows, const Aim& aim, const Extent& extent)
        : rows_(rows),
          aim_(aim),
          low_u_(extent.low_u),
          low_v_(extent.low_v),
          step_u_((extent.high_u - extent.low_u) / kFrontRows),
          step_v_((extent.high_v - extent.low_v) / kFrontRows) {
        for (uint32_t j = 0; j < kFrontRows; ++j) rows_[j].fill(kNoFront);
    }
    void add(const Across (&c)[3]) {
        const double area = (c[1].u - c[0].u) * (c[2].v - c[0].v) - (c[2].u - c[0].u) * (c[1].v - c[0].v);
        if (area == 0) return;
        const auto [low_u, high_u] = std::minmax({c[0].u, c[1].u, c[2].u});
        const auto [low_v, high_v] = std::minmax({c[0].v, c[1].v, c[2].v});
        const uint32_t i0 = cell(low_u, low_u_, step_u_), i1 = cell(high_u, low_u_, step_u_),
                       j0 = cell(low_v, low_v_, step_v_), j1 = cell(high_v, low_v_, step_v_);
        for (uint32_t j = j0; j <= j1; ++j)
            for (uint32_t i = i0; i <= i1; ++i) {
                const double u = low_u_ + (i + 0.5) * step_u_, v = low_v_ + (j + 0.5) * step_v_;
                const double a = ((c[1].u - u) * (c[2].v - v) - (c[2].u - u) * (c[1].v - v)) / area,
                             b = ((c[2].u - u) * (c[0].v - v) - (c[0].u - u) * (c[2].v - v)) / area;
                if (a < -kOnEdge || b < -kOnEdge || a + b > 1 + kOnEdge) continue;
                const double along = a * c[0].along + b * c[1].along + (1 - a - b) * c[2].along;
                if (along > aim_.ahead || along < aim_.behind) continue;
                rows_[j][i] = std::max(rows_[j][i], static_cast<float>(along));
            }
    }
    std::array<float, 4> frame() const {
        return {static_cast<float>(low_u_), static_cast<float>(low_v_), static_cast<float>(step_u_),
                static_cast<float>(step_v_)};
    }

 private:
    static constexpr double kOnEdge = 1e-7;
    static uint32_t cell(double at, double low, double step) {
        return static_cast<uint32_t>(std::clamp((at - low) / step, 0.0, kFrontRows - 1.0));
    }
    std::array<float, kFrontRows>* rows_;
    const Aim& aim_;
    double low_u_, low_v_, step_u_, step_v_;
};

bool is_flat(const std::array<float, kFrontRows>* rows, double within) {
    float low = 1e30f, high = kNoFront;
    for (uint32_t j = 0; j < kFrontRows; ++j)
        for (const float come : rows[j]) low = std::min(low, come), high = std::max(high, come);
    return low > kNoFront && double{high} - double{low} <= within;
}

}  // namespace

TouchPoses poses_at_touch(const Tasks& tasks, const Bodies& bodies, const Events<ForeseenHit>& foreseen, uint64_t frame,
                          Row<Tasks> task, Row<Bodies> striker) {
    const Row<Bodies> struck = tasks.body[task];
    TouchPoses poses{pose_of(bodies, struck), striker.exists() ? pose_of(bodies, striker) : Pose{}};
    if (!is_ahead(tasks, task) || !striker.exists()) return poses;
    const auto is_of_both = [&](const RigidContact& c) {
        return (c.a == struck && c.b == striker) || (c.a == striker && c.b == struck);
    };
    for (const ForeseenHit& hit : foreseen) {
        const auto contacts = std::span(hit.touch.contacts).first(hit.touch.contact_count);
        if (frame + hit.touch.steps != tasks.due_frame[task] || std::ranges::none_of(contacts, is_of_both)) continue;
        if (hit.body == struck) poses.struck = hit.touch.pose;
        if (hit.body == striker) poses.striker = hit.touch.pose;
    }
    return poses;
}

StrikerShape lay_front(MetalRows rows, const QueryIndex& index, Row<Tasks> task, Row<Bodies> striker,
                       const TouchPoses& poses, Vec3d point, Vec3d push) {
    if (!striker.exists()) return StrikerShape::Plane;
    const Aim aim = aim_at(rows, task, poses, point, push);
    Extent extent;
    const auto for_each_in_the_way = [&](auto&& f) {
        for_each_triangle(rows, index, striker, poses, aim, [&](const Across(&c)[3]) {
            if (is_in_the_way(aim, c)) f(c);
        });
    };
    for_each_in_the_way([&](const Across(&c)[3]) {
        for (const Across& p : c) extent.include(p);
    });
    const Extent& body = aim.body;
    const bool ends_u = extent.low_u > body.low_u && extent.high_u<body.high_u, ends_v = extent.low_v> body.low_v &&
                        extent.high_v < body.high_v;
    extent = {std::max(extent.low_u, body.low_u), std::min(extent.high_u, body.high_u),
              std::max(extent.low_v, body.low_v), std::min(extent.high_v, body.high_v)};
    if (!(extent.high_u - extent.low_u > aim.flat) || !(extent.high_v - extent.low_v > aim.flat))
        return StrikerShape::Plane;
    auto* const front = &rows.striker_fronts.front[task * kFrontRows];
    FrontGrid grid(front, aim, extent);
    for_each_in_the_way([&](const Across(&c)[3]) { grid.add(c); });
    const bool covers_all = extent.low_u <= body.low_u && extent.high_u >= body.high_u && extent.low_v <= body.low_v &&
                            extent.high_v >= body.high_v;
    if (covers_all && is_flat(front, aim.flat)) return StrikerShape::Plane;
    MetalRuns& runs = rows.metal_runs;
    runs.across.set(task, aim.v.to_float());
    runs.frame[task] = grid.frame();
    runs.extent[task] = {static_cast<float>(ends_u ? 0.5 * (extent.high_u - extent.low_u) : 0),
                         static_cast<float>(ends_v ? 0.5 * (extent.high_v - extent.low_v) : 0),
                         static_cast<float>(0.5 * (extent.low_u + extent.high_u)),
                         static_cast<float>(0.5 * (extent.low_v + extent.high_v))};
    return StrikerShape::Front;
}

Striker striker_of(Read<MetalRows> rows, Row<Tasks> task) {
    const MetalRuns& runs = rows.metal_runs;
    Striker striker;
    striker.shape = static_cast<StrikerShape>(runs.shape[task]);
    striker.point = Vec3d(runs.point[task]), striker.push = Vec3d(runs.push[task]);
    striker.radius = double{runs.radius[task]}, striker.impulse = double{runs.impulse[task]};
    if (striker.shape != StrikerShape::Front) return striker;
    StrikerFront& front = striker.front;
    front.rows = &rows.striker_fronts.front[task * kFrontRows];
    front.v = Vec3d(runs.across[task]);
    front.u = cross(front.v, striker.push);
    const auto &frame = runs.frame[task], &extent = runs.extent[task];
    front.low_u = double{frame[0]}, front.low_v = double{frame[1]};
    front.step_u = double{frame[2]}, front.step_v = double{frame[3]};
    front.half_u = double{extent[0]}, front.half_v = double{extent[1]};
    front.middle_u = double{extent[2]}, front.middle_v = double{extent[3]};
    return striker;
}

}  // namespace cullet
