// A thousand random breaks in both modes, in free flight: how far the pieces hinder or throw each other and are seen in
// each other, how fast they leave, and that they are drawn as the body was.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/support/effort.hpp"
#include "tests/support/sibling_watch.hpp"

namespace cullet::test {
namespace {

constexpr uint32_t kShapes = 24, kMostHits = 3000, kLookedInside = 60;

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto at = static_cast<size_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

SiblingFigures figures_of(FractureMode mode, uint32_t breaks) {
    Settings settings = small_settings();
    settings.generations = 0;  // a piece that breaks has other siblings
    settings.debris_share = 0;
    settings.debris_elements = 0;
    World world = make_world(settings);
    SiblingWatch watch(world);
    after_each_system(world, [&](const std::string& system) { watch.look(system); });
    constexpr std::array kinds{FractureKind::Fine, FractureKind::Coarse, FractureKind::Large};
    std::vector<Shape> shapes;
    for (uint32_t s = 0; s < kShapes; ++s)
        shapes.push_back(mode == FractureMode::Quick ? random_shape(s, kinds[s / 4 % kinds.size()]) : random_shape(s));
    uint32_t hits = 0;
    for (; hits < kMostHits && watch.figures().breaks < breaks; ++hits) {
        SpawnSettings spawn;
        spawn.thick_shell.fracture = mode;
        if (mode == FractureMode::Quick) spawn.thick_shell.quick.layers = 1 + hits / kShapes % 2;
        watch.follow(shapes[hits % kShapes], {{9}, hits}, spawn, watch.figures().breaks < kLookedInside);
    }
    const SiblingFigures& f = watch.figures();
    std::printf(
        "%u breaks in %u hits, %u pieces, %u pairs; energy lost in 3 steps (%zu breaks): median %.3f %%, p90 %.2f %%; "
        "speed gained (%zu): "
        "p99 %.3f, most %.3f m/s (alone %zu: p99 %.3f, most %.3f), thrown (%zu): p99 %.3f, most %.3f, by the other "
        "(%zu): p99 %.3f, most %.3f; %u of %u pairs "
        "seen in each other, by %.1f mm; "
        "fastest %.4f, rim %.4f impact speeds; "
        "clamped %u; %u other surfaces; momentum kept to %.1e, angular to %.1e (median), %.1e (99 %%)\n",
        f.breaks, hits, f.pieces, f.pairs, f.lost.size(), 100 * quantile(f.lost, 0.5), 100 * quantile(f.lost, 0.9),
        f.gained.size(), quantile(f.gained, 0.99), quantile(f.gained, 1), f.gained_alone.size(),
        quantile(f.gained_alone, 0.99), quantile(f.gained_alone, 1), f.thrown.size(), quantile(f.thrown, 0.99),
        quantile(f.thrown, 1), f.by_the_other.size(), quantile(f.by_the_other, 0.99), quantile(f.by_the_other, 1),
        f.seen_in, f.looked_at, 1000 * f.deepest, f.fastest, f.fastest_rim,
        static_cast<uint32_t>(world.contents().data.counts.clamped), f.other_surfaces, f.momentum_error,
        quantile(f.turning_errors, 0.5), quantile(f.turning_errors, 0.99));
    return f;
}

/// What is wanted, of what siblings do to each other: median energy lost, m/s that 99 of 100 pairs and all of them are
/// thrown.
constexpr double kLost = 0.01, kThrown = 0.2, kMostThrown = 1;

/// What today's world keeps to where everything counts that happens to a pair in the next half second: a third piece
/// that flies at one of the two, and is stopped by it, changes their speed beside each other.
struct Bounds {
    double gained_by_99_per_cent, most_gained;  // m/s
    // Wanted: kMostThrown. One piece of a wall of 4 mm turns and comes upon its neighbour 7 mm from where they were
    // one.
    double most_thrown;  // m/s
};

void expect_sound(const SiblingFigures& f, uint32_t breaks, const Bounds& today) {
    EXPECT_GE(f.breaks, breaks);
    EXPECT_EQ(f.other_surfaces, 0u);
    EXPECT_LT(10 * f.seen_in, f.looked_at);  // by half a millimetre, in any of 30 frames
    EXPECT_LE(quantile(f.lost, 0.5), kLost);
    EXPECT_GT(f.thrown.size(), 6 * breaks);
    EXPECT_LE(quantile(f.thrown, 0.99), kThrown);
    EXPECT_LE(quantile(f.thrown, 1), today.most_thrown);
    EXPECT_GT(f.by_the_other.size(), 3 * breaks / 2);
    EXPECT_LE(quantile(f.by_the_other, 0.99), kThrown);
    EXPECT_LE(quantile(f.by_the_other, 1), kMostThrown);
    EXPECT_LE(quantile(f.gained, 0.99), today.gained_by_99_per_cent);
    EXPECT_LE(quantile(f.gained, 1), today.most_gained);
    constexpr double kMost = 2 + 1e-4;  // impact speeds, and what floats round
    EXPECT_LE(f.fastest, kMost);
    EXPECT_LE(f.fastest_rim, kMost);
    EXPECT_LE(f.momentum_error, 1e-6);
}

const uint32_t kQuickBreaks = few_or_all(160u, 500u);

TEST(Siblings, OfHiddenBreaksAreDrawnAsTheBodyWasAndDoNotThrowEachOther) {
    expect_sound(figures_of(FractureMode::Hidden, 500), 500, {0.85, 8, 2.1});
}

TEST(Siblings, OfQuickBreaksAreDrawnAsTheBodyWasAndDoNotThrowEachOther) {
    expect_sound(figures_of(FractureMode::Quick, kQuickBreaks), kQuickBreaks, {0.35, 5, kMostThrown});
}

}  // namespace
}  // namespace cullet::test
