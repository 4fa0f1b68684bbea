// A short list of vertices, each once.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>

namespace cullet {

struct VertexList {
    static constexpr uint32_t kMost = 512;
    uint32_t count = 0;
    bool has_overflowed = false;  // some vertex found no place
    uint32_t vertex[kMost];

    void add(uint32_t v) {
        uint32_t found = 0;  // counted to the end: four at a time are faster than one by one to the first
        for (uint32_t i = 0; i < count; ++i) found += vertex[i] == v;
        if (found > 0) return;
        has_overflowed |= count == kMost;
        if (count < kMost) vertex[count++] = v;
    }
    void sort() { std::sort(vertex, vertex + count); }
    void clear() { count = 0, has_overflowed = false; }
    std::span<const uint32_t> span() const { return {vertex, count}; }
};

}  // namespace cullet
