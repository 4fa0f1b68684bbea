// Which few of many points span their convex hull best.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/math.hpp"
#include "engine/scratch.hpp"

namespace cullet {

inline constexpr uint32_t kMostHullPoints = 32;

struct ExtremePoints {
    uint32_t index[kMostHullPoints];  // in the order in which they were chosen
    uint32_t count = 0;
    float left_out = 0;  // m: how far the worst point that was not chosen lies above a face of the hull
    /// Faces, counter-clockwise from outside, as numbers in `index`. None for points in a plane or on a line.
    std::array<uint8_t, 3> face[2 * kMostHullPoints];
    uint32_t face_count = 0;
};

/// Grows a convex hull (quickhull): the point farthest above a face comes next, the first of equals, until none lies
/// more than `enough` above one or `most` (at most 32) are chosen. Points in a plane give a polygon, points on a line
/// its two ends. Above 4,096 points the rest is not seen. Directions that are fixed beforehand, 15 degrees apart, left
/// out blunt corners of slabs 0.6 m wide by 10 mm.
void choose_extremes(ScratchMemory& scratch, std::span<const Vec3> points, uint32_t most, float enough,
                     ExtremePoints& chosen);

inline constexpr uint32_t kMostExtremeCandidates = 4096;

}  // namespace cullet
