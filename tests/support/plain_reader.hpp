// Reads the two plainest files tests need: triangles and polygons of a Wavefront .obj, and a binary little-endian .ply
// of float positions and index lists. Trusts them.
#pragma once
#include <cstring>
#include <fstream>
#include <sstream>

#include "engine/mesh.hpp"

namespace cullet::test {

inline Mesh read_plain_obj(const std::string& path) {
    Mesh mesh;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            Vec3 p;
            words >> p.x >> p.y >> p.z;
            mesh.positions.push_back(p);
        } else if (kind == "f") {
            std::vector<uint32_t> corners;
            for (std::string word; words >> word;) corners.push_back(static_cast<uint32_t>(std::stoul(word) - 1));
            for (size_t k = 2; k < corners.size(); ++k)
                mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
        }
    }
    return mesh;
}

inline Mesh read_plain_ply(const std::string& path) {
    Mesh mesh;
    std::ifstream file(path, std::ios::binary);
    size_t vertex_count = 0, face_count = 0;
    for (std::string line; std::getline(file, line) && line.rfind("end_header", 0) != 0;) {
        std::istringstream words(line);
        std::string kind, what;
        words >> kind >> what;
        if (kind == "element" && what == "vertex") words >> vertex_count;
        if (kind == "element" && what == "face") words >> face_count;
    }
    const auto read = [&](auto& value) { file.read(reinterpret_cast<char*>(&value), sizeof value); };
    for (size_t v = 0; v < vertex_count; ++v) {
        Vec3 p;
        read(p.x), read(p.y), read(p.z);
        mesh.positions.push_back(p);
    }
    for (size_t f = 0; f < face_count && file; ++f) {
        uint8_t count = 0;
        read(count);
        std::vector<uint32_t> corners(count);
        for (uint32_t& c : corners) read(c);
        for (size_t k = 2; k < corners.size(); ++k) mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
    return mesh;
}

inline Mesh read_plain(const std::string& path) {
    Mesh mesh = path.ends_with(".obj") ? read_plain_obj(path) : read_plain_ply(path);
    mesh.name = path.substr(path.rfind('/') + 1);
    return mesh;
}

}  // namespace cullet::test
