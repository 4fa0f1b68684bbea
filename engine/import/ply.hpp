// A strict reader of PLY. assimp 5.2 crashes or hangs on damaged files, and reads a strip as one polygon.
#pragma once
#include <string>

#include "cullet/result.hpp"
#include "engine/import/corners.hpp"

namespace cullet {

/// Text and binary of both byte orders. Read are `vertex` (x y z, nx ny nz, u v or s t), `face` (polygons, with texture
/// coordinates of their corners), `tristrips` and `trifans`. In strips and fans -1, or the largest number of an
/// unsigned type, begins the next one. Every second triangle of a strip is turned. Edges are counted as lines, other
/// elements are named in a note. Counts are held against the bytes that are there before anything is allocated.
Result<Corners> read_ply(std::string bytes, const std::string& path);

}  // namespace cullet
