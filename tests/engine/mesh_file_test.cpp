#include "engine/mesh_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <xxhash.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

namespace cullet {
namespace {

Mesh tetrahedron() {
    Mesh mesh;
    mesh.name = "tetrahedron \"\xc3\xa4\"";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    for (int c = 0; c < 12; ++c) {
        mesh.corner_normals.push_back({0, c % 2 ? 1.0f : -1.0f, 0});
        mesh.corner_uvs.push_back({0.25f * static_cast<float>(c), -1.5f});
    }
    mesh.materials = {0, 1, 65535, 1};
    return mesh;
}

std::vector<uint8_t> bytes_of(const Mesh& mesh) {
    return encode_mesh_file(mesh);
}

template <class T>
void put(std::vector<uint8_t>& bytes, size_t offset, T value) {
    std::memcpy(bytes.data() + offset, &value, sizeof value);
}

/// Makes both checksums fit again, so that the checks behind them are reached.
void seal(std::vector<uint8_t>& bytes) {
    put(bytes, 48, static_cast<uint64_t>(XXH3_64bits(bytes.data() + 64, bytes.size() - 64)));
    put(bytes, 56, static_cast<uint64_t>(XXH3_64bits(bytes.data(), 56)));
}

void expect_refused(std::span<const uint8_t> bytes, const std::string& part) {
    const auto result = parse_mesh_file(bytes, "door.cmesh");
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().rfind("door.cmesh: ", 0), 0u) << result.error();
    EXPECT_NE(result.error().find(part), std::string::npos) << result.error();
    EXPECT_EQ(result.error().find('\n'), std::string::npos);
    EXPECT_EQ(result.error().back(), '.');
}

TEST(MeshFile, AMeshComesBackByteForByte) {
    const Mesh mesh = tetrahedron();
    auto result = parse_mesh_file(bytes_of(mesh), "t");
    ASSERT_TRUE(result.ok()) << result.error();
    EXPECT_EQ(result->name, mesh.name);
    EXPECT_EQ(result->triangles, mesh.triangles);
    EXPECT_EQ(result->materials, mesh.materials);
    EXPECT_EQ(result->positions.size(), 4u);
    EXPECT_EQ(bytes_of(*result), bytes_of(mesh));
}

TEST(MeshFile, EveryChoiceOfOptionalChunksComesBack) {
    for (int choice = 0; choice < 8; ++choice) {
        Mesh mesh = tetrahedron();
        if (choice & 1) mesh.corner_normals.clear();
        if (choice & 2) mesh.corner_uvs.clear();
        if (choice & 4) mesh.materials.clear();
        auto result = parse_mesh_file(bytes_of(mesh), "t");
        ASSERT_TRUE(result.ok()) << result.error();
        EXPECT_EQ(bytes_of(*result), bytes_of(mesh));
    }
}

TEST(MeshFile, EveryTruncationOfAGoodFileIsRefused) {
    const auto bytes = bytes_of(tetrahedron());
    for (size_t size = 0; size < bytes.size(); ++size) {
        // A block of its own size, so that the address sanitizer sees a read past the end.
        const std::vector<uint8_t> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_FALSE(parse_mesh_file(cut, "cut").ok()) << size;
    }
}

TEST(MeshFile, EveryFlippedBitIsRefused) {
    const auto bytes = bytes_of(tetrahedron());
    for (size_t i = 0; i < bytes.size(); ++i)
        for (int bit = 0; bit < 8; ++bit) {
            auto flipped = bytes;
            flipped[i] = static_cast<uint8_t>(flipped[i] ^ (1u << bit));
            EXPECT_FALSE(parse_mesh_file(flipped, "flipped").ok()) << i;
        }
}

TEST(MeshFile, AFlippedByteUnderFittingChecksumsIsRefusedOrGivesAValidMesh) {
    const auto bytes = bytes_of(tetrahedron());
    for (size_t i = 0; i < bytes.size(); ++i)
        for (int value = 0; value < 256; value += 15) {
            auto forged = bytes;
            forged[i] = static_cast<uint8_t>(value);
            seal(forged);
            const auto result = parse_mesh_file(forged, "forged");
            if (result.ok()) {
                EXPECT_TRUE(validate_mesh(result.value(), "forged").ok()) << i;
                EXPECT_EQ(encode_mesh_file(result.value()), forged) << i;
            }
        }
}

TEST(MeshFile, BytesAfterTheEndAreRefused) {
    auto bytes = bytes_of(tetrahedron());
    bytes.push_back(0);
    expect_refused(bytes, "bytes after it");
}

TEST(MeshFile, AbsurdCountsAreRefusedBeforeAnythingIsAllocated) {
    const size_t offsets[] = {16, 24, 32, 40};
    const uint64_t counts[] = {
        5,     1u << 20,       1u << 28, 0xffffffffu, 1ull << 32, 1ull << 60, (1ull << 63) + 1, 0x1555555555555556ull,
        ~0ull, ~0ull / 12 + 2, 0};
    for (const size_t offset : offsets)
        for (const uint64_t count : counts) {
            auto bytes = bytes_of(tetrahedron());
            put(bytes, offset, count);
            seal(bytes);
            EXPECT_FALSE(parse_mesh_file(bytes, "absurd").ok()) << offset << " " << count;
        }
}

TEST(MeshFile, AChunkThatDisagreesWithTheHeaderIsRefused) {
    auto bytes = bytes_of(tetrahedron());
    put(bytes, 64 + 8, ~0ull);
    seal(bytes);
    expect_refused(bytes, "chunk NAME at byte 64 states 18446744073709551615 bytes");
}

TEST(MeshFile, AnIndexPastTheEndIsNamed) {
    Mesh mesh = tetrahedron();
    mesh.triangles[2][1] = 4;
    expect_refused(bytes_of(mesh), "triangle 2 names vertex 4, but there are 4");
}

TEST(MeshFile, AValueThatIsNotFiniteIsNamed) {
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity(), 2e8f};
    for (const float x : bad) {
        Mesh mesh = tetrahedron();
        mesh.positions[3].y = x;
        expect_refused(bytes_of(mesh), "vertex 3 stands at (0, ");
        mesh = tetrahedron();
        mesh.corner_normals[7].z = x;
        expect_refused(bytes_of(mesh), "the normal at corner 1 of triangle 2");
        mesh = tetrahedron();
        mesh.corner_uvs[7].x = x;
        expect_refused(bytes_of(mesh), "the texture coordinate at corner 1 of triangle 2");
    }
}

TEST(MeshFile, AMeshWithoutTrianglesOrExtentIsRefused) {
    Mesh mesh = tetrahedron();
    for (Vec3& p : mesh.positions) p = {1, 1, 1};
    expect_refused(bytes_of(mesh), "longest side is 0 m");
    expect_refused(bytes_of(Mesh{}), "holds no triangle");
}

TEST(MeshFile, AControlCharacterInTheNameIsRefused) {
    Mesh mesh = tetrahedron();
    mesh.name = "a\x1b[31m";
    expect_refused(bytes_of(mesh), "byte 1 of the mesh's name");
}

TEST(MeshFile, OtherFilesAndVersionsAreToldApart) {
    const std::vector<uint8_t> text{'s', 'o', 'l', 'i', 'd', ' ', 'c', 'u', 'b', 'e'};
    expect_refused(text, "is no mesh file");
    auto bytes = bytes_of(tetrahedron());
    put(bytes, 8, uint32_t{2});
    expect_refused(bytes, "has version 2, this build reads version 1");
}

TEST(MeshFile, WritingLeavesTheWholeFileOrNothing) {
    const auto folder = std::filesystem::temp_directory_path() / ("mesh_file_test." + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const std::string path = folder / "t.cmesh";
    ASSERT_TRUE(write_mesh_file(tetrahedron(), path).ok());
    auto result = read_mesh_file(path);
    ASSERT_TRUE(result.ok()) << result.error();
    EXPECT_EQ(bytes_of(*result), bytes_of(tetrahedron()));

    Mesh bad = tetrahedron();
    bad.triangles[0][0] = 9;
    EXPECT_FALSE(write_mesh_file(bad, folder / "bad.cmesh").ok());
    EXPECT_FALSE(write_mesh_file(tetrahedron(), folder / "no_such_folder" / "t.cmesh").ok());
    std::filesystem::create_directory(folder / "taken.cmesh");
    EXPECT_FALSE(write_mesh_file(tetrahedron(), folder / "taken.cmesh").ok());
    size_t entries = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++entries;
    EXPECT_EQ(entries, 2u);
    std::filesystem::remove_all(folder);
}

TEST(MeshFile, AMissingFileAndAFolderAreRefused) {
    EXPECT_FALSE(read_mesh_file("/no/such/file.cmesh").ok());
    EXPECT_FALSE(read_mesh_file("/").ok());
    EXPECT_FALSE(read_mesh_file("/dev/zero").ok());
}

}  // namespace
}  // namespace cullet
