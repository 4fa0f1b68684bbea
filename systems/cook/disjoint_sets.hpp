// Which of many things hang together.
#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace cullet {

/// Sets of numbers below `count`. The lowest member stands for its set, so that names do not hang on the order in which
/// things were joined.
class DisjointSets {
 public:
    explicit DisjointSets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    uint32_t find(uint32_t a) {
        while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
        return a;
    }
    void unite(uint32_t a, uint32_t b) {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

 private:
    std::vector<uint32_t> parent_;
};

}  // namespace cullet
