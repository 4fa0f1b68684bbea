// Scripts of a few lines, played until something breaks.
#pragma once
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <string>

#include "sample_game/game_world.hpp"
#include "sample_game/run_scene.hpp"

namespace cullet::test {

[[gnu::format(printf, 1, 2)]] inline std::string format(const char* text, ...) {
    char buffer[8000];
    va_list values;
    va_start(values, text);
    std::vsnprintf(buffer, sizeof buffer, text, values);
    va_end(values);
    return buffer;
}

struct Played {
    uint32_t pieces = 0;  // alive, at the end
    uint32_t frames = 0;  // until the first came off, or all
    double seconds = 0;
    std::string failure;
    uint64_t hash = 0;
};
struct Playing {
    double seconds = 1;
    double rate = 60;  // steps a second
    uint32_t threads = 2;
    bool stops = true;  // as soon as something has broken
};
inline Played play_script(const std::string& text, const Playing& how) {
    RunOptions options;
    options.threads = how.threads;
    options.dt_ms = 1000 / how.rate;
    Result<GameWorld> game = GameWorld::create(plan_scene({"script", "script.lua", text}, options));
    Played played;
    if (!game.ok()) return played.failure = game.error(), played;
    for (; played.frames < how.rate * how.seconds; ++played.frames) {
        game->before_step(), game->step(), game->after_step();
        played.pieces = game->world().fragments(nullptr, 0);
        if (how.stops && played.pieces > 0) break;
    }
    played.seconds = played.frames / how.rate;
    played.failure = game->failure();
    played.hash = game->world().hash();
    return played;
}

}  // namespace cullet::test
