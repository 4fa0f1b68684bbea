// Primitives packed by libdraco itself, read back.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/gltf_file.hpp"
#include "tests/support/house.hpp"

namespace cullet {
namespace {

using test::GltfFile;

struct Coding {
    int method = draco::MESH_SEQUENTIAL_ENCODING;
    int speed = 0;
    int position_bits = 0;  // 0: as they are
};

/// Corner numbers stand for texture coordinates: point p has p / 16 and 1 - p / 8, normalised in 16 bits.
double u_of(int point) {
    return std::nearbyint(65535.0 * point / 16) / 65535;
}
double v_of(int point) {
    return std::nearbyint(65535.0 * (1 - point / 8.0)) / 65535;
}

std::unique_ptr<draco::Mesh> soup(int attributes[3]) {
    draco::TriangleSoupMeshBuilder builder;
    const auto& triangles = test::house_triangles();
    builder.Start(static_cast<int>(triangles.size()));
    attributes[0] = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    attributes[1] = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    attributes[2] = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_UINT16);
    for (size_t t = 0; t < triangles.size(); ++t) {
        Vec3 points[3];
        uint16_t uvs[3][2];
        for (size_t c = 0; c < 3; ++c) {
            const int p = triangles[t][c];
            points[c] = test::house_points()[static_cast<size_t>(p)].to_float();
            uvs[c][0] = static_cast<uint16_t>(std::nearbyint(65535 * u_of(p)));
            uvs[c][1] = static_cast<uint16_t>(std::nearbyint(65535 * v_of(p)));
        }
        const Vec3 normal = normalised(Vec3d(cross(points[1] - points[0], points[2] - points[0]))).to_float();
        const draco::FaceIndex face(static_cast<uint32_t>(t));
        builder.SetAttributeValuesForFace(attributes[0], face, &points[0], &points[1], &points[2]);
        builder.SetAttributeValuesForFace(attributes[1], face, &normal, &normal, &normal);
        builder.SetAttributeValuesForFace(attributes[2], face, uvs[0], uvs[1], uvs[2]);
    }
    return builder.Finalize();
}

GltfFile packed_house(const Coding& coding) {
    int attributes[3] = {};
    const auto mesh = soup(attributes);
    draco::Encoder encoder;
    encoder.SetEncodingMethod(coding.method);
    encoder.SetSpeedOptions(coding.speed, coding.speed);
    if (coding.position_bits > 0)
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, coding.position_bits);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    GltfFile file;
    const auto* bytes = reinterpret_cast<const uint8_t*>(buffer.data());
    const size_t view = file.view({bytes, bytes + buffer.size()});
    const auto accessor = [&file](const char* type, unsigned component, size_t count, bool is_normalized = false) {
        file.json["accessors"].push_back(
            {{"componentType", component}, {"count", count}, {"type", type}, {"normalized", is_normalized}});
        return file.json["accessors"].size() - 1;
    };
    const size_t points = mesh->num_points();
    file.primitive()["attributes"] = {{"POSITION", accessor("VEC3", 5126, points)},
                                      {"NORMAL", accessor("VEC3", 5126, points)},
                                      {"TEXCOORD_0", accessor("VEC2", 5123, points, true)}};
    file.primitive()["indices"] = accessor("SCALAR", 5123, 42);
    const auto id = [&](int attribute) { return mesh->attribute(attribute)->unique_id(); };
    file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view},
        {"attributes",
         {{"POSITION", id(attributes[0])}, {"NORMAL", id(attributes[1])}, {"TEXCOORD_0", id(attributes[2])}}}};
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return file;
}

const Coding kCodings[] = {{draco::MESH_SEQUENTIAL_ENCODING, 0, 0},
                           {draco::MESH_SEQUENTIAL_ENCODING, 10, 14},
                           {draco::MESH_EDGEBREAKER_ENCODING, 0, 20},
                           {draco::MESH_EDGEBREAKER_ENCODING, 5, 14},
                           {draco::MESH_EDGEBREAKER_ENCODING, 10, 16}};

/// Every triangle of the house once, its corners in their order, whatever corner comes first.
void expect_triangles(const Mesh& mesh, double tolerance) {
    std::vector<std::array<int, 3>> found, wanted = test::house_triangles();
    const auto lowest_first = [](std::array<int, 3> t) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        return t;
    };
    for (const auto& t : mesh.triangles) {
        std::array<int, 3> triangle{};
        for (size_t c = 0; c < 3; ++c) triangle[c] = test::house_point_at(mesh.positions[t[c]], tolerance);
        found.push_back(lowest_first(triangle));
    }
    for (auto& t : wanted) t = lowest_first(t);
    std::sort(found.begin(), found.end());
    std::sort(wanted.begin(), wanted.end());
    EXPECT_EQ(found, wanted);
}

TEST(Draco, NumbersAreThoseThatWerePacked) {
    for (const Coding& coding : kCodings) {
        const auto read = test::read_gltf_bytes(packed_house(coding).binary(), "house.glb");
        ASSERT_TRUE(read.ok()) << read.error();
        const Mesh& mesh = read->mesh;
        const double tolerance = coding.position_bits > 0 ? 3 * std::pow(0.5, coding.position_bits) : 0;
        ASSERT_EQ(mesh.positions.size(), 9u);
        expect_triangles(mesh, tolerance);
        ASSERT_EQ(mesh.corner_uvs.size(), 42u);
        for (size_t c = 0; c < 42; ++c) {
            const auto& t = mesh.triangles[c / 3];
            const int p = test::house_point_at(mesh.positions[t[c % 3]], tolerance);
            EXPECT_NEAR(mesh.corner_uvs[c].x, u_of(p), 1e-7);
            EXPECT_NEAR(mesh.corner_uvs[c].y, 1 - v_of(p), 1e-7);
            const Vec3d normal = normalised(cross(Vec3d(mesh.positions[t[1]] - mesh.positions[t[0]]),
                                                  Vec3d(mesh.positions[t[2]] - mesh.positions[t[0]])));
            EXPECT_LT(length(normal - Vec3d(mesh.corner_normals[c])), 1e-2);
        }
    }
}

TEST(Draco, AttributesThatAreNotPackedAndBytesThatAreNoneAreRefused) {
    GltfFile file = packed_house({});
    auto& extension = file.primitive()["extensions"]["KHR_draco_mesh_compression"];
    extension["attributes"]["NORMAL"] = 77;
    const auto unknown = test::read_gltf_bytes(file.binary(), "house.glb");
    ASSERT_FALSE(unknown.ok());
    EXPECT_NE(unknown.error().find("attributes.NORMAL names an attribute that is not among the packed ones"),
              std::string::npos)
        << unknown.error();
    file = packed_house({});
    file.bytes[0] = 'X';
    const auto damaged = test::read_gltf_bytes(file.binary(), "house.glb");
    ASSERT_FALSE(damaged.ok());
    EXPECT_NE(damaged.error().find("cannot be unpacked"), std::string::npos) << damaged.error();
}

}  // namespace
}  // namespace cullet
