// What glTF 2.0 says of the numbers, triangles and places of a mesh, over files made here; the cases from outside
// first.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "engine/import/gltf/nodes.hpp"
#include "tests/support/gltf_file.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_program.hpp"

namespace cullet {
namespace {

namespace fs = std::filesystem;
using Encoding = test::NumberEncoding;
using test::GltfFile;
using test::kHousePoints;
using test::kHouseTriangles;
using test::size_of;
using test::volume_of;

class Gltf : public testing::Test {
 protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("gltf_test." + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    Result<ConvertedModel> read(const GltfFile& file) { return test::read_gltf_bytes(file.text(), folder_ / "m.gltf"); }
    /// Of a file that must be good.
    ConvertedModel model(const GltfFile& file) {
        auto read_one = read(file);
        EXPECT_TRUE(read_one.ok()) << read_one.error();
        return read_one ? std::move(*read_one) : ConvertedModel{};
    }
    std::string refusal(const GltfFile& file) {
        const auto read_one = read(file);
        EXPECT_FALSE(read_one.ok());
        EXPECT_EQ(read_one.error().rfind((folder_ / "m.gltf").string() + ": ", 0), 0u) << read_one.error();
        EXPECT_EQ(read_one.error().back(), '.') << read_one.error();
        return read_one.error();
    }

    fs::path folder_;
};

GltfFile house() {
    GltfFile file;
    file.put_house();
    return file;
}

void expect_house(const Mesh& mesh, double tolerance = 1e-6) {
    EXPECT_EQ(mesh.positions.size(), 9u);
    EXPECT_EQ(mesh.triangles.size(), 14u);
    EXPECT_NEAR(volume_of(mesh), 6.5, 10 * tolerance);
    const Vec3d size = size_of(mesh);
    EXPECT_NEAR(size.x, 1, tolerance);
    EXPECT_NEAR(size.y, 2.5, tolerance);
    EXPECT_NEAR(size.z, 3, tolerance);
}

bool says(const ConvertedModel& model, const std::string& words) {
    return std::any_of(model.notes.begin(), model.notes.end(),
                       [&](const std::string& note) { return note.find(words) != note.npos; });
}

// --- the cases from outside ---

test::ProgramRun import_case(const std::string& name, const fs::path& out) {
    return test::run_program({build_folder() + "/cullet_import", source_folder() + "/tests/cases/import/" + name, out});
}

// RFC 2397 and 3986: schemes know no large and small letters.
TEST_F(Gltf, DataInTheFileIsReadHoweverItsSchemeIsWritten) {
    std::string text = house().text();
    const std::string scheme = "data:application/octet-stream;base64", large = "DATA:application/octet-stream;Base64";
    text.replace(text.find(scheme), scheme.size(), large);
    const auto read_one = test::read_gltf_bytes(text, folder_ / "m.gltf");
    ASSERT_TRUE(read_one.ok()) << read_one.error();
    expect_house(read_one->mesh);
}

TEST_F(Gltf, EveryCaseIsTheHouse) {
    for (const char* name : {"gltf_bom.gltf", "gltf_morph_weight.gltf", "gltf_quantised_normals.gltf",
                             "gltf_quantised_positions.gltf", "gltf_skin_armature.gltf", "gltf_uv_ushort.gltf"}) {
        const test::ProgramRun run = import_case(name, folder_ / "out.cmesh");
        EXPECT_NE(run.output.find(": 9 vertices, 14 triangles, 1 material, 1 x 2.5 x 3 m, 1 part, closed. "
                                  "Surface: nothing to repair."),
                  std::string::npos)
            << name << run.output << run.error;
    }
}

TEST_F(Gltf, TheCaseOfThreePlacesIsThreeHouses) {
    const test::ProgramRun run = import_case("gltf_gpu_instancing.gltf", folder_ / "out.cmesh");
    EXPECT_NE(run.output.find("42 triangles, 1 material, 11 x 2.5 x 3 m, 3 parts, all closed."), std::string::npos)
        << run.output << run.error;
}

TEST_F(Gltf, TheCaseOfAnUnknownExtensionIsRefusedByItsName) {
    const test::ProgramRun run = import_case("gltf_unknown_required.gltf", folder_ / "out.cmesh");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.error.find("\"XYZ_unknown_geometry\""), std::string::npos) << run.error;
    EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1) << run.error;
}

TEST_F(Gltf, TheCasesNormalsAndTextureCoordinatesAreThose) {
    const auto read_case = [](const std::string& name) {
        const std::string path = source_folder() + "/tests/cases/import/" + name;
        return joined_model(gltf::read_document(gltf::Document(gltf::bytes_of_model(path), path)), path).mesh;
    };
    for (const Vec3 n : read_case("gltf_quantised_normals.gltf").corner_normals) EXPECT_EQ(n, (Vec3{0, 1, 0}));
    const Mesh mesh = read_case("gltf_uv_ushort.gltf");
    ASSERT_EQ(mesh.corner_uvs.size(), 42u);
    for (size_t c = 0; c < 42; ++c) EXPECT_NEAR(mesh.corner_uvs[c].x, kHouseTriangles[c / 3][c % 3] / 8.0, 1e-5) << c;
}

// --- numbers ---

const Encoding kEncodings[] = {{5120, false}, {5120, true},  {5121, false}, {5121, true}, {5122, false},
                               {5122, true},  {5123, false}, {5123, true},  {5126, false}};

/// All attributes of a triangle soup, each in an encoding, a stride and an offset of its own, some rows sparse.
TEST_F(Gltf, EveryEncodingStrideOffsetAndSparseRowGivesTheNumbersThatWereStored) {
    std::mt19937 random(31);
    const auto below = [&random](unsigned n) { return static_cast<unsigned>(random() % n); };
    int compared = 0;
    for (int round = 0; round < 300; ++round) {
        GltfFile file;
        constexpr size_t kRows = 30;
        const auto attribute = [&](const char* name, unsigned components, double scale) {
            const Encoding e = kEncodings[below(9)];
            const double most = e.type == 5126 ? scale : e.is_normalized ? 1 : e.largest();
            std::vector<double> wanted(kRows * components);
            for (double& value : wanted) {
                const double unit = static_cast<double>(random()) / 4294967296.0;
                value = e.stored(most * (e.has_sign() ? 2 * unit - 1 : unit));
            }
            const size_t packed = components * e.bytes();
            const size_t stride = below(2) == 0 ? 0 : (packed + 3) / 4 * 4 + 4 * below(5);
            std::vector<double> stored = wanted;
            std::vector<double> rows, values;
            for (size_t r = 0; r < kRows; ++r)
                if (below(4) == 0) {
                    rows.push_back(static_cast<double>(r));
                    for (size_t k = r * components; k < (r + 1) * components; ++k) {
                        values.push_back(wanted[k]);
                        stored[k] = 0;
                    }
                }
            const size_t number = file.accessor(stored, components, e, stride, e.bytes() * below(9));
            if (!rows.empty()) {
                const Encoding index{std::array{5121u, 5123u, 5125u}[below(3)], false};
                std::vector<uint8_t> row_bytes, value_bytes;
                for (const double r : rows) index.append(row_bytes, r);
                for (const double v : values) e.append(value_bytes, v);
                file.json["accessors"][number]["sparse"] = {
                    {"count", rows.size()},
                    {"indices", {{"bufferView", file.view(row_bytes)}, {"componentType", index.type}}},
                    {"values", {{"bufferView", file.view(value_bytes)}}}};
            }
            file.primitive()["attributes"][name] = number;
            return wanted;
        };
        const auto positions = attribute("POSITION", 3, 100), normals = attribute("NORMAL", 3, 1),
                   uvs = attribute("TEXCOORD_0", 2, 10);
        const auto read_one = read(file);
        ASSERT_TRUE(read_one.ok()) << read_one.error();
        const Mesh& mesh = read_one->mesh;
        if (read_one->collapsed > 0) continue;  // small bytes may fall on each other
        ++compared;
        ASSERT_EQ(mesh.triangles.size(), kRows / 3);
        for (size_t c = 0; c < kRows; ++c) {
            const Vec3 p = mesh.positions[mesh.triangles[c / 3][c % 3]];
            EXPECT_EQ(p, Vec3d(positions[3 * c], positions[3 * c + 1], positions[3 * c + 2]).to_float() + Vec3{});
            const Vec3d n = normalised(Vec3d(normals[3 * c], normals[3 * c + 1], normals[3 * c + 2]));
            EXPECT_TRUE(length(n) == 0 || length(n - Vec3d(mesh.corner_normals[c])) < 1e-6) << c;
            EXPECT_EQ(mesh.corner_uvs[c].x, static_cast<float>(uvs[2 * c]));
            EXPECT_EQ(mesh.corner_uvs[c].y, static_cast<float>(1 - uvs[2 * c + 1]));
        }
    }
    EXPECT_GE(compared, 250);
}

TEST_F(Gltf, BothLowestValuesOfASignedTypeAreMinusOne) {
    GltfFile file;
    std::vector<uint8_t> bytes{0x80, 0x7F, 0, 0, 0x81, 0x7F, 0x7F, 0, 0x81, 0x80, 0x80, 0x7F};
    file.json["accessors"] = {{{"bufferView", file.view(bytes, 4)},
                               {"componentType", 5120},
                               {"normalized", true},
                               {"count", 3},
                               {"type", "VEC3"}}};
    file.primitive()["attributes"]["POSITION"] = 0;
    const Mesh mesh = model(file).mesh;
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.positions[0], (Vec3{-1, 1, 0}));
    EXPECT_EQ(mesh.positions[1], (Vec3{-1, 1, 1}));
    EXPECT_EQ(mesh.positions[2], (Vec3{-1, -1, -1}));
}

TEST_F(Gltf, AnAccessorWithoutBytesIsZerosButForItsSparseRows) {
    GltfFile file = house();
    std::vector<uint8_t> rows, values;
    for (size_t p = 1; p < 9; ++p) Encoding{5121, false}.append(rows, static_cast<double>(p));
    for (size_t p = 1; p < 9; ++p)
        for (int k = 0; k < 3; ++k) Encoding{}.append(values, kHousePoints[p][k]);
    nlohmann::json& accessor = file.json["accessors"][0];
    accessor.erase("bufferView");
    accessor["sparse"] = {{"count", 8},
                          {"indices", {{"bufferView", file.view(rows)}, {"componentType", 5121}}},
                          {"values", {{"bufferView", file.view(values)}}}};
    expect_house(model(file).mesh);
}

TEST_F(Gltf, IndicesOfEveryTypeAreRead) {
    for (const unsigned type : {5121u, 5123u, 5125u}) {
        GltfFile file;
        file.primitive()["attributes"]["POSITION"] = file.points(kHousePoints);
        file.primitive()["indices"] = file.indices(kHouseTriangles, type);
        expect_house(model(file).mesh);
    }
}

TEST_F(Gltf, WhatDoesNotFitIsRefusedByItsPlace) {
    const auto expect = [this](const char* words, const std::function<void(GltfFile&)>& change) {
        GltfFile file = house();
        change(file);
        const std::string said = refusal(file);
        EXPECT_NE(said.find(words), said.npos) << said;
    };
    expect("accessors[0] reaches to byte", [](GltfFile& f) { f.json["accessors"][0]["count"] = 10; });
    expect("accessors[0] reaches to byte", [](GltfFile& f) { f.json["accessors"][0]["count"] = 4294967295u; });
    expect("accessors[0].count is -1", [](GltfFile& f) { f.json["accessors"][0]["count"] = -1; });
    expect("accessors[0].count is 1.5", [](GltfFile& f) { f.json["accessors"][0]["count"] = 1.5; });
    expect("accessors[0] reaches to byte", [](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = 4; });
    expect("accessors[0] reaches", [](GltfFile& f) { f.json["accessors"][0]["byteOffset"] = 9007199254740992u; });
    expect("at a stride of 8", [](GltfFile& f) { f.json["bufferViews"][0]["byteStride"] = 8; });
    expect("byteStride is", [](GltfFile& f) { f.json["bufferViews"][0]["byteStride"] = 1u << 30; });
    expect("componentType is 5124", [](GltfFile& f) { f.json["accessors"][0]["componentType"] = 5124; });
    expect("has 2 components", [](GltfFile& f) { f.json["accessors"][0]["type"] = "VEC2"; });
    expect("is none of SCALAR", [](GltfFile& f) { f.json["accessors"][0]["type"] = "VEC5"; });
    expect("bufferViews[0] reaches to byte", [](GltfFile& f) { f.json["bufferViews"][0]["byteLength"] = 1u << 30; });
    expect("is 7, but there are 2 accessors", [](GltfFile& f) { f.primitive()["indices"] = 7; });
    expect("names point 9, but there are 9", [](GltfFile& f) {
        auto triangles = kHouseTriangles;
        triangles[13][2] = 9;
        f.primitive()["indices"] = f.indices(triangles);
    });
    expect("whole numbers without a sign", [](GltfFile& f) { f.json["accessors"][1]["componentType"] = 5122; });
    expect("which integers of 32 bits may not be", [](GltfFile& f) {
        f.json["accessors"][1]["componentType"] = 5125;
        f.json["accessors"][1]["normalized"] = true;
    });
    expect("is a text, not a list", [](GltfFile& f) { f.json["meshes"] = "none"; });
    expect("has no \"asset\"", [](GltfFile& f) { f.json.erase("asset"); });
    expect("is glTF 3.0, not 2.0", [](GltfFile& f) { f.json["asset"]["version"] = "3.0"; });
}

// --- triangles ---

TEST_F(Gltf, StripsAndFansAreTheTrianglesOfTheirLists) {
    // A ribbon that is folded to and fro, with its winding: (0 1 2) (2 1 3) (2 3 4) ...
    std::vector<Vec3d> points;
    for (int i = 0; i < 9; ++i) points.push_back({0.5 * i, i % 2 == 0 ? 0.0 : 1.0, 0.01 * i * i});
    GltfFile strip;
    strip.primitive() = {{"mode", 5}, {"attributes", {{"POSITION", strip.points(points)}}}};
    GltfFile fan;
    fan.primitive() = {{"mode", 6}, {"attributes", {{"POSITION", fan.points(points)}}}};
    const auto expect = [](const Mesh& mesh, const std::vector<std::array<int, 3>>& wanted, const auto& all_points) {
        ASSERT_EQ(mesh.triangles.size(), wanted.size());
        for (size_t t = 0; t < wanted.size(); ++t)
            for (size_t c = 0; c < 3; ++c)
                EXPECT_EQ(mesh.positions[mesh.triangles[t][c]],
                          all_points[static_cast<size_t>(wanted[t][c])].to_float() + Vec3{});
    };
    expect(model(strip).mesh, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}, {4, 5, 6}, {5, 7, 6}, {6, 7, 8}}, points);
    expect(model(fan).mesh, {{1, 2, 0}, {2, 3, 0}, {3, 4, 0}, {4, 5, 0}, {5, 6, 0}, {6, 7, 0}, {7, 8, 0}}, points);
}

TEST_F(Gltf, PointsAndLinesAreCountedAndTheTrianglesBesideThemStay) {
    for (const auto& [mode, left_out] : {std::pair{0, 9u}, {1, 4u}, {2, 9u}, {3, 8u}}) {
        GltfFile file = house();
        nlohmann::json other = {{"mode", mode}, {"attributes", {{"POSITION", 0}}}};
        file.json["meshes"][0]["primitives"].push_back(other);
        const ConvertedModel read_one = model(file);
        expect_house(read_one.mesh);
        EXPECT_EQ(read_one.left_out, left_out) << mode;
    }
}

TEST_F(Gltf, CornersThatMakeNoTriangleAreSaid) {
    GltfFile file = house();
    file.json["accessors"][1]["count"] = 41;
    const ConvertedModel read_one = model(file);
    EXPECT_EQ(read_one.mesh.triangles.size(), 13u);
    EXPECT_TRUE(says(read_one, "2 corners at the ends of lists"));
}

TEST_F(Gltf, MaterialsAreTheirNumbersAndNoneIsTheNumberAfterTheLast) {
    GltfFile file = house();
    file.json["materials"] = {nlohmann::json::object(), nlohmann::json::object()};
    nlohmann::json second = file.primitive();
    second["material"] = 1;
    file.json["meshes"][0]["primitives"].push_back(second);
    const Mesh mesh = model(file).mesh;
    ASSERT_EQ(mesh.materials.size(), 28u);
    EXPECT_EQ(mesh.materials[0], 2);
    EXPECT_EQ(mesh.materials[27], 1);
}

// --- containers ---

TEST_F(Gltf, TextBinaryAndFileBesideAreTheSame) {
    const GltfFile file = house();
    const auto as_text = read(file);
    const auto as_binary = test::read_gltf_bytes(file.binary(), folder_ / "m.glb");
    GltfFile beside = file;
    std::ofstream(folder_ / "m.bin", std::ios::binary) << std::string(file.bytes.begin(), file.bytes.end());
    nlohmann::json whole = file.json;
    whole["buffers"] = {{{"byteLength", file.bytes.size()}, {"uri", "m.bin"}}};
    const auto as_two = test::read_gltf_bytes(whole.dump(), folder_ / "two.gltf");
    for (const auto* one : {&as_text, &as_binary, &as_two}) {
        ASSERT_TRUE(one->ok()) << one->error();
        expect_house(one->value().mesh);
        EXPECT_TRUE(one->value().notes.empty());
    }
}

/// A .glb with something in front of its JSON.
std::string with_json(const std::string& binary, const std::string& front) {
    const size_t end = binary.find("BIN") - 4;
    std::string json = front + binary.substr(20, end - 20);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string rest = binary.substr(end);
    return "glTF" + GltfFile::word(2) + GltfFile::word(20 + json.size() + rest.size()) + GltfFile::word(json.size()) +
           "JSON" + json + rest;
}

TEST_F(Gltf, MarksOtherEncodingsZerosAndStrangeLettersDoNoHarm) {
    const GltfFile file = house();
    std::string wide = "\xFF\xFE";
    for (const char c : file.text()) wide += std::string{c, '\0'};
    GltfFile named = file;
    named.json["nodes"][0]["name"] = "Gr#sse";
    std::string latin = named.text();
    latin[latin.find('#')] = '\xF6';
    const std::string binary = file.binary(), json = file.text();
    std::string zeros = binary;  // in place of the blanks that pad its chunk of JSON
    const size_t json_bytes = zeros.find("BIN") - 4 - 20;
    for (size_t at = 20 + json_bytes; zeros[at - 1] == ' '; --at) zeros[at - 1] = '\0';
    for (const std::string& bytes :
         {"\xEF\xBB\xBF" + json, wide, latin, zeros, with_json(binary, "\xEF\xBB\xBF"), with_json(binary, " \n ")}) {
        const auto read_one = test::read_gltf_bytes(bytes, folder_ / "m.gltf");
        ASSERT_TRUE(read_one.ok()) << read_one.error();
        expect_house(read_one->mesh);
    }
}

TEST_F(Gltf, ATextLongerThanItStatesIsReadAndSaid) {
    const auto read_one = test::read_gltf_bytes(house().binary() + "1234567", folder_ / "m.glb");
    ASSERT_TRUE(read_one.ok()) << read_one.error();
    EXPECT_TRUE(says(*read_one, "Passed over 7 bytes"));
}

// --- places ---

Affine random_place(std::mt19937& random) {
    const auto unit = [&random] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    const double turn[4] = {unit(), unit(), unit(), 1};
    const nlohmann::json none = nlohmann::json::object();
    return gltf::placed_by({unit(), unit(), unit()}, turn, {0.5 + unit() * unit(), 1.3, unit() < 0 ? -1.1 : 0.9},
                           gltf::Part(none, "test"));
}

std::vector<double> matrix_of(const Affine& a) {
    std::vector<double> m;
    for (int column = 0; column < 3; ++column) {
        for (const Vec3d row : a.row) m.push_back(row[column]);
        m.push_back(0);
    }
    m.insert(m.end(), {a.move.x, a.move.y, a.move.z, 1});
    return m;
}

void expect_points(const Mesh& mesh, const std::function<Vec3d(uint32_t point)>& wanted, double tolerance,
                   bool is_mirrored) {
    ASSERT_EQ(mesh.triangles.size(), kHouseTriangles.size());
    for (size_t t = 0; t < kHouseTriangles.size(); ++t)
        for (size_t c = 0; c < 3; ++c) {
            const size_t from = is_mirrored && c > 0 ? 3 - c : c;
            const Vec3d p(mesh.positions[mesh.triangles[t][c]]);
            EXPECT_LT(length(p - wanted(kHouseTriangles[t][from])), tolerance) << t << " " << c;
        }
}

TEST_F(Gltf, ANodeStandsWhereItsAncestorsPutItAndAMirroredOneKeepsItsOutside) {
    std::mt19937 random(8);
    for (int round = 0; round < 50; ++round) {
        GltfFile file = house();
        const Affine a = random_place(random), b = random_place(random), c = random_place(random);
        file.json["nodes"] = {{{"mesh", 0}, {"matrix", matrix_of(c)}},
                              {{"children", {2}}, {"matrix", matrix_of(a)}},
                              {{"children", {0}}, {"matrix", matrix_of(b)}}};
        file.json["scenes"] = {{{"nodes", {1}}}};
        const Affine all = chained(a, chained(b, c));
        const Mesh mesh = model(file).mesh;
        expect_points(
            mesh, [&](uint32_t p) { return placed(all, kHousePoints[p]); }, 1e-5, determinant(all) < 0);
        EXPECT_GT(volume_of(mesh), 0);
    }
}

TEST_F(Gltf, TranslationRotationAndScaleAreTheirMatrix) {
    GltfFile file = house();
    const double half = std::sqrt(0.5);
    file.json["nodes"][0] = {
        {"mesh", 0}, {"translation", {10, 20, 30}}, {"rotation", {0, 2 * half, 0, 2 * half}}, {"scale", {2, 3, -4}}};
    expect_points(
        model(file).mesh,
        [](uint32_t i) {
            const Vec3d p = kHousePoints[i];
            return Vec3d{10 - 4 * p.z, 20 + 3 * p.y, 30 - 2 * p.x};  // a quarter turn about y: x to -z, z to x
        },
        1e-5, true);
}

TEST_F(Gltf, TheDefaultSceneIsReadAndTheOthersAreSaid) {
    GltfFile file = house();
    file.json["nodes"].push_back({{"mesh", 0}, {"translation", {5, 0, 0}}});
    file.json["scenes"] = {{{"nodes", {1}}}, {{"nodes", {0}}}};
    file.json["scene"] = 1;
    const ConvertedModel read_one = model(file);
    expect_house(read_one.mesh);
    EXPECT_TRUE(says(read_one, "Of 2 scenes the default one was read."));
    file.json.erase("scene");
    file.json.erase("scenes");
    EXPECT_EQ(model(file).mesh.triangles.size(), 28u);
}

TEST_F(Gltf, NodesWithTwoParentsOrNoBeginningAreRefused) {
    const auto expect = [this](const char* words, const nlohmann::json& nodes, const nlohmann::json& roots) {
        GltfFile file = house();
        file.json["nodes"] = nodes;
        file.json["scenes"][0]["nodes"] = roots;
        const std::string said = refusal(file);
        EXPECT_NE(said.find(words), said.npos) << said;
    };
    expect("is its own ancestor", {{{"children", {0}}}}, {0});
    expect("is its own ancestor", {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}}, {0});
    expect("is a child of", {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}}, {0, 1});
    expect("is a child of", {{{"children", {1, 1}}}, {{"mesh", 0}}}, {0});
    expect("which is a child of", {{{"children", {1}}}, {{"mesh", 0}}}, {0, 1});
    expect("a second time", {{{"mesh", 0}}}, {0, 0});
    expect("but there are 1 nodes", {{{"mesh", 0}}}, {3});
}

TEST_F(Gltf, ADeepTreeIsRead) {
    GltfFile file = house();
    for (int i = 0; i < 20000; ++i) file.json["nodes"].push_back({{"children", {i + 2}}, {"translation", {0, 0, 1}}});
    file.json["nodes"].back()["children"] = {0};
    file.json["scenes"][0]["nodes"] = {1};
    expect_points(
        model(file).mesh,
        [](uint32_t p) {
            return kHousePoints[p] + Vec3d{0, 0, 20000};
        },
        1e-6, false);
}

// --- skins, weights and instances ---

/// Two joints, whose places and binding are any; the points hang on both.
TEST_F(Gltf, ASkinnedMeshStandsWhereItsJointsPutItWhereverItsNodeIs) {
    std::mt19937 random(3);
    const Encoding weight_encodings[] = {{5126, false}, {5121, true}, {5123, true}};
    int turned_over = 0;
    for (int round = 0; round < 60; ++round) {
        GltfFile file = house();
        Affine place[2], inverse[2];
        std::vector<double> inverses, joints, weights;
        for (int j = 0; j < 2; ++j) {
            place[j] = random_place(random);
            inverse[j] = random_place(random);
            for (const double m : matrix_of(inverse[j])) inverses.push_back(static_cast<double>(static_cast<float>(m)));
        }
        const Encoding encoding = weight_encodings[round % 3];
        for (size_t p = 0; p < 9; ++p) {
            const double w = encoding.stored(static_cast<double>(p) / 8);
            joints.insert(joints.end(), {0, 1, 0, 0});
            weights.insert(weights.end(), {w, encoding.stored(1 - w), 0, 0});
        }
        auto& attributes = file.primitive()["attributes"];
        attributes["JOINTS_0"] = file.accessor(joints, 4, {round % 2 == 0 ? 5121u : 5123u, false});
        attributes["WEIGHTS_0"] = file.accessor(weights, 4, encoding);
        const size_t matrices = file.accessor(inverses, 16, {}, 0, 0, "MAT4");
        file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 200, 300}}},
                              {{"matrix", matrix_of(place[0])}},
                              {{"matrix", matrix_of(place[1])}}};
        file.json["scenes"][0]["nodes"] = {0, 1};  // joint 2 is in no scene
        file.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", matrices}}};
        const Mesh mesh = model(file).mesh;
        const auto wanted = [&](uint32_t p) {
            const double w = weights[4 * p], v = weights[4 * p + 1];
            return (1 / (w + v)) * (w * placed(chained(place[0], inverse[0]), kHousePoints[p]) +
                                    v * placed(chained(place[1], inverse[1]), kHousePoints[p]));
        };
        ASSERT_EQ(mesh.triangles.size(), 14u);
        const auto is_mirrored = [&](uint32_t p) {
            const Affine a = chained(place[0], inverse[0]), b = chained(place[1], inverse[1]);
            Affine sum;
            for (int i = 0; i < 3; ++i) sum.row[i] = weights[4 * p] * a.row[i] + weights[4 * p + 1] * b.row[i];
            return determinant(sum) < 0;
        };
        for (size_t t = 0; t < 14; ++t) {
            double nearest[2] = {0, 0};  // as it stands, and turned over
            for (size_t c = 0; c < 3; ++c)
                for (size_t k = 0; k < 2; ++k) {
                    const size_t from = k == 1 && c > 0 ? 3 - c : c;
                    const Vec3d p(mesh.positions[mesh.triangles[t][c]]);
                    nearest[k] = std::max(nearest[k], length(p - wanted(kHouseTriangles[t][from])));
                }
            EXPECT_LT(std::min(nearest[0], nearest[1]), 2e-5);
            const auto& corners = kHouseTriangles[t];
            const auto mirrored = std::count_if(corners.begin(), corners.end(), is_mirrored);
            if (mirrored % 3 == 0) {
                EXPECT_LT(nearest[mirrored == 3 ? 1 : 0], 2e-5) << t;
            }
            turned_over += mirrored == 3;
        }
    }
    EXPECT_GE(turned_over, 50);
}

/// The same house as six seams would have it: each corner a point of its own, hung on other joints in another order.
/// The joints stand about a point so far from the origin.
GltfFile bound_house(double far) {
    GltfFile file;
    std::vector<Vec3d> points;
    std::vector<double> joints, weights, inverses;
    std::mt19937 random(5);
    for (const auto& triangle : kHouseTriangles)
        for (const uint32_t p : triangle) {
            points.push_back(kHousePoints[p]);
            for (int i = 0; i < 4; ++i) {
                joints.push_back(static_cast<double>(random() % 3));
                weights.push_back(0.1 + static_cast<double>(random()) / 4294967296.0);
            }
        }
    file.primitive()["attributes"] = {{"POSITION", file.points(points)},
                                      {"JOINTS_0", file.accessor(joints, 4, {5121, false})},
                                      {"WEIGHTS_0", file.accessor(weights, 4, {})}};
    file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}};
    for (int j = 0; j < 3; ++j) {
        // A turn about y and a move: its inverse is easily written.
        const double angle = 0.4 + j, c = std::cos(angle), s = std::sin(angle), x = 30.3 * j + far, z = -7.7 - far;
        const Affine place{{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}, {x, 1.5, z}};
        const Affine inverse{{{c, 0, -s}, {0, 1, 0}, {s, 0, c}}, {-c * x + s * z, -1.5, -s * x - c * z}};
        file.json["nodes"].push_back({{"matrix", matrix_of(place)}});
        for (const double m : matrix_of(inverse)) inverses.push_back(m);
    }
    file.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    file.json["skins"] = {
        {{"joints", {1, 2, 3}}, {"inverseBindMatrices", file.accessor(inverses, 16, {}, 0, 0, "MAT4")}}};
    return file;
}

TEST_F(Gltf, JointsThatRestAsBoundLeaveAMeshWholeToTheLastBitHoweverFarTheyStand) {
    for (const double far : {0.0, 500.0, 2000.0, 20000.0, 1e6}) {
        const ConvertedModel read_one = model(bound_house(far));
        expect_house(read_one.mesh, 1e-5 + far * 1e-6);
        EXPECT_EQ(read_one.joined, 42u - 9u) << far;
    }
}

TEST_F(Gltf, JointsThatAreNotThereAreRefusedAndPointsWithoutAnyAreSaid) {
    GltfFile file = house();
    std::vector<double> joints(36, 0), weights(36, 0);
    file.json["skins"] = {{{"joints", {0}}}};
    file.json["nodes"][0]["skin"] = 0;
    auto& attributes = file.primitive()["attributes"];
    attributes["JOINTS_0"] = file.accessor(joints, 4, {5121, false});
    attributes["WEIGHTS_0"] = file.accessor(weights, 4, {});
    const ConvertedModel read_one = model(file);
    expect_house(read_one.mesh);
    EXPECT_TRUE(says(read_one, "9 points of skins hang on no joint"));
    joints[8] = 3;
    weights[8] = 1;
    attributes["JOINTS_0"] = file.accessor(joints, 4, {5121, false});
    attributes["WEIGHTS_0"] = file.accessor(weights, 4, {});
    const std::string said = refusal(file);
    EXPECT_NE(said.find("hangs point 2 on joint 3, but the skin has 1"), said.npos) << said;
}

TEST_F(Gltf, DefaultWeightsOfTheNodeComeBeforeThoseOfTheMesh) {
    for (int round = 0; round < 8; ++round) {
        GltfFile file = house();
        const bool has_node = (round & 1) != 0, has_mesh = (round & 2) != 0, is_sparse = (round & 4) != 0;
        std::vector<Vec3d> up(9), aside(9);
        up[8] = {0, 0.5, 0};
        for (Vec3d& a : aside) a = {0, 0, 2};
        const size_t first = is_sparse ? file.json["accessors"].size() : file.points(up);
        if (is_sparse) {
            std::vector<uint8_t> row, value;
            Encoding{5121, false}.append(row, 8);
            for (int k = 0; k < 3; ++k) Encoding{}.append(value, up[8][k]);
            const nlohmann::json sparse = {{"count", 1},
                                           {"indices", {{"bufferView", file.view(row)}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", file.view(value)}}}};
            file.json["accessors"].push_back(
                {{"componentType", 5126}, {"count", 9}, {"type", "VEC3"}, {"sparse", sparse}});
        }
        file.primitive()["targets"] = {{{"POSITION", first}}, {{"POSITION", file.points(aside)}}};
        if (has_node) file.json["nodes"][0]["weights"] = {1, 0.5};
        if (has_mesh) file.json["meshes"][0]["weights"] = {-1, 0};
        const double a = has_node ? 1 : has_mesh ? -1 : 0, b = has_node ? 0.5 : 0;
        expect_points(
            model(file).mesh, [&](uint32_t p) { return kHousePoints[p] + a * up[p] + b * aside[p]; }, 1e-6, false);
    }
}

TEST_F(Gltf, MorphTargetsOfIntegersMoveNormalsAndTextureCoordinatesToo) {
    GltfFile file = house();
    std::vector<double> normals(27, 0), deltas(27, 0), uvs(18, 0.25), uv_deltas(18, 0.5);
    for (size_t p = 0; p < 9; ++p) normals[3 * p + 1] = 1, deltas[3 * p] = 1, deltas[3 * p + 1] = -1;
    file.primitive()["attributes"]["NORMAL"] = file.accessor(normals, 3, {5120, true}, 4);
    file.primitive()["attributes"]["TEXCOORD_0"] = file.accessor(uvs, 2, {5126, false});
    file.primitive()["targets"] = {{{"NORMAL", file.accessor(deltas, 3, {5120, true}, 4)},
                                    {"TEXCOORD_0", file.accessor(uv_deltas, 2, {5126, false})}}};
    file.json["meshes"][0]["weights"] = {1};
    const Mesh mesh = model(file).mesh;
    ASSERT_EQ(mesh.corner_normals.size(), 42u);
    for (const Vec3 n : mesh.corner_normals) EXPECT_EQ(n, (Vec3{1, 0, 0}));
    for (const Vec2 uv : mesh.corner_uvs) EXPECT_EQ(uv.x, 0.75f);
}

TEST_F(Gltf, InstancesStandAtTheirNodeInPlaceOfIt) {
    std::mt19937 random(12);
    int mirrored = 0;
    const auto unit = [&random] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    for (const Encoding turn_encoding : {Encoding{5126, false}, Encoding{5120, true}, Encoding{5122, true}}) {
        GltfFile file = house();
        const Affine node = random_place(random);
        std::vector<double> moves, turns, sizes;
        for (int i = 0; i < 5; ++i) {
            for (int k = 0; k < 3; ++k) moves.push_back(static_cast<double>(static_cast<float>(20 * unit())));
            for (int k = 0; k < 4; ++k) turns.push_back(turn_encoding.stored(unit()));
            for (int k = 0; k < 3; ++k)
                sizes.push_back(static_cast<double>(static_cast<float>((unit() < 0 ? -1 : 1) * (1.5 + unit()))));
        }
        file.json["nodes"][0] = {{"mesh", 0}, {"matrix", matrix_of(node)}};
        file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
            {"TRANSLATION", file.accessor(moves, 3, {})},
            {"ROTATION", file.accessor(turns, 4, turn_encoding)},
            {"SCALE", file.accessor(sizes, 3, {})}};
        file.json["extensionsRequired"] = file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
        const Mesh mesh = model(file).mesh;
        ASSERT_EQ(mesh.triangles.size(), 5 * 14u);
        const nlohmann::json none = nlohmann::json::object();
        for (size_t i = 0; i < 5; ++i) {
            const Affine own =
                gltf::placed_by({moves[3 * i], moves[3 * i + 1], moves[3 * i + 2]}, &turns[4 * i],
                                {sizes[3 * i], sizes[3 * i + 1], sizes[3 * i + 2]}, gltf::Part(none, "test"));
            const Affine place = chained(node, own);
            const bool is_mirrored = determinant(place) < 0;
            mirrored += is_mirrored;
            for (size_t c = 0; c < 42; ++c) {
                const size_t from = is_mirrored && c % 3 > 0 ? 3 - c % 3 : c % 3;  // its winding is turned
                const Vec3d p(mesh.positions[mesh.triangles[14 * i + c / 3][c % 3]]);
                EXPECT_LT(length(p - placed(place, kHousePoints[kHouseTriangles[c / 3][from]])), 1e-4);
            }
        }
    }
    EXPECT_GE(mirrored, 3);
    EXPECT_LE(mirrored, 12);
}

// --- extensions and what is not kept ---

TEST_F(Gltf, RequiredExtensionsThatAreNotReadAreRefusedByTheirNames) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression", "MSFT_lod", "KHR_node_visibility",
                             "KHR_gaussian_splatting", "KHR_materials_displacement", "KHR_texture_basisu_geometry",
                             "VRMC_shape", "AGI_terrain", "KHR_materials_", "KHR_audio2", "X"}) {
        GltfFile file = house();
        file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_mesh_quantization", name};
        const std::string said = refusal(file);
        EXPECT_NE(said.find("requires the extension \"" + std::string(name) + "\""), said.npos) << said;
    }
    GltfFile many = house();
    for (int i = 0; i < 1000; ++i) many.json["extensionsRequired"].push_back("X_" + std::to_string(i));
    const std::string said = refusal(many);
    EXPECT_NE(said.find("\"X_7\" and 992 more"), said.npos) << said;
}

TEST_F(Gltf, UsedExtensionsThatAreNotReadAreSaidAndThoseOfLooksAreNot) {
    GltfFile file = house();
    file.json["extensionsUsed"] = {"MSFT_lod", "KHR_materials_unlit", "KHR_texture_basisu", "KHR_mesh_quantization"};
    file.json["extensionsRequired"] = {"KHR_texture_basisu", "KHR_materials_unlit"};
    const ConvertedModel read_one = model(file);
    expect_house(read_one.mesh);
    ASSERT_EQ(read_one.notes.size(), 1u);
    EXPECT_EQ(read_one.notes[0], "Read without the extension \"MSFT_lod\".");
}

TEST_F(Gltf, WhatAMeshFileDoesNotHoldIsOneSentence) {
    GltfFile file = house();
    auto& attributes = file.primitive()["attributes"];
    attributes["COLOR_0"] = file.accessor(std::vector<double>(27, 0.5), 3, {});
    attributes["TANGENT"] = file.accessor(std::vector<double>(36, 0.5), 4, {});
    for (const char* set : {"TEXCOORD_0", "TEXCOORD_1", "TEXCOORD_2"})
        attributes[set] = file.accessor(std::vector<double>(18, 0.5), 2, {});
    file.json["animations"] = {1, 2, 3};
    file.json["cameras"] = {1};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}, {{"type", "spot"}}};
    const ConvertedModel read_one = model(file);
    expect_house(read_one.mesh);
    ASSERT_EQ(read_one.notes.size(), 1u);
    EXPECT_EQ(read_one.notes[0],
              "Not kept: vertex colours, tangents, 2 further sets of texture coordinates, 3 animations, 1 camera, 2 "
              "lights.");
}

TEST_F(Gltf, TextureCoordinatesAreThoseThatTheBaseColourTakes) {
    GltfFile file = house();
    auto& attributes = file.primitive()["attributes"];
    attributes["TEXCOORD_0"] = file.accessor(std::vector<double>(18, 0.125), 2, {});
    std::vector<double> second;
    for (int p = 0; p < 9; ++p) second.insert(second.end(), {p / 8.0, p / 16.0});
    attributes["TEXCOORD_1"] = file.accessor(second, 2, {5123, true});
    file.primitive()["material"] = 0;
    const double quarter = std::acos(0.0);
    file.json["extensionsRequired"] = {"KHR_texture_transform"};
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {
        {"index", 0},
        {"extensions",
         {{"KHR_texture_transform",
           {{"texCoord", 1}, {"offset", {0.5, 0.25}}, {"rotation", quarter}, {"scale", {2, 3}}}}}}};
    file.json["materials"][0]["normalTexture"] = {{"index", 1}};
    const ConvertedModel read_one = model(file);
    for (size_t c = 0; c < 42; ++c) {
        const double u = kHouseTriangles[c / 3][c % 3] / 8.0, v = u / 2;
        EXPECT_NEAR(read_one.mesh.corner_uvs[c].x, 0.5 + 3 * v, 1e-4);
        EXPECT_NEAR(read_one.mesh.corner_uvs[c].y, 1 - (0.25 - 2 * u), 1e-4);
    }
    EXPECT_TRUE(says(read_one, "those that the base colour is looked up with"));
    EXPECT_TRUE(says(read_one, "Other textures of a material take other coordinates"));
}

/// The example in the text of KHR_texture_transform: what is turned by a quarter, halved and moved by (0, 1) shows the
/// lower left quarter of the picture.
TEST_F(Gltf, TheExampleOfTheTextureTransformShowsTheLowerLeftQuarter) {
    GltfFile file = house();
    std::vector<double> uvs;
    for (int p = 0; p < 9; ++p) uvs.insert(uvs.end(), {p / 8.0, (p * 5 % 9) / 8.0});
    file.primitive()["attributes"]["TEXCOORD_0"] = file.accessor(uvs, 2, {});
    file.primitive()["material"] = 0;
    file.json["materials"][0]["emissiveTexture"] = {
        {"index", 0},
        {"extensions",
         {{"KHR_texture_transform", {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}}}}}};
    Vec2 low{1, 1}, high{0, 0};
    for (const Vec2 uv : model(file).mesh.corner_uvs) {
        low = {std::fmin(low.x, uv.x), std::fmin(low.y, uv.y)};
        high = {std::fmax(high.x, uv.x), std::fmax(high.y, uv.y)};
    }
    EXPECT_NEAR(low.x, 0, 1e-6);
    EXPECT_NEAR(low.y, 0, 1e-6);
    EXPECT_NEAR(high.x, 0.5, 1e-6);
    EXPECT_NEAR(high.y, 0.5, 1e-6);  // a mesh file counts v from below
}

}  // namespace
}  // namespace cullet
