// Thick shell note, verification case 9, with few placements: `sample_game truth thick_shell` has all of them.
#include "sample_game/thresholds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cullet {
namespace {

struct Medians {
    double first_crack = 0, first_piece = 0;
};

Medians medians_of(HitBench& bench, uint32_t placements, float step_scale, double guess) {
    std::vector<double> cracks, pieces;
    for (uint32_t i = 0; i < placements; ++i) {
        const Thresholds t = find_thresholds(bench, i, step_scale, guess);
        EXPECT_EQ(t.dropped, 0u) << "placement " << i;
        cracks.push_back(t.first_crack), pieces.push_back(t.first_piece);
    }
    return {spread_of(cracks).median, spread_of(pieces).median};
}

// Bounds of the full case are 35 % about medians of 20 and 5 % between the steps; a median of a few placements spreads
// by another sixth or so.
void expect_known_thresholds(Subject subject, uint32_t placements, bool halves_the_step) {
    const Result<HitSubject> known = make_subject(subject);
    ASSERT_TRUE(known.ok()) << known.error();
    HitBench bench(subject, known->model);
    const Medians whole = medians_of(bench, placements, 1, known->known.first_crack);
    EXPECT_NEAR(whole.first_crack / known->known.first_crack, 1, 0.5);
    EXPECT_NEAR(whole.first_piece / known->known.first_piece, 1, 0.5);
    for (uint32_t i = 0; i < placements; ++i) {
        const auto at = [&](double speed) { return bench.blow(i, static_cast<float>(speed)); };
        EXPECT_FALSE(bench.run(at(0.4 * whole.first_crack), true).cracked) << "placement " << i;
        EXPECT_TRUE(bench.run(at(2.5 * whole.first_piece)).broke) << "placement " << i;
    }
    if (!halves_the_step) return;
    const Medians halved = medians_of(bench, placements, 0.5f, whole.first_crack);
    EXPECT_NEAR(halved.first_crack / whole.first_crack, 1, 0.05);
    EXPECT_NEAR(halved.first_piece / whole.first_piece, 1, 0.05);
}

TEST(Thresholds, AVaseCracksAndBreaksAtTheKnownSpeeds) {
    expect_known_thresholds(Subject::Vase, 3, false);
}
TEST(Thresholds, APaneCracksAndBreaksAtTheKnownSpeeds) {
    expect_known_thresholds(Subject::Pane, 5, false);
}
TEST(Thresholds, AWallCracksAndBreaksAtTheKnownSpeedsWhateverTheStep) {
    expect_known_thresholds(Subject::Wall, 9, true);
}

}  // namespace
}  // namespace cullet
