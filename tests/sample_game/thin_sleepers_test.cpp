// What lies on the floor by its own weight alone falls asleep, and is not woken by it.
#include <gtest/gtest.h>

#include "tests/support/play_script.hpp"

namespace cullet::test {
namespace {

// The weight of a thin pane is a good share of what it bears: each time that it fell asleep its load woke it again.
// Once is enough.
TEST(ThinSleepers, PanesOfAThirdOfAMillimetreAndMoreSleepThreeAndAHalfSecondsAfterTheyWereLaid) {
    for (const double rate : {30.0, 60.0, 120.0})
        for (const double thickness : {0.0003, 0.0006, 0.001, 0.003}) {
            const std::string text = format(R"(
                game.scene{shows = 'panes', seconds = 5} game.floor()
                for k = 0, 3 do
                    game.spawn{mesh = game.mesh.pane{side = 0.2 + 0.05 * k, edge = 0.05}, material = 'glass', thickness = %g,
                               at = {-0.9 + 0.6 * k, 0.02, 0}, turn = {axis = {1, 0.1 * k, 0}, angle = -math.pi / 2 + 0.02 * k}}
                end
                wait(3.5)
                game.expect(game.asleep_share() == 1, string.format('%%.2f are asleep', game.asleep_share())))",
                                            thickness);
            EXPECT_EQ(play_script(text, {4, rate, 1, false}).failure, "")
                << 1000 * thickness << " mm, " << rate << " steps a second";
        }
}

}  // namespace
}  // namespace cullet::test
