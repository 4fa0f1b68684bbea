// A ZIP of a few files, stored as they are.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cullet::test {

inline uint32_t crc32_of(const std::string& bytes) {
    uint32_t crc = ~0u;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int i = 0; i < 8; ++i) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

inline std::string small_zip(const std::vector<std::pair<std::string, std::string>>& files) {
    const auto number = [](uint64_t value, int bytes) {
        std::string out;
        for (int i = 0; i < bytes; ++i, value >>= 8) out += static_cast<char>(value & 0xff);
        return out;
    };
    std::string all, directory;
    for (const auto& [name, bytes] : files) {
        // From the version needed to the length of the extra field: the same in both headers.
        const std::string shared = number(20, 2) + number(0, 8) + number(crc32_of(bytes), 4) + number(bytes.size(), 4) +
                                   number(bytes.size(), 4) + number(name.size(), 2) + number(0, 2);
        directory += "PK\1\2" + number(20, 2) + shared + number(0, 10) + number(all.size(), 4) + name;
        all += "PK\3\4" + shared + name + bytes;
    }
    const std::string end = "PK\5\6" + number(0, 4) + number(files.size(), 2) + number(files.size(), 2) +
                            number(directory.size(), 4) + number(all.size(), 4) + number(0, 2);
    return all + directory + end;
}

}  // namespace cullet::test
