// Where the axes of an FBX point and how long its unit is: what its GlobalSettings say. assimp 5.2 reads them and
// leaves them to the user.
#pragma once
#include <string>
#include <vector>

#include "engine/import/corners.hpp"

namespace cullet {

/// Axes are 0, 1, 2 for x, y, z; a negative sign turns one round. The defaults are those of the format.
struct FbxAxes {
    int up = 1, up_sign = 1;        // our y
    int front = 2, front_sign = 1;  // our z, towards whoever looks at the model
    int coord = 0, coord_sign = 1;  // our x, to the right
    double unit = 1;                // cm
};

/// From the file's coordinates to ours. It never mirrors: up and right count, and the front follows from them. A front
/// that fits a left-handed system only is told of (programs write it for what is right-handed), and so is whatever is
/// no axis or no unit, for which the format's own default stands in.
Affine place_of(const FbxAxes& axes, std::vector<std::string>& notes);

}  // namespace cullet
