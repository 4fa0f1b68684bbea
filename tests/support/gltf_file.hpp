// A glTF made in a test: accessors of any kind over bytes, as text or as .glb, and what the reader makes of it.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "engine/import/corners.hpp"
#include "engine/import/gltf/read_gltf.hpp"
#include "engine/math.hpp"
#include "tests/support/house.hpp"

namespace cullet::test {

inline const std::vector<Vec3d>& kHousePoints = house_points();
inline const std::vector<std::array<uint32_t, 3>> kHouseTriangles = [] {
    std::vector<std::array<uint32_t, 3>> triangles;
    for (const auto& t : house_triangles())
        triangles.push_back({static_cast<uint32_t>(t[0]), static_cast<uint32_t>(t[1]), static_cast<uint32_t>(t[2])});
    return triangles;
}();

inline Vec3d size_of(const Mesh& mesh) {
    Vec3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (const Vec3 p : mesh.positions) {
        low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
        high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
    }
    return high - low;
}

/// What a number is when it is stored as that type: the nearest there is, normalised or as it is.
struct NumberEncoding {
    unsigned type = 5126;
    bool is_normalized = false;

    unsigned bytes() const { return type <= 5121 ? 1 : type <= 5123 ? 2 : 4; }
    double largest() const {
        return type == 5120 ? 127 : type == 5121 ? 255 : type == 5122 ? 32767 : type == 5123 ? 65535 : 4294967295.0;
    }
    bool has_sign() const { return type == 5120 || type == 5122 || type == 5126; }
    double step() const { return is_normalized ? 1 / largest() : 1; }
    double stored(double value) const {
        if (type == 5126) return static_cast<double>(static_cast<float>(value));
        return std::nearbyint(value / step()) * step();
    }
    void append(std::vector<uint8_t>& bytes, double value) const {
        const auto put = [&bytes](auto number) {
            const auto* from = reinterpret_cast<const uint8_t*>(&number);
            bytes.insert(bytes.end(), from, from + sizeof number);
        };
        if (type == 5126) return put(static_cast<float>(value));
        const auto whole = static_cast<int64_t>(std::nearbyint(value / step()));
        if (type == 5120) return put(static_cast<int8_t>(whole));
        if (type == 5121) return put(static_cast<uint8_t>(whole));
        if (type == 5122) return put(static_cast<int16_t>(whole));
        if (type == 5123) return put(static_cast<uint16_t>(whole));
        put(static_cast<uint32_t>(whole));
    }
};

constexpr const char* kTypeNames[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};

class GltfFile {
 public:
    nlohmann::json json = {{"asset", {{"version", "2.0"}}},
                           {"scene", 0},
                           {"scenes", {{{"nodes", {0}}}}},
                           {"nodes", {{{"mesh", 0}}}},
                           {"accessors", nlohmann::json::array()},
                           {"bufferViews", nlohmann::json::array()},
                           {"meshes", {{{"primitives", {{{"attributes", nlohmann::json::object()}}}}}}}};
    std::vector<uint8_t> bytes;

    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }

    size_t view(const std::vector<uint8_t>& data, size_t stride = 0) {
        while (bytes.size() % 4 != 0) bytes.push_back(0xAB);
        nlohmann::json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size()}};
        if (stride > 0) view["byteStride"] = stride;
        bytes.insert(bytes.end(), data.begin(), data.end());
        json["bufferViews"].push_back(view);
        return json["bufferViews"].size() - 1;
    }
    /// Rows of `components` numbers. `stride` 0: packed. `offset` bytes stand before the first.
    size_t accessor(const std::vector<double>& numbers, unsigned components, NumberEncoding encoding, size_t stride = 0,
                    size_t offset = 0, const char* type = nullptr) {
        std::vector<uint8_t> data(offset, 0xCD);
        for (size_t i = 0; i < numbers.size(); ++i) {
            encoding.append(data, numbers[i]);
            if (stride > 0 && (i + 1) % components == 0 && i + 1 < numbers.size())
                data.resize(data.size() + stride - components * encoding.bytes(), 0xEF);
        }
        nlohmann::json accessor = {{"bufferView", view(data, stride)},
                                   {"componentType", encoding.type},
                                   {"count", numbers.size() / components},
                                   {"type", type != nullptr ? type : kTypeNames[components]}};
        if (offset > 0) accessor["byteOffset"] = offset;
        if (encoding.is_normalized) accessor["normalized"] = true;
        json["accessors"].push_back(accessor);
        return json["accessors"].size() - 1;
    }
    size_t points(const std::vector<Vec3d>& points, NumberEncoding encoding = {}) {
        return accessor(numbers_of(points), 3, encoding);
    }
    size_t indices(const std::vector<std::array<uint32_t, 3>>& triangles, unsigned type = 5123) {
        std::vector<double> numbers;
        for (const auto& t : triangles) numbers.insert(numbers.end(), t.begin(), t.end());
        return accessor(numbers, 1, {type, false});
    }
    static std::vector<double> numbers_of(const std::vector<Vec3d>& points) {
        std::vector<double> numbers;
        for (const Vec3d p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
        return numbers;
    }
    void put_house() {
        primitive()["attributes"]["POSITION"] = points(kHousePoints);
        primitive()["indices"] = indices(kHouseTriangles);
    }

    std::string text() const {
        nlohmann::json whole = json;
        whole["buffers"] = {
            {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64()}}};
        return whole.dump();
    }
    std::string binary() const {
        nlohmann::json whole = json;
        whole["buffers"] = {{{"byteLength", bytes.size()}}};
        std::string text = whole.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string chunk(bytes.begin(), bytes.end());
        chunk.resize((chunk.size() + 3) / 4 * 4, '\0');
        return "glTF" + word(2) + word(28 + text.size() + chunk.size()) + word(text.size()) + "JSON" + text +
               word(chunk.size()) + std::string("BIN\0", 4) + chunk;
    }
    static std::string word(size_t value) {
        std::string word;
        for (int i = 0; i < 4; ++i) word += static_cast<char>(value >> (8 * i));
        return word;
    }

 private:
    std::string base64() const {
        constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (size_t i = 0; i < bytes.size(); i += 3) {
            uint32_t three = 0;
            for (size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
            for (size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
        }
        return text;
    }
};

/// A model, or the sentence why not. Anything else that is thrown fails the test.
inline Result<ConvertedModel> read_gltf_bytes(const std::string& bytes, const std::string& path) {
    try {
        return joined_model(gltf::read_document(gltf::Document({bytes.begin(), bytes.end()}, path)), path);
    } catch (const gltf::Refusal& refusal) {
        return gltf::error_of(refusal, path);
    }
}

}  // namespace cullet::test
