// Where the nodes of an assimp scene stand, and what its bones make of the points of a mesh.
#pragma once
#include <assimp/scene.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/import/skin.hpp"

namespace cullet {

struct PlacedNode {
    const aiNode* node;
    Affine place;  // from its own axes to ours
};

class Places {
 public:
    /// `root` leads from the file's coordinates to ours.
    Places(const aiScene& scene, const Affine& root);
    /// Parents before children, children in their order.
    const std::vector<PlacedNode>& nodes() const { return nodes_; }
    /// nullptr when none has that name, as bones have it.
    const Affine* find(const std::string& name) const;

 private:
    std::vector<PlacedNode> nodes_;
    std::map<std::string, size_t> by_name_;  // the first of each name
};

/// Where the points of a mesh stand that a node shows. Bones move a point to their node's place times their offset. The
/// offset is the inverse of the place they were bound at, and with Collada also the place of the bound shape. The place
/// of the node that shows the mesh then does not matter.
class BonePose {
 public:
    BonePose(const aiMesh& mesh, const Places& places, const Affine& node);

    /// The one place of all points; nullptr when they have several.
    const Affine* common() const { return common_ ? &*common_ : nullptr; }
    Affine place_of(unsigned vertex) const;
    uint64_t points_without_bone() const { return points_without_bone_; }
    /// Bones whose nodes are not there move nothing: the mesh stands as modelled.
    bool lacks_nodes() const { return lacks_nodes_; }

 private:
    bool read_skin(const aiMesh& mesh, const Places& places);
    void read_influences(const aiMesh& mesh);

    Affine node_;
    Skin skin_;
    std::vector<size_t> first_;                           // of each vertex and of one more, in influences_
    std::vector<std::pair<unsigned, float>> influences_;  // joint, weight above 0
    std::optional<Affine> common_;
    uint64_t points_without_bone_ = 0;
    bool lacks_nodes_ = false;
};

}  // namespace cullet
