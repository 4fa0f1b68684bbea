// A mesh made ready to be a solid: welded, wound outward, its holes closed, every side of a triangle paired with a side
// that runs back (solid cooking note, section 3).
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cullet/result.hpp"
#include "engine/math.hpp"
#include "engine/mesh.hpp"
#include "engine/ray_scene.hpp"

namespace cullet {

/// Triangles may cross and parts may lie in each other: every part is a solid of its own, and what lies twice inside
/// counts twice.
struct ClosedMesh {
    std::vector<Vec3d> positions;                // m, each once
    std::vector<Triangle> triangles;             // counter-clockwise from outside
    std::vector<Triangle> sides;                 // side k runs from corner k to corner k + 1: the number of its pair
    std::vector<std::array<uint32_t, 2>> pairs;  // the two ends of a pair of sides, the lower first
    std::vector<uint32_t> part_of;               // of a triangle; a cavity belongs to the part around it
    uint32_t part_count = 0;
    /// Triangle of the mesh given, or kNone: it closes a hole, and its material is that of the inside. Corner k came
    /// from that corner of the source.
    std::vector<uint32_t> source;
    std::vector<std::array<uint8_t, 3>> source_corners;
    uint32_t holes = 0;       // closed
    double filled_share = 0;  // their area over that of the whole surface
    double volume = 0;        // m3
    double area = 0;          // m2, with what closes holes
    Vec3d low, high;          // m
};

struct ClosingSettings {
    double weld_tolerance = 0;     // SurfaceSettings
    double largest_filled = 0.25;  // share of the closed surface that may be new
};

/// Refuses what is not finite, has larger holes or encloses no volume.
Result<ClosedMesh> close_mesh(const Mesh& mesh, const ClosingSettings& settings = {});

/// "filled 2 holes (7.1 % of the surface)", or nothing.
std::string describe(const ClosedMesh& mesh);

}  // namespace cullet
