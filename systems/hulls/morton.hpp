// Order along a Morton curve: what is near in space is near in the list.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cullet {

/// Two zeros between the bits of a number below 1,024.
inline uint32_t spread_bits(uint32_t ten_bits) {
    uint32_t x = ten_bits & 1023u;
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

/// Sorts numbers of codes of 30 bits in three stable passes: equal codes keep their order. `sorted` is room for as
/// many.
inline void sort_by_code(std::span<const uint32_t> codes, std::vector<uint32_t>& order, std::vector<uint32_t>& sorted) {
    for (uint32_t shift = 0; shift < 30; shift += 10) {
        std::array<uint32_t, 1025> start{};
        for (const uint32_t code : codes) ++start[((code >> shift) & 1023u) + 1];
        for (size_t k = 0; k < 1024; ++k) start[k + 1] += start[k];
        for (const uint32_t item : order) sorted[start[(codes[item] >> shift) & 1023u]++] = item;
        order.swap(sorted);
    }
}

}  // namespace cullet
