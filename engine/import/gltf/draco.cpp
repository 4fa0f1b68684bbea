#include "engine/import/gltf/draco.hpp"

#include <draco/compression/decode.h>

#include <cstring>
#include <memory>
#include <span>
#include <utility>

#include "engine/mesh_file.hpp"

namespace cullet::gltf {
namespace {

std::unique_ptr<draco::Mesh> decoded(std::span<const uint8_t> bytes, const Part& extension) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) extension.refuse("cannot be unpacked (" + one_line(mesh.status().error_msg_string(), 160) + ")");
    return std::move(mesh).value();
}

/// The values of all points, one after another, as T.
template <class T>
std::vector<uint8_t> values_of(const draco::PointAttribute& attribute, uint32_t points, unsigned components) {
    std::vector<uint8_t> bytes(uint64_t{points} * components * sizeof(T));
    T values[16] = {};
    for (uint32_t p = 0; p < points; ++p) {
        const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(p));
        if (value.value() >= attribute.size() ||
            !attribute.ConvertValue<T>(value, static_cast<int8_t>(components), values))
            throw Refusal("a packed value does not fit the type of its accessor");
        std::memcpy(bytes.data() + uint64_t{p} * components * sizeof(T), values, components * sizeof(T));
    }
    return bytes;
}

std::vector<uint8_t> values_of(const draco::PointAttribute& attribute, uint32_t points, const Accessor& as) {
    switch (as.component_type) {
        case kByte:
            return values_of<int8_t>(attribute, points, as.components);
        case kUnsignedByte:
            return values_of<uint8_t>(attribute, points, as.components);
        case kShort:
            return values_of<int16_t>(attribute, points, as.components);
        case kUnsignedShort:
            return values_of<uint16_t>(attribute, points, as.components);
        case kUnsignedInt:
            return values_of<uint32_t>(attribute, points, as.components);
        default:
            return values_of<float>(attribute, points, as.components);
    }
}

}  // namespace

DracoMesh decode_draco(const Document& document, Buffers& buffers, const Part& primitive, const Part& extension) {
    const auto mesh = decoded(buffers.view(extension.need("bufferView")), extension);
    const Part accessors = primitive.need("attributes"), identifiers = extension.need("attributes");
    DracoMesh out;
    for (const std::string& name : identifiers.names()) {
        const Part identifier = identifiers.need(name.c_str());
        const auto asker = accessors.find(name.c_str());
        if (!asker) continue;
        Accessor accessor(document.named("accessors", *asker));
        const auto* attribute = mesh->GetAttributeByUniqueId(static_cast<uint32_t>(identifier.whole(0xFFFFFFFFu)));
        if (attribute == nullptr) identifier.refuse("names an attribute that is not among the packed ones");
        accessor.count = mesh->num_points();
        accessor.own_data(values_of(*attribute, mesh->num_points(), accessor));
        out.attributes.emplace(name, std::move(accessor));
    }
    for (uint32_t f = 0; f < mesh->num_faces(); ++f) {
        const auto& face = mesh->face(draco::FaceIndex(f));
        out.triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
    }
    return out;
}

}  // namespace cullet::gltf
