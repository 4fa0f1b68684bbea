// What the measurements share. Each scene is one function in a file of its own.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace cullet::perf {

struct Options {
    std::string scene = "all";
    std::vector<unsigned> threads{1, 2};
    std::string simd = "best";  // best, scalar, sse4, avx2, avx512
};

/// Seconds that the call took.
template <class Call>
double seconds(Call call) {
    const auto start = std::chrono::steady_clock::now();
    call();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The hidden brittle step and stress check, beside the bare kernel and plain element loops. False: some results
/// differ.
bool measure_hidden_step(const Options& options);

}  // namespace cullet::perf
