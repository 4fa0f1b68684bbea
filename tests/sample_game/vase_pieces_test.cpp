// What the scene `vase` ends in. CULLET_VASE_SEEDS=10 plays the ten seeds that the figure is for (a minute in Checked);
// three are played if it is not set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr uint32_t kFrames = 400;      // most pieces lie by then
constexpr double kLeastShare = 0.005;  // of the mass, of a piece that counts

struct Ending {
    uint32_t pieces = 0;
    double largest = 0;  // share of the mass
};

Ending play_vase(uint32_t seed) {
    RunOptions options;
    options.scene = "vase";
    options.threads = 2;
    options.set = {"scene.seed=" + std::to_string(seed)};
    const ScenePlan plan = plan_scene(*find_scene("vase"), options);
    GameWorld game = std::move(GameWorld::create(plan)).value();
    for (uint32_t frame = 0; frame < kFrames; ++frame) game.before_step(), game.step(), game.after_step();
    const Bodies& bodies = game.world().contents().data.state.bodies;
    Ending ending;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (bodies.kind[b] != static_cast<uint8_t>(BodyKind::Dynamic) || !bodies.structure[b].exists()) continue;
        const double share = bodies.mass[b] / game.mass_put_in();
        ending.pieces += share > kLeastShare;
        ending.largest = std::max(ending.largest, share);
    }
    EXPECT_EQ(game.sums().events["fault"], 0u);
    return ending;
}

TEST(VasePieces, InEightOfTenSeedsItEndsInEightToFortyPiecesTheLargestBelowSevenTenths) {
    const char* wanted = std::getenv("CULLET_VASE_SEEDS");
    const uint32_t seeds = wanted ? static_cast<uint32_t>(std::max(1, std::atoi(wanted))) : 3;
    uint32_t good = 0;
    std::string endings;
    for (uint32_t seed = 1; seed <= seeds; ++seed) {
        const Ending e = play_vase(seed);
        good += e.pieces >= 8 && e.pieces <= 40 && e.largest < 0.7;
        endings += "seed " + std::to_string(seed) + ": " + std::to_string(e.pieces) + " pieces, largest " +
                   std::to_string(e.largest) + "\n";
    }
    EXPECT_GE(10 * good, 8 * seeds - 8 * seeds % 10) << endings;  // of three: two
    std::printf("%s", endings.c_str());
}

}  // namespace
}  // namespace cullet
