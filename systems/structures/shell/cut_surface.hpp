// The surface of a cut: a plane, or what a polyline sweeps.
#pragma once
#include <span>

#include "components/blows.hpp"
#include "components/shell_rows.hpp"

namespace cullet {

/// Of a polyline, where it cuts: so far from the axis along which it is swept, through its `middle`, and along it. What
/// is more than `margin` outside, at least as much as elements are long, is not looked at.
struct CutWindow {
    Vec3 middle;
    float inner = 0, outer = 0;  // m
    float low = 0, high = 0;     // m along the axis, from the middle
    float margin = 0;            // m
};

/// Where a place is, seen from a cutting surface.
struct CutSide {
    float distance = 0;     // m; the sign tells the side
    bool is_beside = true;  // false: beyond an end of an open line
};

class CutSurface {
 public:
    /// A plane. The normal is of length 1.
    CutSurface(Vec3 place, Vec3 normal) : place_(place), normal_(normal) {}
    /// Of a row of Blows, in the axes that it stands in.
    CutSurface(const Blows& blows, uint32_t row);
    /// At most kMostCutPoints, of which the last is the first again where the line is closed. The direction that it is
    /// swept along is of length 1.
    CutSurface(Vec3 direction, std::span<const Vec3> points, const CutWindow& window);
    /// Signed distance. Of a polyline: to its nearest segment; at a corner both share the sign of the one that the
    /// place lies more squarely to, so that the sign is that of the side (Baerentzen and Aanaes 2005, in the plane).
    CutSide side(Vec3 place) const;
    /// Share of the way between two places on different sides where the sign changes.
    float crossing(Vec3 from, Vec3 to) const;
    /// Beyond the window's margin, if there is one.
    bool is_far_from(Vec3 place) const {
        if (!has_window_) return false;
        const Vec3 from = place - window_.middle;
        const float along = dot(from, normal_);
        const Vec3 aside = from - along * normal_;
        const float most = window_.outer + window_.margin;
        return dot(aside, aside) > most * most || along < window_.low - window_.margin ||
               along > window_.high + window_.margin;
    }
    bool is_plane() const { return count_ == 0; }

 private:
    struct Point {
        float x, y;
    };
    void lay_axes();
    Point flat(Vec3 place) const { return {dot(place, x_), dot(place, y_)}; }

    Vec3 place_, normal_, x_, y_;
    uint32_t count_ = 0;  // points
    bool is_closed_ = false, has_window_ = false;
    CutWindow window_;
    Point points_[kMostCutPoints];
};

/// Of places that are far outside of a window.
inline constexpr float kBeyondWindow = 1e30f;

/// How far the shell goes to either side of a surface, m.
struct CutReach {
    float left = 0, right = 0;
    float layer = 0.5f;  // share of the way inward through the wall
    float smaller() const { return left < right ? left : right; }
};
/// In the middle of the wall; or at its outer side, when in the middle less than half as much is beyond the surface:
/// close to the end of what is massive. Seen from the outer side, borders do not count.
CutReach reach_of(ShellView shell, const CutSurface& surface);

/// Whether some vertices of the shell lie on one side and some on the other. What lies on the surface, a cut edge
/// before all, is on no side of it.
bool passes_through(ShellView shell, const CutSurface& surface);

}  // namespace cullet
