// What holds for every break, of any shape and by any blow, in both modes (T10, T11 of the thick shell note).
#include <gtest/gtest.h>

#include "tests/support/break_checks.hpp"
#include "tests/support/expect_always.hpp"
#include "tests/support/random_hits.hpp"

namespace cullet::test {
namespace {

/// Breaks that the checks looked at.
uint32_t expect_sound_breaks(FractureMode mode, uint32_t shapes, int cases) {
    World world = make_world(small_settings());
    uint32_t breaks = 0;
    std::string flaw;
    after_each_system(world, [&](const std::string& system) {
        if (system != "find_parts") return;
        State& state = state_of(world);
        for (uint32_t t = 0; t < state.tasks.size(); ++t) {
            if (static_cast<TaskState>(state.tasks.state[t]) != TaskState::Broke) continue;
            ++breaks;
            if (flaw.empty()) flaw = flaw_of_partition(state, t);
            if (flaw.empty()) flaw = flaw_of_handoff(state, t);
        }
    });
    std::vector<Shape> known;
    for (uint32_t s = 0; s < shapes; ++s) known.push_back(random_shape(200 + s));
    expect_always(cases, [&](uint32_t shape, uint32_t hit) {
        SpawnSettings spawn;
        spawn.fracture = mode;
        spawn.quick.strain_limit = 0.005f;
        flaw.clear();
        hit_once(world, known[shape % shapes], {{11}, hit}, spawn);
        RC_ASSERT(flaw == "");
    });
    std::printf("%u breaks of %d hits\n", breaks, cases);
    return breaks;
}

TEST(BreakProperties, HiddenPartsHoldEachElementOnceAndKeepTheMomenta) {
    EXPECT_GT(expect_sound_breaks(FractureMode::Hidden, 16, 80), 20u);
}

TEST(BreakProperties, QuickPartsHoldEachElementOnceAndKeepTheMomenta) {
    EXPECT_GT(expect_sound_breaks(FractureMode::Quick, 16, 80), 20u);
}

}  // namespace
}  // namespace cullet::test
