#include "sample_game/thresholds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cullet {
namespace {

/// The least speed above `never` (which does not do it) for which does(speed) is true: widens by halves from `guess`,
/// then halves the ratio. Where it is not monotone this is one of the crossings.
template <class Does>
double bisect(double never, double guess, Does does) {
    double low = never, high = std::max(guess, never * kBisectionRatio);
    while (!does(high)) {
        low = high;
        high *= 1.5;
        if (high > kMostThreshold) return std::numeric_limits<double>::infinity();
    }
    if (low == never) {
        while (high / 1.5 > never) {
            if (!does(high / 1.5)) {
                low = high / 1.5;
                break;
            }
            high /= 1.5;
        }
    }
    while (high > kBisectionRatio * low) {
        const double middle = std::sqrt(low * high);
        (does(middle) ? high : low) = middle;
    }
    return std::sqrt(low * high);
}

}  // namespace

Thresholds find_thresholds(HitBench& bench, uint32_t placement, float step_scale, double guess) {
    Thresholds found;
    const auto hit = [&](double speed) {
        HitDescription blow = bench.blow(placement, static_cast<float>(speed));
        blow.step_scale = step_scale;
        ++found.runs;
        return blow;
    };
    const auto cracks = [&](double speed) {
        const HitReport report = bench.run(hit(speed), true);
        found.dropped += report.dropped;
        return report.cracked;
    };
    const auto breaks = [&](double speed) {
        const HitReport report = bench.run(hit(speed));
        found.dropped += report.dropped;
        return report.broke;
    };
    found.first_crack = bisect(0.01 * guess, guess, cracks);
    found.first_piece = bisect(found.first_crack / kBisectionRatio, 1.4 * found.first_crack, breaks);
    return found;
}

MedianSpread spread_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    if (n == 0) return {};
    return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

}  // namespace cullet
