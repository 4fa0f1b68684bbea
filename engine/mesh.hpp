// A triangle mesh as a game has it: what the importer writes, the reader returns, and cooking takes.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cullet/types.hpp"

namespace cullet {

/// Positions are shared by corners; normals, texture coordinates and material ids belong to corners and triangles, so
/// that a hard edge or a seam is no second vertex. The corner arrays are empty or hold three entries a triangle.
struct Mesh {
    std::string name;
    std::vector<Vec3> positions;                     // m
    std::vector<std::array<uint32_t, 3>> triangles;  // indices into positions, counter-clockwise from outside
    std::vector<Vec3> corner_normals;                // unit, 3 a triangle, or empty
    std::vector<Vec2> corner_uvs;                    // 3 a triangle, or empty
    std::vector<uint16_t> materials;                 // 1 a triangle, or empty
};

}  // namespace cullet
