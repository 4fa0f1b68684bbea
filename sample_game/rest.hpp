// How still a world lies, measured on what is drawn and not on what the rigid world believes.
#pragma once
#include <cstdint>
#include <vector>

#include "sample_game/game_world.hpp"
#include "sample_game/report.hpp"

namespace cullet {

/// One moving body at rest. Metres.
struct BodyRest {
    BodyId body;
    bool is_asleep = false;
    // Its shape is one for all of it, up to 15 or 40 % larger than the solid, so that it may hover.
    bool is_box = false, is_hull = false;
    double sink = 0;          // how deep its deepest drawn vertex lies in something that never moves
    double overlap = 0;       // the same in another moving body
    double hover = 0;         // from its drawn mesh to the nearest other thing, at most kMostHover; 0 once below 0.1 mm
    bool is_through = false;  // it fell through what never moves: see has_fallen_through()
};
inline constexpr double kMostHover = 0.05;

/// Closed meshes only: props and bodies. Square in what lies together; a second for 1,000 shards.
std::vector<BodyRest> measure_bodies(const GameWorld& game);
Rest measure_rest(const GameWorld& game, double peak_kinetic_energy);

}  // namespace cullet
