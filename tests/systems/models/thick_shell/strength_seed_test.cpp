// Two bodies of one model that are hit alike break alike with the same seed, and otherwise with another.
#include <gtest/gtest.h>

#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

/// Masses of what a vase with this seed is broken into, hit as all others are.
std::vector<double> pieces_of(uint64_t seed, bool is_pinned = false) {
    Settings settings = small_settings();
    settings.units_a_frame = 100'000'000;
    World world = make_world(settings);
    const ModelId model = world.add_model(small_vase()).value();
    SpawnSettings vase;
    vase.strength_seed = seed;
    const Box foot{{-1, -1, -1}, {1, 0.01f, 1}};
    vase.pins = &foot, vase.pin_count = is_pinned ? 1 : 0;
    (void)world.spawn(model, vase).value();
    (void)world.add_sphere(ball_at({0.01f, 0.13f, 0}, 0.3f, 8)).value();
    EXPECT_GT(step_until_born(world, 60), 0u);
    std::vector<double> masses;
    for (const BodyId id : shells_of(world)) masses.push_back(world.mass(id).value());
    return masses;
}

TEST(StrengthSeed, SaysHowAnIntactBodyBreaks) {
    const std::vector<double> plain = pieces_of(0);
    EXPECT_EQ(plain, pieces_of(0));
    std::vector<std::vector<double>> others;
    for (const uint64_t seed : {1, 2, 3}) {
        others.push_back(pieces_of(seed));
        EXPECT_EQ(others.back(), pieces_of(seed)) << seed;
    }
    EXPECT_NE(others[0], others[1]);
    EXPECT_NE(others[1], others[2]);
    EXPECT_NE(others[0], others[2]);
}

TEST(StrengthSeed, SaysHowABodyBreaksThatHasItsOwnShell) {
    EXPECT_EQ(pieces_of(7, true), pieces_of(7, true));
    EXPECT_NE(pieces_of(7, true), pieces_of(8, true));
}

TEST(StrengthSeed, TheModelsOwnSeedGivesWhatNoneGives) {
    // small_vase is cooked with the default seed.
    EXPECT_EQ(pieces_of(CookSettings{}.seed), pieces_of(0));
}

}  // namespace
}  // namespace cullet::test
