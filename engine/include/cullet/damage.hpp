// Blows that a game asks for: pushes, explosions, cuts (World::push_impact, explode, cut). They are taken at the start
// of the next step, in the order of the calls, and worked off as contacts are: in damage tasks, by budget. A blow on a
// body whose hit is still worked off moves the body at once as a rigid one, waits, and then goes to the pieces that the
// place belongs to. What a blow gives is momentum from outside of the world.
//
// Settings::units_a_frame bounds the hidden runs. A cut is made whole in one step, on as many bodies a step as the
// units are enough for and at least on one; the others wait. No units bound what an explosion looks at in the step that
// takes it (every triangle of each body in its reach), nor what the end of a run does once: pieces, and cracks that run
// out.
#pragma once
#include <cstdint>

#include "cullet/types.hpp"

namespace cullet {

/// What a striker would do that is no body: a hammer, a fist, a bullet. The body is pushed along `normal` by a mass
/// that approaches it.
struct PushSettings {
    Vec3 place;                // world, m; the nearest vertex of the surface is meant
    Vec3 normal{0, -1, 0};     // world, unit: the way the body is pushed
    float approach_speed = 5;  // m/s, of the striker relative to the body there; above 0, at most 100000
    float mass = 0.5f;         // kg, effective along the normal: 1 / (1/m + (r x n).I^-1 (r x n)); 1e-6 to 1e9
    float radius = 0;          // m, of a ball, at most 10000; 0: flat
};

/// Impulse by distance and facing: a piece of surface dA whose unit normal is n, at distance d from the centre, in the
/// direction e of it, gets the impulse
///
///     dJ = -s (1 - d/R)^2 (n . e) n dA        for d < R, nothing beyond,
///
/// s = impulse + pressure * seconds at the centre: along the normal, by the cosine of the angle under which it sees the
/// centre; of a shell that side of the wall counts which does. The walls of a breakable body shade what stands behind
/// them in the same body; other bodies shade nothing. Balls and unbreakable bodies get the sum as an impulse, brittle
/// ones get each piece of it where it is, when their run begins, ductile and elastic ones at their vertices at once;
/// static and kinematic bodies do not move. Refused unless impulse + pressure * seconds is above 0, at most 1e9.
struct ExplosionSettings {
    Vec3 centre;         // world, m
    float radius = 2;    // R, m; 0.001 to 100000
    float impulse = 0;   // N s/m2, at the centre, 0 to 1e9; 100 breaks windows
    float pressure = 0;  // Pa, at the centre, 0 to 1e12, for
    float seconds = 0;   // so long, s; 0 to 10
};

/// Along a plane through `place`, or, with `points`, along the strip that a polyline sweeps when it moves along
/// `direction` both ways without end. The first point again as the last closes the line: it cuts a shape out. An open
/// line ends the cut at its ends: what is not cut through is a crack there, from which the next hit goes on.
///
/// The wall comes apart exactly along the surface, or along edges where splitting makes slivers and is off by less than
/// a twentieth of the smaller part's reach; walls are not split into thinner ones. Nothing moves by it: pieces go on
/// with the motion of the body. Without room for the cut body in the world (RefusedEvent says which limit) it waits.
struct CutSettings {
    Vec3 place;                    // world, m
    Vec3 normal{0, 1, 0};          // world, unit, of the plane
    const Vec3* points = nullptr;  // world, m; 2 to 32
    uint32_t point_count = 0;
    Vec3 direction{0, 0, 1};  // world, unit, of the sweep
};

}  // namespace cullet
