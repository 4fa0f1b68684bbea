// The surface of a cut: a plane, or what a polyline sweeps.
#pragma once
#include "components/blows.hpp"
#include "components/shell_rows.hpp"

namespace cullet {

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
    /// Signed distance. Of a polyline: to its nearest segment; at a corner both share the sign of the one that the
    /// place lies more squarely to, so that the sign is that of the side (Baerentzen and Aanaes 2005, in the plane).
    CutSide side(Vec3 place) const;
    /// Share of the way between two places on different sides where the sign changes.
    float crossing(Vec3 from, Vec3 to) const;
    bool is_plane() const { return count_ == 0; }

 private:
    struct Point {
        float x, y;
    };
    Point flat(Vec3 place) const { return {dot(place, x_), dot(place, y_)}; }

    Vec3 place_, normal_, x_, y_;
    uint32_t count_ = 0;  // points
    bool is_closed_ = false;
    Point points_[kMostCutPoints];
};

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
