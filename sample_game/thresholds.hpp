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

/// Two hits one after the other: how fast the second must be for a piece to come off, against a first that left the
/// body whole and cracked as far as it could.
struct SecondHit {
    double first_piece = 0;  // m/s, of the first hit
    double whole_speed =
        0;  // m/s, of the first hit that was kept: the fastest that leaves the body whole and cracked; 0: none
    uint32_t cut_edges = 0;      // by it; 0: the body breaks before it cracks, and there is nothing to go on from
    uint32_t tips = 0;           // of its cracks
    uint32_t tips_gone_on = 0;   // of them, those from which the second hit at its threshold cut on
    double same_place = 0;       // m/s, second hit there
    double elsewhere = 0;        // m/s, second hit of another placement
    double elsewhere_alone = 0;  // m/s, that placement on an intact body
};
SecondHit find_second_hit(HitBench& bench, uint32_t placement, uint32_t other_placement, double guess);

struct MedianSpread {
    double median = 0, least = 0, most = 0;
};
/// Median of an even number: the mean of the middle two.
MedianSpread spread_of(std::vector<double> values);

}  // namespace cullet
