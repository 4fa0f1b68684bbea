#include "sample_game/thresholds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/fp_mode.hpp"

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

/// The crossing nearest to `known`: looks a hundredth and a half beside it, then 3 % farther at a time to both sides,
/// to a third and to three times.
template <class Does>
double follow(double known, Does does) {
    constexpr int kMostPlaces = 40;
    constexpr double kPlace = 1.03;
    if (!(known < kMostThreshold)) return known;
    double low = known / std::sqrt(kPlace), high = low * kPlace;
    bool low_does = does(low), high_does = does(high), is_found = !low_does && high_does;
    double below = low, above = high;  // how far it has looked
    for (int place = 1; !is_found && place < kMostPlaces; ++place) {
        const bool below_does = does(below / kPlace);
        is_found = !below_does && low_does;
        below /= kPlace, low_does = below_does;
        if (is_found) {
            low = below, high = below * kPlace;
            break;
        }
        const bool above_does = does(above * kPlace);
        is_found = above_does && !high_does;
        if (is_found) low = above, high = above * kPlace;
        above *= kPlace, high_does = above_does;
    }
    if (!is_found) return bisect(0.01 * known, known, does);
    while (high > kBisectionRatio * low) {
        const double middle = std::sqrt(low * high);
        (does(middle) ? high : low) = middle;
    }
    return std::sqrt(low * high);
}

/// Counts what it runs.
struct BlowSpeeds {
    HitBench& bench;
    uint32_t placement;
    float step_scale;
    Thresholds& found;

    HitReport run(double speed, bool until_crack) const {
        HitDescription blow = bench.blow(placement, static_cast<float>(speed));
        blow.step_scale = step_scale;
        const HitReport report = bench.run(blow, until_crack);
        ++found.runs;
        found.dropped += report.dropped;
        return report;
    }
    auto crack() const {
        return [this](double speed) { return run(speed, true).cracked; };
    }
    auto break_off() const {
        return [this](double speed) { return run(speed, false).broke; };
    }
};

}  // namespace

Thresholds find_thresholds(HitBench& bench, uint32_t placement, double guess) {
    Thresholds found;
    const BlowSpeeds blows{bench, placement, 1, found};
    found.first_crack = bisect(0.01 * guess, guess, blows.crack());
    found.first_piece = bisect(found.first_crack / kBisectionRatio, 1.4 * found.first_crack, blows.break_off());
    return found;
}

Thresholds follow_thresholds(HitBench& bench, uint32_t placement, float step_scale, const Thresholds& known) {
    Thresholds found;
    const BlowSpeeds blows{bench, placement, step_scale, found};
    found.first_crack = follow(known.first_crack, blows.crack());
    found.first_piece = follow(known.first_piece, blows.break_off());
    return found;
}

namespace {

double piece_threshold(HitBench& bench, uint32_t placement, double guess) {
    Thresholds found;
    return bisect(0.01 * guess, guess, BlowSpeeds{bench, placement, 1, found}.break_off());
}

/// Vertices of the bench's shell that are crack tips.
std::vector<uint32_t> tips_of(HitBench& bench, Row<Structures> row) {
    const ShellView shell(bench.state(), row);
    std::vector<uint32_t> tips;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        if (shell.state.vertices.crack[shell.vertex(v)] == static_cast<uint8_t>(CrackState::Tip)) tips.push_back(v);
    return tips;
}

/// Of these tips those that are tips no more after the blow, because their crack went on. Vertices keep their numbers.
uint32_t gone_on(HitBench& bench, const HitDescription& hit, const std::vector<uint32_t>& tips) {
    const FpMode mode;
    (void)run_hit(bench.state(), bench.shell(), hit);
    const ShellView shell(bench.state(), bench.state().tasks.working[Row<Tasks>(0)]);
    uint32_t count = 0;
    for (const uint32_t v : tips)
        count += shell.state.vertices.crack[shell.vertex(v)] != static_cast<uint8_t>(CrackState::Tip);
    close_hit(bench.state());
    return count;
}

}  // namespace

SecondHit find_second_hit(HitBench& bench, uint32_t placement, uint32_t other_placement, double guess) {
    SecondHit found;
    bench.renew();
    const auto blow = [&](double speed) { return bench.blow(placement, static_cast<float>(speed)); };
    const Thresholds first = find_thresholds(bench, placement, guess);
    found.first_piece = first.first_piece;
    found.elsewhere_alone = piece_threshold(bench, other_placement, guess);
    if (!(first.first_crack < kMostThreshold)) return found;
    // Whether the body stays whole is not monotone in the speed: the highest of a scan from the first crack on.
    constexpr double kStep = 1.04, kReach = 2.5;
    for (double speed = first.first_crack * kBisectionRatio; speed < kReach * first.first_crack; speed *= kStep) {
        const HitReport report = bench.run(blow(speed));
        if (!report.broke && report.cracked) found.whole_speed = speed;
    }
    if (!(found.whole_speed > 0)) return found;
    found.cut_edges = bench.run_and_keep_cracks(blow(found.whole_speed)).cuts;
    const std::vector<uint32_t> tips = tips_of(bench, bench.shell());
    found.tips = static_cast<uint32_t>(tips.size());
    found.same_place = piece_threshold(bench, placement, 0.5 * found.whole_speed);
    found.elsewhere = piece_threshold(bench, other_placement, 0.5 * found.whole_speed);
    if (found.same_place < kMostThreshold)
        found.tips_gone_on = gone_on(bench, blow(found.same_place * kBisectionRatio), tips);
    bench.renew();
    return found;
}

MedianSpread spread_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    if (n == 0) return {};
    return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

}  // namespace cullet
