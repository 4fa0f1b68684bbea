#include "engine/import/gltf/pose.hpp"

#include <algorithm>
#include <string>

namespace cullet::gltf {
namespace {

/// Calls visit(joint, weight) for what moves a point; true when there was anything.
template <class Visit>
bool each_influence(const Primitive& primitive, uint64_t point, size_t joints, const Visit& visit) {
    bool is_moved = false;
    for (size_t set = 0; set < primitive.joints.size(); ++set)
        for (unsigned i = 0; i < 4; ++i) {
            const double weight = primitive.weights[set]->number(point, i);
            if (!(weight > 0)) continue;
            const uint64_t joint = primitive.joints[set]->whole(point, i);
            if (joint >= joints)
                throw Refusal(primitive.place + " hangs point " + std::to_string(point) + " on joint " +
                              std::to_string(joint) + ", but the skin has " + std::to_string(joints));
            visit(joint, weight);
            is_moved = true;
        }
    return is_moved;
}

}  // namespace

Skin read_skin(const Document& document, const Part& asker, const Nodes& nodes, Accessors& accessors) {
    const Part part = document.named("skins", asker);
    const Part joints = part.need("joints");
    if (joints.size() == 0) joints.refuse("names no node");
    const auto inverses = part.find("inverseBindMatrices");
    const Accessor* matrices = inverses ? &accessors.at(*inverses) : nullptr;
    if (matrices != nullptr) matrices->expect_components(16);
    Skin skin;
    for (size_t j = 0; j < joints.size(); ++j) {
        document.named("nodes", joints.item(j));
        const Affine& place = nodes.places[joints.item(j).whole(nodes.places.size())];
        if (matrices == nullptr) {
            skin.push_back(joint_at(place, {}));
            continue;
        }
        double numbers[16];
        for (unsigned i = 0; i < 16; ++i) numbers[i] = matrices->number(j, i);
        skin.push_back(joint_at(place, affine_of(numbers, matrices->place)));
    }
    return skin;
}

SourceCorner Pose::corner(const Primitive& primitive, uint64_t point) const {
    SourceCorner corner;
    corner.position = primitive.position->vector(point);
    if (primitive.normal != nullptr) corner.normal = primitive.normal->vector(point);
    double uv[2] = {};
    for (unsigned i = 0; primitive.uv != nullptr && i < 2; ++i) uv[i] = primitive.uv->number(point, i);
    for (size_t t = 0; t < std::min(weights.size(), primitive.targets.size()); ++t) {
        const MorphTarget& target = primitive.targets[t];
        if (weights[t] == 0) continue;
        if (target.position != nullptr) corner.position += weights[t] * target.position->vector(point);
        if (target.normal != nullptr) corner.normal += weights[t] * target.normal->vector(point);
        for (unsigned i = 0; target.uv != nullptr && i < 2; ++i) uv[i] += weights[t] * target.uv->number(point, i);
    }
    const TextureCoordinates& c = primitive.coordinates;
    const double u = c.linear[0] * uv[0] + c.linear[1] * uv[1] + c.move[0];
    const double v = c.linear[2] * uv[0] + c.linear[3] * uv[1] + c.move[1];
    corner.uv = {static_cast<float>(u), static_cast<float>(1 - v)};  // glTF counts v from the top, a mesh file does not
    return corner;
}

Affine Pose::place_of(const Primitive& primitive, uint64_t point) const {
    Blend blend;
    each_influence(primitive, point, skin->size(),
                   [&](uint64_t joint, double weight) { blend.add(weight, (*skin)[joint].place); });
    return blend.mean().value_or(skin->front().place);
}

std::optional<Affine> common_place(const GltfMesh& mesh, Pose& pose) {
    const Skin& skin = *pose.skin;
    std::vector<bool> is_used(skin.size());
    BindBox box;
    for (const Primitive& primitive : mesh.primitives) {
        if (primitive.position == nullptr) continue;
        for (uint64_t point = 0; point < primitive.position->count; ++point) {
            box.grow(pose.corner(primitive, point).position);
            if (each_influence(primitive, point, skin.size(), [&](uint64_t j, double) { is_used[j] = true; })) continue;
            is_used[0] = true;
            ++pose.points_without_joint;
        }
    }
    return cullet::common_place(skin, is_used, box);
}

}  // namespace cullet::gltf
