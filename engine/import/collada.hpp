// Collada as assimp 5.2 can read it. It takes a fan for one polygon, leaves out polygons with holes, and makes an index
// of -1 a 0; so strips and fans are written as triangles before it sees them.
#pragma once
#include <string>
#include <vector>

#include "cullet/result.hpp"

namespace cullet {

struct PlainCollada {
    std::string text;
    std::vector<std::string> notes;  // what of the file no mesh will hold, a sentence each
};

/// Every `tristrips` and `trifans` becomes `triangles`: each `p` is a strip, and -1 for a vertex begins the next one.
/// Triangles with a point twice only join strips and are none. A polygon with holes becomes the polygon without them.
Result<PlainCollada> plain_collada(std::string bytes, const std::string& path);

}  // namespace cullet
