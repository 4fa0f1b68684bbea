#include "systems/structures/shell/cut_surface.hpp"

#include <algorithm>

#include "systems/structures/shell/cut_shell.hpp"

namespace cullet {
namespace {

// Of the mean edge: what is nearer lies on the surface, and on no side of it.
constexpr float kOnSurface = 1e-3f;
// That find where an edge crosses a line.
constexpr int kHalvings = 24;
// Layers of the wall, and the share of the outer one's reach below which the middle is not looked at.
constexpr float kMiddle = 0.5f, kOuter = 0, kMassive = 0.5f;

// Not at a border: the outer ends of what was cut lean over the cut.
bool is_inside(ShellView shell, uint32_t vertex) {
    Ring ring;
    walk_ring(shell, vertex, ring);
    return ring.is_closed;
}

CutReach reach_in(ShellView shell, const CutSurface& surface, float layer) {
    CutReach reach;
    reach.layer = layer;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        if (shell.state.vertices.element[shell.vertex(v)] == kNone) continue;
        const float distance = surface.side(place_in_wall(shell, v, layer)).distance;
        float& most = distance > 0 ? reach.left : reach.right;
        if (std::fabs(distance) >= kBeyondWindow) continue;
        if (std::fabs(distance) > most && (layer == kMiddle || is_inside(shell, v))) most = std::fabs(distance);
    }
    return reach;
}

}  // namespace

CutSurface::CutSurface(const Blows& blows, uint32_t row)
    : place_(blows.point[row]), normal_(blows.direction[row]), count_(blows.point_count[row]) {
    if (count_ == 0) return;
    lay_axes();
    const Vec3 first = cut_point(blows, row, 0), last = cut_point(blows, row, count_ - 1);
    is_closed_ = count_ > 3 && first == last;
    for (uint32_t i = 0; i < count_; ++i) points_[i] = flat(cut_point(blows, row, i));
}

CutSurface::CutSurface(Vec3 direction, std::span<const Vec3> points, const CutWindow& window)
    : place_(points[0]), normal_(direction), count_(static_cast<uint32_t>(points.size())), window_(window) {
    CULLET_ASSERT(count_ <= kMostCutPoints, "a line of %u points", count_);
    lay_axes();
    has_window_ = true;
    is_closed_ = count_ > 3 && points.front() == points.back();
    for (uint32_t i = 0; i < count_; ++i) points_[i] = flat(points[i]);
}

void CutSurface::lay_axes() {
    const Vec3 helper = std::fabs(normal_.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    x_ = normalised(cross(helper, normal_));
    y_ = cross(normal_, x_);
}

CutSide CutSurface::side(Vec3 place) const {
    if (count_ == 0) return {dot(place - place_, normal_), true};
    bool is_inside = true;
    if (has_window_) {
        if (is_far_from(place)) return {kBeyondWindow, false};
        const Vec3 from = place - window_.middle;
        const float along = dot(from, normal_), aside = length(from - along * normal_);
        is_inside = aside >= window_.inner && aside <= window_.outer && along >= window_.low && along <= window_.high;
    }
    const Point p = flat(place);
    const uint32_t segments = count_ - 1;
    // How far to the left of segment i's line, m.
    const auto left_of = [&](uint32_t i) {
        const float dx = points_[i + 1].x - points_[i].x, dy = points_[i + 1].y - points_[i].y;
        const float l = std::sqrt(dx * dx + dy * dy);
        return l > 0 ? (dx * (p.y - points_[i].y) - dy * (p.x - points_[i].x)) / l : 0.0f;
    };
    float least = 1e30f, along = 0;
    uint32_t nearest = 0;
    for (uint32_t i = 0; i < segments; ++i) {
        const float dx = points_[i + 1].x - points_[i].x, dy = points_[i + 1].y - points_[i].y;
        const float square = dx * dx + dy * dy;
        if (!(square > 0)) continue;
        const float t = (dx * (p.x - points_[i].x) + dy * (p.y - points_[i].y)) / square;
        const float clamped = std::clamp(t, 0.0f, 1.0f);
        const float ax = p.x - points_[i].x - clamped * dx, ay = p.y - points_[i].y - clamped * dy;
        const float away = ax * ax + ay * ay;
        if (!(away < least)) continue;
        least = away;
        nearest = i;
        along = t;
    }
    const float distance = std::sqrt(least);
    float left = left_of(nearest);
    CutSide found;
    const bool is_before = along <= 0, is_behind = along >= 1;
    if (is_before || is_behind) {
        const bool has_other = is_closed_ || (is_before ? nearest > 0 : nearest + 1 < segments);
        found.is_beside = has_other;
        if (has_other) {
            const uint32_t other = is_before ? (nearest + segments - 1) % segments : (nearest + 1) % segments;
            const float other_left = left_of(other);
            if (std::fabs(other_left) > std::fabs(left)) left = other_left;
        }
    }
    found.is_beside = found.is_beside && is_inside;
    found.distance = left < 0 ? -distance : distance;
    return found;
}

float CutSurface::crossing(Vec3 from, Vec3 to) const {
    const bool is_left = side(from).distance >= 0;
    float low = 0, high = 1;
    for (int i = 0; i < kHalvings; ++i) {
        const float middle = 0.5f * (low + high);
        ((side(from + middle * (to - from)).distance >= 0) == is_left ? low : high) = middle;
    }
    return 0.5f * (low + high);
}

CutReach reach_of(ShellView shell, const CutSurface& surface) {
    const CutReach middle = reach_in(shell, surface, kMiddle), outer = reach_in(shell, surface, kOuter);
    return middle.smaller() < kMassive * outer.smaller() ? outer : middle;
}

bool passes_through(ShellView shell, const CutSurface& surface) {
    return reach_of(shell, surface).smaller() > kOnSurface * shell.shells().mean_edge[shell.row];
}

}  // namespace cullet
