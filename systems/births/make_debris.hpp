// What is too small to be a body goes on as a particle.
#pragma once
#include "systems/world_data.hpp"

namespace cullet {

struct NewDebris {
    Row<Bodies> parent;    // that it came off, or that it was
    Vec3 place, velocity;  // world
    double mass, volume;   // kg, m3
};
/// Its row, and the game is told; kNone: `limits.debris` has no room.
uint32_t make_debris(DebrisTables tables, const Bodies& bodies, const RigidWorld& rigid, const NewDebris& piece,
                     uint64_t frame, Events<DebrisEvent>& told);

}  // namespace cullet
