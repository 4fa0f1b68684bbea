// First step of a surface: refuse, weld, drop, and put in canonical order.
#pragma once
#include "systems/cook/surface.hpp"

namespace cullet {

struct CleanMesh {
    std::vector<Vec3d> positions;                        // m, sorted by (x, y, z), each once, each used
    std::vector<Triangle> triangles;                     // smallest id first, sorted, each set of corners once
    std::vector<uint32_t> source_triangles;              // in the mesh given
    std::vector<std::array<uint8_t, 3>> source_corners;  // corner k came from that corner of the source triangle
    std::vector<uint32_t> repeated;                      // triangles of the mesh given that name another's corners
                                                         // again, or one corner twice; ascending
    Vec3d low, high;                                     // m
    double diagonal = 0;                                 // m
};

Result<CleanMesh> clean_mesh(const Mesh& mesh, const SurfaceSettings& settings, SurfaceRepairs& repairs);

}  // namespace cullet
