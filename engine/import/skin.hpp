// Meshes that hang on joints (glTF) or bones (Collada, FBX ...), as these rest: each point is moved by the sum of the
// joints' places, weighted.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/import/corners.hpp"

namespace cullet {

/// From a mesh's own axes to the scene's.
struct Joint {
    Affine place;
    double rounding = 0;  // m; what the 24 bits of the numbers that made the place may cost a point
};
using Skin = std::vector<Joint>;

/// The place of a joint's node times its inverse bind matrix. Far from the origin both move by as much and back, and
/// only the rounding of that is left.
Joint joint_at(const Affine& node, const Affine& inverse_bind);

struct BindBox {
    Vec3d low, high;
    bool is_empty = true;

    void grow(Vec3d p);
    Vec3d corner(int c) const { return {c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z}; }
};

/// The one place of a mesh whose joints all rest as it was bound, which is the rule; nothing when they do not. Equal
/// but for rounding: points of equal place may hang on different joints and must not come apart. `box` holds the mesh.
std::optional<Affine> common_place(const Skin& skin, const std::vector<bool>& is_used, const BindBox& box);

/// What several joints make of a point.
class Blend {
 public:
    void add(double weight, const Affine& place);
    /// Nothing without a weight above 0.
    std::optional<Affine> mean() const;

 private:
    Affine sum_{{{}, {}, {}}, {}};
    double total_ = 0;
};

/// As append_triangle(), each corner with a place of its own. Turned when two of them are mirrored.
bool append_posed_triangle(Corners& out, SourceTriangle triangle, const std::array<Affine, 3>& places);

}  // namespace cullet
