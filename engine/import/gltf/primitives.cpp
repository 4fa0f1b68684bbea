#include "engine/import/gltf/primitives.hpp"

#include <utility>

#include "engine/polygon.hpp"

namespace cullet::gltf {
namespace {

constexpr uint64_t kLargestMode = kTriangleFan;
constexpr uint64_t kMostMaterials = 65535;

/// Packed data is used where nothing else is there: the plain numbers of the same primitive are exact.
bool is_only_packed(const Document& document, const Part& primitive) {
    const auto position = primitive.find({"attributes", "POSITION"});
    return position && !document.named("accessors", *position).find("bufferView");
}

}  // namespace

uint64_t Primitive::points_and_lines() const {
    if (mode >= kTriangles) return 0;
    const uint64_t n = corners();
    if (mode == kPoints) return n;
    if (n < 2) return 0;
    return mode == kLines ? n / 2 : mode == kLineLoop ? n : n - 1;
}

uint64_t Primitive::corners_left_over() const {
    if (mode < kTriangles || unpacked != nullptr) return 0;
    if (mode == kTriangles) return corners() % 3;
    return corners() < 3 ? corners() : 0;
}

uint64_t Primitive::triangles() const {
    if (mode < kTriangles) return 0;
    if (unpacked != nullptr) return unpacked->triangles.size();
    if (mode == kTriangles) return corners() / 3;
    return corners() < 3 ? 0 : corners() - 2;
}

uint64_t Primitive::point(uint64_t corner) const {
    const uint64_t point = indices != nullptr ? indices->whole(corner, 0) : corner;
    if (point >= position->count)
        throw Refusal(place + " names point " + std::to_string(point) + ", but there are " +
                      std::to_string(position->count));
    return point;
}

std::array<uint64_t, 3> Primitive::triangle(uint64_t t) const {
    if (unpacked != nullptr) {
        const auto& packed = unpacked->triangles[t];
        for (const uint32_t p : packed)
            if (p >= position->count) throw Refusal(place + " names packed point " + std::to_string(p));
        return {packed[0], packed[1], packed[2]};
    }
    const std::array<size_t, 3> corners = mode == kTriangleStrip ? corners_in_strip(t)
                                          : mode == kTriangleFan ? corners_in_fan(t)
                                                                 : std::array<size_t, 3>{3 * t, 3 * t + 1, 3 * t + 2};
    return {point(corners[0]), point(corners[1]), point(corners[2])};
}

const Accessor* Meshes::attribute(const Primitive& primitive, const Part& attributes, const std::string& name,
                                  unsigned components) {
    const Accessor* accessor = nullptr;
    if (primitive.unpacked != nullptr) {
        const auto found = primitive.unpacked->attributes.find(name);
        if (found != primitive.unpacked->attributes.end()) accessor = &found->second;
    }
    if (accessor == nullptr) {
        const auto asker = attributes.find(name.c_str());
        if (!asker) return nullptr;
        accessor = &accessors_.at(*asker);
    }
    accessor->expect_components(components);
    return accessor;
}

void Meshes::unpack(const Part& part, Primitive& primitive) {
    const auto packed = part.find({"extensions", "KHR_draco_mesh_compression"});
    if (!packed || !is_only_packed(document_, part)) return;
    if (primitive.mode != kTriangles && primitive.mode != kTriangleStrip) packed->refuse("packs what is not triangles");
    primitive.unpacked =
        std::make_shared<const DracoMesh>(decode_draco(document_, accessors_.buffers(), part, *packed));
}

void Meshes::read_influences(const Part& attributes, Primitive& primitive) {
    for (unsigned set = 0;; ++set) {
        const std::string number = std::to_string(set);
        const Accessor* joints = attribute(primitive, attributes, "JOINTS_" + number, 4);
        const Accessor* weights = attribute(primitive, attributes, "WEIGHTS_" + number, 4);
        if (joints == nullptr || weights == nullptr) break;
        joints->expect_whole_numbers();
        primitive.joints.push_back(joints);
        primitive.weights.push_back(weights);
    }
}

void Meshes::read_attributes(const Part& part, Primitive& primitive) {
    const Part attributes = part.need("attributes");
    primitive.position = attribute(primitive, attributes, "POSITION", 3);
    if (primitive.position == nullptr) return;
    primitive.normal = attribute(primitive, attributes, "NORMAL", 3);
    const std::string set = "TEXCOORD_" + std::to_string(primitive.coordinates.set);
    primitive.uv = attribute(primitive, attributes, set, 2);
    if (primitive.uv == nullptr) {  // nothing can be looked up with the set that is asked for
        primitive.coordinates = {};
        primitive.uv = attribute(primitive, attributes, "TEXCOORD_0", 2);
    }
    read_influences(attributes, primitive);
    for (const std::string& name : attributes.names()) {
        primitive.has_colours = primitive.has_colours || name.rfind("COLOR_", 0) == 0;
        primitive.has_tangents = primitive.has_tangents || name == "TANGENT";
        primitive.further_uvs += name.rfind("TEXCOORD_", 0) == 0;
    }
    primitive.further_uvs -= primitive.uv != nullptr;
}

void Meshes::read_targets(const Part& part, Primitive& primitive) {
    const auto targets = part.find("targets");
    const std::string uv = "TEXCOORD_" + std::to_string(primitive.coordinates.set);
    for (size_t i = 0; targets && i < targets->size(); ++i) {
        const auto read = [&](const std::string& name, unsigned components) -> const Accessor* {
            const auto asker = targets->item(i).find(name.c_str());
            if (!asker) return nullptr;
            const Accessor& accessor = accessors_.at(*asker);
            accessor.expect_components(components);
            return &accessor;
        };
        primitive.targets.push_back({read("POSITION", 3), read("NORMAL", 3), read(uv, 2)});
    }
}

Primitive Meshes::read(const Part& part) {
    Primitive primitive;
    primitive.place = part.place();
    primitive.mode = part.whole("mode", kTriangles, kLargestMode);
    const auto material = part.find("material");
    primitive.coordinates = coordinates_of(document_, material);
    const uint64_t number = material ? material->whole(kLargestWhole) : document_.count("materials");
    if (number > kMostMaterials)
        throw Refusal(primitive.place + " has material " + std::to_string(number) + ", above 65535",
                      "Merge some materials.");
    primitive.material = static_cast<uint16_t>(number);
    unpack(part, primitive);
    read_attributes(part, primitive);
    if (primitive.position == nullptr) return primitive;
    read_targets(part, primitive);
    if (const auto indices = part.find("indices"); indices && primitive.unpacked == nullptr) {
        primitive.indices = &accessors_.at(*indices);
        primitive.indices->expect_components(1);
        primitive.indices->expect_whole_numbers();
    }
    return primitive;
}

const GltfMesh& Meshes::at(const Part& asker) {
    const Part part = document_.named("meshes", asker);
    const uint64_t number = asker.whole(kLargestWhole);
    const auto known = known_.find(number);
    if (known != known_.end()) return known->second;
    GltfMesh mesh;
    const Part primitives = part.need("primitives");
    for (size_t i = 0; i < primitives.size(); ++i) mesh.primitives.push_back(read(primitives.item(i)));
    if (const auto weights = part.find("weights")) mesh.weights = weights->numbers();
    return known_.emplace(number, std::move(mesh)).first->second;
}

}  // namespace cullet::gltf
