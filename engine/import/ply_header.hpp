// The head of a PLY: which elements the file holds, of which properties, in which order.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cullet/result.hpp"

namespace cullet {

enum class PlyFormat : uint8_t { Text, LittleEndian, BigEndian };
enum class PlyType : uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

uint64_t size_of(PlyType type);  // bytes in a binary file
bool is_whole(PlyType type);     // an integer

struct PlyProperty {
    std::string name;
    bool is_list = false;
    PlyType count_type = PlyType::Uint8;  // of a list
    PlyType type = PlyType::Float32;
};

struct PlyElement {
    std::string name;
    uint64_t rows = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::Text;
    std::vector<PlyElement> elements;
    size_t size = 0;  // bytes up to the first row
};

/// Refuses any line that PLY does not know.
Result<PlyHeader> read_ply_header(std::string_view bytes, const std::string& path);

}  // namespace cullet
