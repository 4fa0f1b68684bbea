// What memory alone takes: the least for what moves so many bytes.
#pragma once
#include <immintrin.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cullet::perf {

/// So many bytes, read in order and summed, by chunks of 128 KB.
class Stream {
 public:
    explicit Stream(size_t bytes) : lines_(bytes / sizeof(Line)) {}
    uint32_t chunks() const { return static_cast<uint32_t>((lines_.size() + kLines - 1) / kLines); }
    void read(uint32_t chunk) {
        const size_t first = size_t{chunk} * kLines, end = std::min(first + kLines, lines_.size());
        sum_.fetch_add(sum(lines_[first].word, (end - first) * kWords), std::memory_order_relaxed);
    }
    void read_all() {
        for (uint32_t chunk = 0; chunk < chunks(); ++chunk) read(chunk);
    }

 private:
    static constexpr size_t kWords = 16, kLines = 2048;
    struct alignas(64) Line {
        uint32_t word[kWords] = {};
    };
    __attribute__((target("avx2"))) static uint32_t sum(const uint32_t* words, size_t count) {
        __m256i sums[8] = {};
        for (size_t i = 0; i < count; i += 64)
            for (size_t k = 0; k < 8 && i + 8 * k < count; ++k)
                sums[k] =
                    _mm256_add_epi32(sums[k], _mm256_load_si256(reinterpret_cast<const __m256i*>(words + i + 8 * k)));
        for (size_t k = 1; k < 8; ++k) sums[0] = _mm256_add_epi32(sums[0], sums[k]);
        return static_cast<uint32_t>(_mm256_extract_epi32(sums[0], 0) + _mm256_extract_epi32(sums[0], 5));
    }
    std::vector<Line> lines_;
    std::atomic<uint32_t> sum_{0};  // so that nothing is left out
};

}  // namespace cullet::perf
