// The speeds at which a body cracks and breaks, found by bisection.
#pragma once
#include "sample_game/hit_bench.hpp"

namespace cullet {

/// m/s; infinite when no speed below kMostThreshold does it.
struct Thresholds {
    double first_crack = 0, first_piece = 0;
    uint32_t runs = 0, dropped = 0;
};
inline constexpr double kMostThreshold = 100;     // m/s
inline constexpr double kBisectionRatio = 1.013;  // between the speeds that do and do not

/// Of one placement. `guess`, m/s, only saves time. About 12 hits.
Thresholds find_thresholds(HitBench& bench, uint32_t placement, double guess);
/// The same with the steps of the hidden runs scaled: what has become of `known`. Whether a piece comes off is not
/// monotone in the speed (a star may stop short where a slower blow's crack ran round), so there are several crossings,
/// and two searches of their own end at different ones. This one finds the crossing nearest to the known.
Thresholds follow_thresholds(HitBench& bench, uint32_t placement, float step_scale, const Thresholds& known);

struct MedianSpread {
    double median = 0, least = 0, most = 0;
};
/// Median of an even number: the mean of the middle two.
MedianSpread spread_of(std::vector<double> values);

}  // namespace cullet
