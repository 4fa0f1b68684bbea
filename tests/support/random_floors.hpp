// Floors of many parts, all of them flat or hilly, and what slides over them: for tests of inner edges.
#pragma once
#include <array>
#include <functional>
#include <random>
#include <vector>

#include "engine/math.hpp"

namespace cullet {

/// A static part of a floor; each is a body of its own.
struct FloorPart {
    std::vector<Vec3> points;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<std::vector<Vec3>> pieces;  // convex, in place of triangles,
    float margin = 0;                       // by which they are grown
};

using Height = std::function<float(float, float)>;  // m, of x and z

struct Floor {
    const char* name = "";
    std::vector<FloorPart> parts;
    Height height = [](float, float) { return 0.0f; };
};

/// Of all floors, m along x; they are 3 m wide.
inline constexpr float kFloorLow = -1, kFloorHigh = 11, kFloorSide = 1.5f;

struct Chance {
    std::mt19937 engine;
    float between(float low, float high) {
        return low + (high - low) * static_cast<float>(engine() % 1000003) / 1000003;
    }
    uint32_t below(uint32_t end) { return static_cast<uint32_t>(engine() % end); }
};

/// A floor, and the plainest one of the same shape: two triangles, or of a hill the finest grid.
struct Ground {
    Floor floor, plain;
    bool is_hill = false;
};
Floor two_triangles();
Ground random_ground(Chance& chance);
/// As the last, never hills,
Ground random_flat_ground(Chance& chance);
/// or always.
Ground random_hill(Chance& chance);
/// One round hill of ridges of half a degree to a degree and a half, 0.3 to 0.9 m apart.
Ground random_ridges(Chance& chance);
/// The same surface, each triangle of it cut in four.
Floor cut_in_four(const Floor& floor);

/// m, along x from low to high and along z to both sides.
struct Extent {
    float low = kFloorLow, high = kFloorHigh, side = kFloorSide;
};
/// One part of convex pieces that lie flush, its top at 0, and the same as one box.
struct Plank {
    Floor floor, plain;
    Extent extent;
    float thickness = 0;  // m
};
Plank random_plank(Chance& chance, Extent extent, float thickness);

}  // namespace cullet
