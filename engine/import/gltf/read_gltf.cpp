#include "engine/import/gltf/read_gltf.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/import/corners.hpp"
#include "engine/import/gltf/extensions.hpp"
#include "engine/import/gltf/nodes.hpp"
#include "engine/import/gltf/notes.hpp"
#include "engine/import/gltf/pose.hpp"
#include "engine/import/gltf/primitives.hpp"
#include "engine/mesh_file.hpp"

namespace cullet::gltf {
namespace {

class Reader {
 public:
    explicit Reader(const Document& document) : document_(document), nodes_(read_nodes(document)), meshes_(document) {}

    Corners read() {
        const Part root = document_.root();
        for (const uint32_t n : nodes_.shown) {
            const Part node = root.need("nodes").item(n);
            if (const auto mesh = node.find("mesh")) show(node, *mesh, nodes_.places[n]);
        }
        corners_.notes = document_.notes();
        append_notes(corners_.notes, document_, meshes_, shown_);
        return std::move(corners_);
    }

 private:
    void show(const Part& node, const Part& asker, const Affine& node_place) {
        const GltfMesh& mesh = meshes_.at(asker);
        Pose pose;
        pose.weights = mesh.weights;
        if (const auto weights = node.find("weights")) pose.weights = weights->numbers();
        pose.places = {node_place};
        const auto instances = node.find({"extensions", "EXT_mesh_gpu_instancing"});
        if (const auto skin = node.find("skin")) {
            if (instances) instances->refuse("stands at a node with a skin: where the copies are is not defined");
            pose.skin = read_skin(document_, *skin, nodes_, meshes_.accessors());
            if (const auto place = common_place(mesh, pose)) pose.places = {*place}, pose.skin.reset();
            shown_.points_without_joint += pose.points_without_joint;
        } else if (instances) {
            pose.places = instance_places(*instances, node_place);
        }
        for (const Primitive& primitive : mesh.primitives) show(primitive, pose);
    }

    std::vector<Affine> instance_places(const Part& instances, const Affine& node_place) {
        const auto attribute = [&](const char* name, unsigned components) -> const Accessor* {
            const auto asker = instances.need("attributes").find(name);
            if (!asker) return nullptr;
            const Accessor& accessor = meshes_.accessors().at(*asker);
            accessor.expect_components(components);
            return &accessor;
        };
        const Accessor* const translation = attribute("TRANSLATION", 3);
        const Accessor* const rotation = attribute("ROTATION", 4);
        const Accessor* const scale = attribute("SCALE", 3);
        std::optional<uint64_t> count;
        for (const Accessor* accessor : {translation, rotation, scale}) {
            if (accessor == nullptr) continue;
            if (count && *count != accessor->count)
                instances.refuse("has " + std::to_string(*count) + " and " + std::to_string(accessor->count) +
                                 " numbers for its copies");
            count = accessor->count;
        }
        if (!count) instances.refuse("says neither TRANSLATION nor ROTATION nor SCALE of its copies");
        std::vector<Affine> places;
        for (uint64_t i = 0; i < *count; ++i) {
            double turn[4] = {0, 0, 0, 1};
            for (unsigned k = 0; rotation != nullptr && k < 4; ++k) turn[k] = rotation->number(i, k);
            const Vec3d move = translation != nullptr ? translation->vector(i) : Vec3d{};
            const Vec3d size = scale != nullptr ? scale->vector(i) : Vec3d{1, 1, 1};
            places.push_back(chained(node_place, placed_by(move, turn, size, instances)));
        }
        return places;
    }

    void show(const Primitive& primitive, const Pose& pose) {
        if (primitive.position == nullptr) {
            ++shown_.primitives_without_points;
            return;
        }
        for (size_t t = primitive.targets.size(); t < pose.weights.size(); ++t)
            shown_.weights_without_target += pose.weights[t] != 0;
        for (const Affine& place : pose.places) {
            corners_.left_out += primitive.points_and_lines();
            shown_.corners_left_over += primitive.corners_left_over();
            UsedPoints used(primitive.triangles() > 0 ? primitive.position->count : 0);
            for (uint64_t t = 0; t < primitive.triangles(); ++t) {
                if (has_too_many_triangles(corners_))
                    throw Refusal("has more than " + std::to_string(kMostMeshRows) + " triangles", "Split the model.");
                const auto points = primitive.triangle(t);
                if (!append(primitive, pose, points, place)) continue;
                used.add(corners_, points);
            }
        }
    }

    bool append(const Primitive& primitive, const Pose& pose, const std::array<uint64_t, 3>& points,
                const Affine& place) {
        SourceTriangle triangle;
        triangle.has_normals = primitive.normal != nullptr;
        triangle.has_uvs = primitive.uv != nullptr;
        triangle.material = primitive.material;
        for (size_t c = 0; c < 3; ++c) triangle.corner[c] = pose.corner(primitive, points[c]);
        if (!pose.skin) return append_triangle(corners_, triangle, place);
        std::array<Affine, 3> places;
        for (size_t c = 0; c < 3; ++c) places[c] = pose.place_of(primitive, points[c]);
        return append_posed_triangle(corners_, triangle, places);
    }

    const Document& document_;
    Nodes nodes_;
    Meshes meshes_;
    Corners corners_;
    Shown shown_;
};

}  // namespace

Corners read_document(const Document& document) {
    check_required(document);
    return Reader(document).read();
}

Error error_of(const Refusal& refusal, const std::string& path) {
    return {path + ": " + refusal.what() + ". " + refusal.remedy};
}

}  // namespace cullet::gltf
