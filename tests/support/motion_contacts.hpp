// Continuous collision detection as an oracle (thick shell note A5, case T6): which faces of a shell touch while its
// inner points move in straight lines from some depths to others. Shares nothing with the generator's separating axes.
#pragma once
#include <array>
#include <vector>

#include "systems/structures/shell/cook/extrude.hpp"

namespace cullet::test {

/// A point that moves from `from` at t = 0 to `to` at t = 1.
struct MovingPoint {
    Vec3d from, to;
    Vec3d at(double t) const { return from + t * (to - from); }
};

/// Times in [0, 1] at which four moving points lie in one plane: roots of det[b - a, c - a, d - a], a cubic in t. One
/// entry of -1 where they always do.
std::vector<double> coplanar_times(const std::array<MovingPoint, 4>& p);
/// Whether point p touches triangle t at some time; barycentric weights down to -1e-6 count.
bool point_touches(const MovingPoint& p, const std::array<MovingPoint, 3>& t);
/// Whether segments a b and c d touch at some time, ends included up to 1e-6 of the length.
bool edges_touch(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c, const MovingPoint& d);

/// Faces in the order of ShellFaces. Pairs excused from each other (one element, bodies that meet, triangles that cross
/// in S, fans that share only a position) are left out; corners that are one point touch nothing.
using FacePairs = std::vector<std::array<uint32_t, 2>>;
/// Pairs a < b that touch during the motion, sorted.
FacePairs contacts_of_motion(const Surface& surface, const std::vector<Vec3d>& direction,
                             const std::vector<double>& from, const std::vector<double>& to);
/// Pairs a < b that meet at these depths by exact predicates (shell_checks.hpp), sorted.
FacePairs meetings_at(const Surface& surface, const std::vector<Vec3d>& direction, const std::vector<double>& depth);

/// A front that sets back by continuous detection and by the elements' volumes and nothing else, from depths that are
/// valid, in `rounds` steps to the caps. The twin of the guarded front.
std::vector<double> push_by_motion(const Surface& surface, const std::vector<Vec3d>& direction,
                                   const std::vector<double>& start, const std::vector<double>& cap, uint32_t rounds);

}  // namespace cullet::test
