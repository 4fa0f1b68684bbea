#include "engine/import/assimp_bones.hpp"

namespace cullet {
namespace {

Affine affine_of(const aiMatrix4x4& m) {
    Affine affine;
    affine.row[0] = {m.a1, m.a2, m.a3};
    affine.row[1] = {m.b1, m.b2, m.b3};
    affine.row[2] = {m.c1, m.c2, m.c3};
    affine.move = {m.a4, m.b4, m.c4};
    return affine;
}

template <class Visit>
void each_weight(const aiMesh& mesh, const Visit& visit) {
    for (unsigned b = 0; b < mesh.mNumBones; ++b)
        for (unsigned w = 0; w < mesh.mBones[b]->mNumWeights; ++w) {
            const aiVertexWeight& weight = mesh.mBones[b]->mWeights[w];
            if (weight.mWeight > 0) visit(b, weight.mVertexId, weight.mWeight);
        }
}

}  // namespace

Places::Places(const aiScene& scene, const Affine& root) {
    std::vector<PlacedNode> stack;  // with the place of the parent
    if (scene.mRootNode != nullptr) stack.push_back({scene.mRootNode, root});
    while (!stack.empty()) {
        PlacedNode item = stack.back();
        stack.pop_back();
        item.place = chained(item.place, affine_of(item.node->mTransformation));
        by_name_.emplace(item.node->mName.C_Str(), nodes_.size());
        nodes_.push_back(item);
        for (unsigned i = item.node->mNumChildren; i-- > 0;) stack.push_back({item.node->mChildren[i], item.place});
    }
}

const Affine* Places::find(const std::string& name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : &nodes_[found->second].place;
}

BonePose::BonePose(const aiMesh& mesh, const Places& places, const Affine& node) : node_(node), common_(node) {
    if (mesh.mNumBones == 0) return;
    lacks_nodes_ = !read_skin(mesh, places);
    if (lacks_nodes_) return;
    read_influences(mesh);
    std::vector<bool> is_used(skin_.size());
    for (const auto& [joint, weight] : influences_) is_used[joint] = true;
    BindBox box;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        box.grow({mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z});
        points_without_bone_ += first_[v] == first_[v + 1];
    }
    if (points_without_bone_ > 0) {  // the node that shows the mesh moves them
        skin_.push_back({node, 0});
        is_used.push_back(true);
    }
    common_ = common_place(skin_, is_used, box);
}

bool BonePose::read_skin(const aiMesh& mesh, const Places& places) {
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const Affine* const place = places.find(mesh.mBones[b]->mName.C_Str());
        if (place == nullptr) return false;
        skin_.push_back(joint_at(*place, affine_of(mesh.mBones[b]->mOffsetMatrix)));
    }
    return true;
}

void BonePose::read_influences(const aiMesh& mesh) {
    first_.assign(mesh.mNumVertices + size_t{1}, 0);
    each_weight(mesh, [this](unsigned, unsigned vertex, float) { ++first_[vertex + size_t{1}]; });
    for (size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    influences_.resize(first_.back());
    std::vector<size_t> next(first_);
    each_weight(mesh, [this, &next](unsigned bone, unsigned vertex, float weight) {
        influences_[next[vertex]++] = {bone, weight};
    });
}

Affine BonePose::place_of(unsigned vertex) const {
    Blend blend;
    for (size_t i = first_[vertex]; i < first_[vertex + size_t{1}]; ++i)
        blend.add(static_cast<double>(influences_[i].second), skin_[influences_[i].first].place);
    return blend.mean().value_or(node_);
}

}  // namespace cullet
