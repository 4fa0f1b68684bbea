// Scenes played for their hashes.
#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sample_game/game_world.hpp"

namespace cullet::test {

/// One step of a scene: the script goes on, the world steps, events are read.
inline void play_frame(GameWorld& game) {
    game.before_step();
    game.step();
    game.after_step();
}

/// After each frame.
inline std::vector<uint64_t> hashes_of(const ScenePlan& plan, uint32_t frames, const Host& host = {}) {
    Result<GameWorld> game = GameWorld::create(plan, host);
    EXPECT_TRUE(game.ok()) << game.error();
    std::vector<uint64_t> hashes;
    for (uint32_t frame = 0; game.ok() && frame < frames; ++frame) {
        play_frame(*game);
        hashes.push_back(game->world().hash());
    }
    return hashes;
}

/// "" or the first frame that differs.
inline std::string difference(const std::vector<uint64_t>& a, const std::vector<uint64_t>& b) {
    if (a.size() != b.size()) return std::to_string(a.size()) + " frames for " + std::to_string(b.size());
    for (size_t f = 0; f < a.size(); ++f)
        if (a[f] != b[f]) return "frame " + std::to_string(f);
    return "";
}

}  // namespace cullet::test
