// Where the points of a primitive stand: moved by morph targets at their default weights, then by the joints of a skin
// as they rest.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/import/corners.hpp"
#include "engine/import/gltf/nodes.hpp"
#include "engine/import/gltf/primitives.hpp"
#include "engine/import/skin.hpp"

namespace cullet::gltf {

/// The place of the node that shows the mesh does not matter.
Skin read_skin(const Document& document, const Part& asker, const Nodes& nodes, Accessors& accessors);

struct Pose {
    std::vector<double> weights;        // of the morph targets
    std::optional<Skin> skin;           // of several joints that do not agree
    std::vector<Affine> places;         // without such a skin: the mesh is shown at each of them
    uint64_t points_without_joint = 0;  // of no weight: the first joint moves them

    /// A corner with its targets added, in the mesh's own axes.
    SourceCorner corner(const Primitive& primitive, uint64_t point) const;
    /// What the joints make of that point, by the sum of its weights.
    Affine place_of(const Primitive& primitive, uint64_t point) const;
};

/// As that of skin.hpp. Counts the points without a joint on the way.
std::optional<Affine> common_place(const GltfMesh& mesh, Pose& pose);

}  // namespace cullet::gltf
