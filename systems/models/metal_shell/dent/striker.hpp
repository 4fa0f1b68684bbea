// The surface that dents a sheet, as it lies at the first touch.
#pragma once
#include "engine/math.hpp"

namespace cullet {

enum class StrikerShape : uint8_t { Sphere, Cylinder, Plane };

struct Striker {
    StrikerShape shape = StrikerShape::Plane;
    Vec3d point;        // of the touch, m
    Vec3d push;         // unit: the way it goes into the sheet
    Vec3d axis;         // of a cylinder, unit, square to the push
    double radius = 0;  // m, of a sphere or cylinder

    /// How far the striker is from a place, back along the push, m. 1e30: it passes beside.
    double gap(Vec3d place) const {
        const Vec3d from = place - point;
        const double along = dot(from, push);
        if (shape == StrikerShape::Plane) return along;
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
};

}  // namespace cullet
