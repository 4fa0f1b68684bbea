// The surface that dents a sheet, as it lies at the first touch.
#pragma once
#include <algorithm>
#include <array>

#include "components/metal.hpp"
#include "engine/math.hpp"

namespace cullet {

/// A world knows balls, planes, and fronts of everything else, poles too. Cylinders are of benches alone: of truth,
/// figures and tests, which hold what a front does against the closed form.
enum class StrikerShape : uint8_t { Sphere, Cylinder, Plane, Front };

/// The front of a striker of any other shape: how far it has come along the push at the middles of the cells of a grid
/// across it.
struct StrikerFront {
    const std::array<float, kFrontRows>* rows = nullptr;  // kFrontRows of them, by v; kNoFront: nothing of it is there
    Vec3d u, v;                                           // unit, square to the push and to each other
    double low_u = 0, low_v = 0, step_u = 0, step_v = 0;  // m, from the touch; of cells
    /// Half of the striker's width where that ends within the body, m; 0: it reaches past the body.
    double half_u = 0, half_v = 0;
    double middle_u = 0, middle_v = 0;  // m

    bool is_round() const { return half_u > 0 || half_v > 0; }
    /// kNoFront: beside it.
    double at(double across_u, double across_v) const {
        const double x = (across_u - low_u) / step_u - 0.5, y = (across_v - low_v) / step_v - 0.5;
        constexpr double kLast = kFrontRows - 1;
        if (!(x >= -0.5 && y >= -0.5 && x <= kLast + 0.5 && y <= kLast + 0.5)) return double{kNoFront};
        const double cx = std::clamp(x, 0.0, kLast), cy = std::clamp(y, 0.0, kLast);
        const auto i = static_cast<uint32_t>(std::min(cx, kLast - 1)),
                   j = static_cast<uint32_t>(std::min(cy, kLast - 1));
        const double s = cx - i, t = cy - j;
        const double a = double{rows[j][i]}, b = double{rows[j][i + 1]}, c = double{rows[j + 1][i]},
                     d = double{rows[j + 1][i + 1]};
        // Beside an edge of it the nearest cell says all.
        if (std::min({a, b, c, d}) <= double{kNoFront}) return double{rows[t < 0.5 ? j : j + 1][s < 0.5 ? i : i + 1]};
        return (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d);
    }
};

struct Striker {
    StrikerShape shape = StrikerShape::Plane;
    Vec3d point;         // of the touch, m
    Vec3d push;          // unit: the way it goes into the sheet
    Vec3d axis;          // of a cylinder, unit, square to the push
    double radius = 0;   // m, of a sphere or cylinder
    double impulse = 0;  // N s, along the push: of the published depth with a time of its own
    StrikerFront front;
    double wider_u = 1, wider_v = 1;  // of a front: times as wide as it is

    /// How far the striker is from a place, back along the push, m. 1e30: it passes beside.
    double gap(Vec3d place) const {
        const Vec3d from = place - point;
        const double along = dot(from, push);
        if (shape == StrikerShape::Plane) return along;
        if (shape == StrikerShape::Front) {
            const double u = front.middle_u + (dot(from, front.u) - front.middle_u) / wider_u,
                         v = front.middle_v + (dot(from, front.v) - front.middle_v) / wider_v;
            const double come = front.at(u, v);
            return come > double{kNoFront} ? along - std::max(wider_u, wider_v) * come : 1e30;
        }
        Vec3d aside = from - along * push;
        if (shape == StrikerShape::Cylinder) aside = aside - dot(aside, axis) * axis;
        const double square = radius * radius - dot(aside, aside);
        return square > 0 ? along + radius - std::sqrt(square) : 1e30;
    }
    /// How deep the place is in it once it has gone on by `depth`, m.
    double covers(Vec3d place, double depth) const { return std::max(0.0, depth - gap(place)); }
    /// Distance from the axis of the push, m.
    double aside_of(Vec3d place) const {
        const Vec3d from = place - point;
        return length(from - dot(from, push) * push);
    }
    /// The same one, wider by so much to each side where it is round or ends within the body.
    Striker widened(double by) const {
        Striker wider = *this;
        wider.radius += by;
        if (front.half_u > 0) wider.wider_u = 1 + by / front.half_u;
        if (front.half_v > 0) wider.wider_v = 1 + by / front.half_v;
        return wider;
    }
    /// Of the ball that stands for it on an open sheet; at most `most`.
    double ball_radius(double most) const {
        if (shape == StrikerShape::Front) {
            const double u = front.half_u > 0 ? front.half_u : most, v = front.half_v > 0 ? front.half_v : most;
            return std::min(most, std::sqrt(u * v));
        }
        return shape == StrikerShape::Plane ? most : radius;
    }
};

}  // namespace cullet
