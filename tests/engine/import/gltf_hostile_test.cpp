// glTF files that are damaged: every truncation, every value of the JSON replaced by others, bytes thrown about. Each
// is read, or refused in one sentence; nothing else is thrown, and (under the address sanitizer) nothing else is
// touched.
#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <random>

#include "tests/support/gltf_file.hpp"

namespace cullet {
namespace {

using Encoding = test::NumberEncoding;
using test::GltfFile;
using test::kHousePoints;
using test::kHouseTriangles;

class GltfHostile : public testing::Test {
 protected:
    /// True when it was read. What is read keeps the promises that cooking relies on, or is refused by the next check.
    bool read(const std::string& bytes, const char* name = "m.gltf") {
        try {
            const auto model = test::read_gltf_bytes(bytes, name);
            if (!model) {
                EXPECT_EQ(model.error().back(), '.') << model.error();
                EXPECT_EQ(model.error().find('\n'), std::string::npos) << model.error();
                EXPECT_LT(model.error().size(), 1000u) << model.error();
                return false;
            }
            for (const auto& t : model->mesh.triangles)
                for (const uint32_t v : t) EXPECT_LT(v, model->mesh.positions.size());
            return true;
        } catch (const std::bad_alloc&) {  // the process that reads strangers' files makes a sentence of it
            return false;
        }
    }
};

/// One file that holds everything that the reader knows.
GltfFile everything() {
    GltfFile file;
    auto& attributes = file.primitive()["attributes"];
    attributes["POSITION"] = file.accessor(GltfFile::numbers_of(kHousePoints), 3, {5126, false}, 16, 4);
    attributes["NORMAL"] = file.accessor(std::vector<double>(27, 1), 3, {5120, true}, 4);
    attributes["TEXCOORD_0"] = file.accessor(std::vector<double>(18, 0.5), 2, {5123, true});
    attributes["JOINTS_0"] = file.accessor(std::vector<double>(36, 0), 4, {5121, false});
    attributes["WEIGHTS_0"] = file.accessor(std::vector<double>(36, 0.25), 4, {5121, true});
    file.primitive()["indices"] = file.indices(kHouseTriangles);
    std::vector<uint8_t> rows, values;
    for (const int row : {2, 5}) {
        Encoding{5123, false}.append(rows, row);
        for (int k = 0; k < 3; ++k) Encoding{}.append(values, 1);
    }
    file.json["accessors"].push_back({{"componentType", 5126}, {"count", 9}, {"type", "VEC3"}});
    file.json["accessors"].back()["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", file.view(rows)}, {"byteOffset", 0}, {"componentType", 5123}}},
        {"values", {{"bufferView", file.view(values)}, {"byteOffset", 0}}}};
    file.primitive()["targets"] = {{{"POSITION", file.json["accessors"].size() - 1}}};
    file.json["meshes"][0]["weights"] = {0.5};
    nlohmann::json strip = {{"mode", 5}, {"attributes", {{"POSITION", 0}}}};
    file.json["meshes"].push_back({{"primitives", {strip}}});
    std::vector<double> identity(16, 0);
    for (size_t i = 0; i < 16; i += 5) identity[i] = 1;
    const size_t matrices = file.accessor(identity, 16, {}, 0, 0, "MAT4");
    file.json["skins"] = {{{"joints", {1}}, {"inverseBindMatrices", matrices}}};
    const size_t moves = file.accessor({0, 0, 0, 5, 5, 5}, 3, {});
    file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}},
                          {{"children", {2}}, {"translation", {1, 2, 3}}, {"rotation", {0, 0, 0, 1}}},
                          {{"mesh", 1}, {"scale", {1, 1, -1}}}};
    file.json["nodes"][2]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = moves;
    file.json["scenes"][0]["nodes"] = {0, 1};
    file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    file.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0.5}}, {"rotation", 1}, {"scale", {2, 2}}};
    file.primitive()["material"] = 0;
    return file;
}

TEST_F(GltfHostile, TheWholeFileIsRead) {
    EXPECT_TRUE(read(everything().text()));
    EXPECT_TRUE(read(everything().binary(), "m.glb"));
}

TEST_F(GltfHostile, EveryTruncationIsRefused) {
    const std::string text = everything().text(), binary = everything().binary();
    for (size_t length = 0; length < text.size(); ++length) EXPECT_FALSE(read(text.substr(0, length))) << length;
    for (size_t length = 0; length < binary.size(); ++length)
        EXPECT_FALSE(read(binary.substr(0, length), "m.glb")) << length;
}

/// All parts of a JSON, itself last.
void collect(nlohmann::json& value, std::vector<nlohmann::json*>& parts) {
    if (value.is_structured())
        for (auto& child : value) collect(child, parts);
    parts.push_back(&value);
}

/// Long lists of zeros cost time and nothing else; the limit on time is tested elsewhere.
bool is_only_long(const GltfFile& file) {
    const auto& accessors = file.json.contains("accessors") ? file.json["accessors"] : nlohmann::json();
    return accessors.is_array() && std::any_of(accessors.begin(), accessors.end(), [](const nlohmann::json& a) {
               return a.is_object() && a.contains("count") && a["count"].is_number() && a["count"] > 100000 &&
                      (!a.contains("bufferView"));
           });
}

TEST_F(GltfHostile, EveryValueMayBeAnyOther) {
    const nlohmann::json others[] = {0,
                                     1,
                                     2,
                                     3,
                                     7,
                                     255,
                                     65535,
                                     4294967295u,
                                     9007199254740992u,
                                     -1,
                                     1e300,
                                     1.5,
                                     -0.0,
                                     2147483648,
                                     "",
                                     "x",
                                     true,
                                     nullptr,
                                     nlohmann::json::array(),
                                     nlohmann::json::object(),
                                     {0},
                                     {1, 2, 3},
                                     {-1},
                                     {{"x", 1}}};
    const size_t count = [] {
        GltfFile file = everything();
        std::vector<nlohmann::json*> parts;
        collect(file.json, parts);
        return parts.size() - 1;  // without the whole
    }();
    size_t were_read = 0, all = 0;
    for (size_t i = 0; i < count; ++i)
        for (const nlohmann::json& other : others) {
            GltfFile file = everything();
            std::vector<nlohmann::json*> parts;
            collect(file.json, parts);
            *parts[i] = other;
            if (is_only_long(file)) continue;
            were_read += read(file.text());
            ++all;
        }
    EXPECT_GT(all, 4000u);
    EXPECT_GT(were_read, all / 20);  // names, looks and what nobody asks for
}

TEST_F(GltfHostile, SeveralValuesAtOnceMayBeAnyNumber) {
    std::mt19937 random(7);
    for (int round = 0; round < 8000; ++round) {
        GltfFile file = everything();
        std::vector<nlohmann::json*> parts;
        collect(file.json, parts);
        for (int change = 0; change < 3; ++change) {
            nlohmann::json& part = *parts[random() % parts.size()];
            if (!part.is_number()) continue;
            const uint64_t bits = random() % 4 == 0 ? random() : random() % 300;
            part = random() % 3 == 0 ? nlohmann::json(-static_cast<double>(bits)) : nlohmann::json(bits);
        }
        if (!is_only_long(file)) read(file.text());
    }
}

TEST_F(GltfHostile, BytesOfABinaryFileMayBeAny) {
    std::mt19937 random(9);
    const std::string whole = everything().binary();
    for (int round = 0; round < 8000; ++round) {
        std::string bytes = whole;
        const size_t reach = round % 2 == 0 ? bytes.size() : 28;  // the headers get their share
        for (int change = 0; change < 4; ++change) bytes[random() % reach] = static_cast<char>(random());
        try {
            read(bytes, "m.glb");
        } catch (const std::exception& e) {
            ADD_FAILURE() << "round " << round << ": " << e.what();
        }
    }
}

}  // namespace
}  // namespace cullet
