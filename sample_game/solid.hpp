// A closed mesh in world axes, as it is drawn: what lies in it, and how deep.
#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "cullet/view.hpp"
#include "engine/math.hpp"
#include "sample_game/mesh_gap.hpp"

namespace cullet {

struct Bounds {
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};

    void include(Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    bool is_within(const Bounds& other, float reach) const {
        return low.x <= other.high.x + reach && other.low.x <= high.x + reach && low.y <= other.high.y + reach &&
               other.low.y <= high.y + reach && low.z <= other.high.z + reach && other.low.z <= high.z + reach;
    }
    /// In y and z, with a micrometre to spare.
    bool holds_across(Vec3 p) const {
        return p.y >= low.y - 1e-6f && p.y <= high.y + 1e-6f && p.z >= low.z - 1e-6f && p.z <= high.z + 1e-6f;
    }
    /// At most the square of the distance of anything inside.
    double squared_gap(Vec3 p) const {
        const auto out = [](float least, float x, float most) {
            return static_cast<double>(std::max({least - x, x - most, 0.0f}));
        };
        const double x = out(low.x, p.x, high.x), y = out(low.y, p.y, high.y), z = out(low.z, p.z, high.z);
        return 0.999999 * (x * x + y * y + z * z);
    }
    bool holds(Vec3 p) const {
        return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
    }
};

/// A thing as it is drawn, in world axes.
struct DrawnSolid {
    std::vector<Vec3> points;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<Bounds> bounds;  // of the triangles
    Bounds all;
    bool is_moving = false;

    Corners corners(size_t t) const {
        return {Vec3d(points[triangles[t][0]]), Vec3d(points[triangles[t][1]]), Vec3d(points[triangles[t][2]])};
    }
    /// Bounds, once points and triangles stand.
    void finish();
    bool holds(Vec3 p) const;
    /// From a point inside to the nearest triangle, m.
    double depth(Vec3 p) const;
};

/// At the pose after the last step.
DrawnSolid solid_of(const BodyView& view);
/// How deep the deepest point of `inner` lies in `outer`, m; 0 where none does.
double deepest(const DrawnSolid& inner, const DrawnSolid& outer);

}  // namespace cullet
