// Counter-based random numbers: a function of (seed, a, b), so that no order of calls can change them.
#pragma once
#include <cstdint>

namespace cullet {

struct Random {
    uint64_t seed = 0;

    /// 64 mixed bits (the finaliser of splitmix64, twice).
    uint64_t bits(uint64_t a, uint64_t b = 0) const { return mix(mix(seed + 0x9e3779b97f4a7c15ull * (a + 1)) + b); }
    /// In [0, 1), 53 bits.
    double uniform(uint64_t a, uint64_t b = 0) const { return static_cast<double>(bits(a, b) >> 11) * 0x1p-53; }

    static uint64_t mix(uint64_t z) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
};

}  // namespace cullet
