// What a world sees, as lines for the game's own drawing.
#pragma once
#include <cstdint>

#include "cullet/world.hpp"

namespace cullet {

/// To be joined with |.
enum DebugFlags : uint32_t {
    kDebugBounds = 1,       // box of each body, along the world's axes
    kDebugHulls = 2,        // convex pieces of breakable bodies, rings of spheres, edges of kinematic boxes
    kDebugContacts = 4,     // of the last step, before its solve: 5 cm along the normal
    kDebugCracks = 8,       // cracked edges of breakable bodies, those of a hit that is still worked off included
    kDebugVelocities = 16,  // the way of a tenth of a second, from the centre of mass
    kDebugCentres = 32,     // axes of the body frame at the centre of mass, a quarter of the body's radius long
    kDebugAll = 63
};

/// 0xRRGGBB. What is held stands out from what moves and what sleeps.
enum DebugColour : uint32_t {
    kDebugAwake = 0x40c040,
    kDebugAsleep = 0x808080,
    kDebugStatic = 0x4060a0,
    kDebugHeld = 0xff4000,
    kDebugContact = 0xffff00,
    kDebugCrack = 0xff00c0,
    kDebugVelocity = 0x00c0ff
};

/// Ends in world coordinates, m.
using DebugLine = void (*)(void* user, Vec3 from, Vec3 to, uint32_t colour);

/// Calls line(user, ...) on this thread for each line, bodies in row order. Between steps, like a query. Allocates
/// nothing. Hulls cost about 0.2 ms a piece: for looking, not for playing.
void draw_debug(const World& world, uint32_t flags, DebugLine line, void* user);

}  // namespace cullet
