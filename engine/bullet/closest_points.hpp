// Closest points of two convex sets of points, in double.
//
// Bullet's own GJK misses or under-reports touches of hulls a few millimetres thick. This one works about the pieces'
// centres in double, measures the gap along every axis that it tries from support points (a bound that holds whatever
// the iteration does), and stops when bound and distance agree.
#pragma once
#include "engine/bullet/hull.hpp"

namespace cullet::bullet {

struct Closest {
    bool is_beyond = false;  // stopped early
    bool is_apart = false;   // the sets do not touch; else nothing below holds but `bound`
    double distance = 0;     // m
    double bound = 0;        // the gap seen along `axis`: never more than the true distance
    Vec3d axis;              // unit, from b towards a: the closest direction, or the axis of `bound` when stopped early
    Vec3d on_a, on_b;        // closest points, from the centre of a
};

/// What is left of a motion, as two displacements of set b against set a that may be made alone or together.
struct Ways {
    Vec3d first, second;
};

/// `guess` is any direction from b towards a (last step's axis), zero takes the centres. Stops early, with `is_apart`
/// and `distance` = `bound`, as soon as the gap along an axis is above `enough`, and stays so on all of `ways`.
Closest closest_points(const Points& a, const Points& b, Vec3d guess, double enough, const Ways& ways = {});

/// Number of the point that lies farthest along `direction`; the lowest number of equals.
uint32_t support(const Points& points, Vec3 direction);
/// The gap between a and b along a unit axis from b towards a; negative when they overlap along it.
double gap_along(const Points& a, const Points& b, Vec3d axis);

}  // namespace cullet::bullet
