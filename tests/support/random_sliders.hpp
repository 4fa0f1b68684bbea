// What slides over floors, in tests of edges: boxes, balls, panes, shards.
#pragma once
#include <vector>

#include "engine/rigid_world.hpp"
#include "tests/support/random_floors.hpp"

namespace cullet {

struct Slider {
    const char* name = "";
    std::vector<std::vector<Vec3>> pieces;
    float margin = 0.001f, radius = 0;
    double mass = 1;
    Vec3d centre;
    Sym3d inertia;
    float lift = 0;  // m, of its frame when it lies on the floor
    float turn = 0, speed = 0, side = 0;
};

/// Any of them, at 0.5 to 30 m/s.
Slider random_slider(Chance& chance);

/// Along the hill at x = 0, half a millimetre above the highest place below it.
Pose laid_on(const Height& height, const Slider& slider);
/// The same at (x, side) of a flat floor, however high the hill is there.
Pose laid_level(const Height& height, const Slider& slider, float x = 0);

/// Bodies from 0 on, one a part.
void add_floor(RigidWorld& world, const Floor& floor);
void add_slider(RigidWorld& world, RigidId id, const Slider& slider, const Pose& pose, Vec3 velocity);

}  // namespace cullet
