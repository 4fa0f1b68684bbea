// Random numbers of tests that draw scripts, and how many of these are played.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace cullet::test {

struct Draw {
    std::mt19937 engine;
    double within(double low, double high) {
        return low + (high - low) * static_cast<double>(engine() >> 8) / 0x1000000;
    }
    double evenly_in_scale(double low, double high) { return std::exp2(within(std::log2(low), std::log2(high))); }
};

/// As many as a variable asks for, or so many.
inline uint32_t cases_of(const char* asked, uint32_t otherwise) {
    const int count = asked ? std::atoi(asked) : 0;
    return count > 0 ? static_cast<uint32_t>(count) : otherwise;
}

}  // namespace cullet::test
