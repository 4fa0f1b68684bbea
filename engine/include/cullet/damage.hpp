// Blows that a game asks for: pushes, explosions, cuts (World::push_impact, explode, cut). They are taken at the start
// of the next step, in the order of the calls. They are worked off as contacts are: in damage tasks, by budget. What a
// blow gives is momentum from outside of the world.
//
// A blow may come while an earlier hit on its body is still worked off. Then it moves the body at once, as a rigid one.
// Its damage waits, and goes to the pieces that the place belongs to.
//
// Settings::units_a_frame bounds the hidden runs. A cut is made whole in one step. A step cuts as many bodies as the
// units are enough for, and at least one; the others wait. Two things are not bounded by units. In the step that takes
// it, an explosion looks at every triangle of each body in its reach. At its end, a run makes the pieces and lets the
// cracks run out, once.
#pragma once
#include <cstdint>

#include "cullet/types.hpp"

namespace cullet {

/// A blow from a striker that is no body of the world: a hammer, a fist, a bullet. A mass approaches the body and
/// pushes it along `normal`.
struct PushSettings {
    Vec3 place;                // world, m; the nearest vertex of the surface is meant
    Vec3 normal{0, -1, 0};     // world, unit: the way the body is pushed
    float approach_speed = 5;  // m/s, of the striker relative to the body there; above 0, at most 100000
    float mass = 0.5f;         // kg, effective along the normal: 1 / (1/m + (r x n).I^-1 (r x n)); 1e-6 to 1e9
    float radius = 0;          // m, of a ball, at most 10000; 0: flat
};

/// Impulse by distance and facing. A piece of surface dA has the unit normal n and lies at the distance d from the
/// centre. The unit vector e points from it to the centre. It gets the impulse
///
///     dJ = -s (1 - d/R)^2 (n . e) n dA        for d < R, nothing beyond,
///
/// where s = impulse + pressure * seconds at the centre. The impulse acts along the normal, and goes by the cosine of
/// the angle under which the piece sees the centre. Of a shell's wall, the side that sees the centre counts. The walls
/// of a breakable body shade what stands behind them in the same body; other bodies shade nothing.
///
/// Balls and unbreakable bodies get the sum as an impulse. Brittle bodies get each part of it where it acts, when their
/// run begins. Ductile and elastic bodies get it at their vertices at once. Static and kinematic bodies do not move.
/// Refused unless impulse + pressure * seconds is above 0, at most 1e9.
struct ExplosionSettings {
    Vec3 centre;         // world, m
    float radius = 2;    // R, m; 0.001 to 100000
    float impulse = 0;   // N s/m2, at the centre, 0 to 1e9; 100 breaks windows
    float pressure = 0;  // Pa, at the centre, 0 to 1e12, for
    float seconds = 0;   // so long, s; 0 to 10
};

/// Without `points` the cut runs along a plane through `place`. With `points` it runs along the strip that a polyline
/// sweeps when it moves along `direction`, both ways without end. A line whose last point is its first is closed: it
/// cuts a shape out. An open line ends the cut at its ends. What is not cut through there is a crack, from which the
/// next hit goes on.
///
/// The wall comes apart exactly along the surface. Where that would make slivers, it comes apart along edges, if they
/// are off by less than a twentieth of the smaller part's reach. Walls are not split into thinner ones. Nothing moves
/// by it: pieces go on with the motion of the body. The cut waits while the world has no room for the cut body;
/// RefusedEvent says which limit.
struct CutSettings {
    Vec3 place;                    // world, m
    Vec3 normal{0, 1, 0};          // world, unit, of the plane
    const Vec3* points = nullptr;  // world, m; 2 to 32
    uint32_t point_count = 0;
    Vec3 direction{0, 0, 1};  // world, unit, of the sweep
};

}  // namespace cullet
