// What is asked of a dent beside a shell FEM.
#pragma once
#include "sample_game/metal/fem.hpp"
#include "sample_game/truth_cases.hpp"

namespace cullet {

inline constexpr double kLeastFemWork = 200;  // J: lighter ones are mostly elastic, and nothing is asked of them

/// With bounds from kLeastFemWork on; below it any figure will do.
inline std::vector<Verdict> fem_verdicts(const FemMeasures& m, double work) {
    const bool is_asked = work >= kLeastFemWork;
    const auto least = [&](double bound) { return is_asked ? bound : -1e9; };
    return {{"A = 1 - mean|y - F| / (max F - min F)", m.a, least(0.95), 1},
            {"B = 1 - mean|y - F| / mean|F - y0|", m.b, least(0.80), 1},
            {"peak over that of the FEM", m.peak_ratio, least(0.9), is_asked ? 1.15 : 1e9},
            {"place of the peak off it, of the span", m.peak_off, 0, is_asked ? 0.02 : 1e9}};
}

}  // namespace cullet
