// The rigid bodies behind a world are Bullet's (World::create) or a host's own (World::create_hosted). A host talks
// with the world in the plain rows below. It links cullet::core, in which there is no Bullet. A host's step:
//
// 1. Find the contacts of this step, at the poses that bodies have now, before gravity is added to velocities.
// 2. Call world.step({bodies, contacts}).
// 3. Apply world.host_changes(), in the order of its lists.
// 4. Add gravity, solve the contacts that are left, move what is not held.
//
// Who owns what: the host owns poses, velocities, sleep and contacts; the world owns what breakable bodies are made of.
// Rows that go in are read during the call; what comes out is the world's own memory. The host's floors, balls and
// lifts are bodies that the world cannot make up. The host declares them by add_static, add_sphere and
// add_kinematic_box, so that contacts can name them by a BodyId. The host has them already, so they do not come back as
// births.
//
// What a minimal host may leave out: cells, sleep, margins, friction, `woken`, and `apart` after its first step. The
// world itself passes over contacts between pairs that are apart. What it may not: held bodies must stand still.
// Contacts named in `apart` must not be solved in this step, or a blow is passed twice.
#pragma once
#include <cstdint>

#include "cullet/events.hpp"
#include "cullet/types.hpp"

namespace cullet {

struct RigidReport {
    uint32_t pairs = 0, contacts = 0;  // of the last step
    uint32_t sweeps = 0;               // fast bodies placed at their time of impact, since the world was made
};

// ---- into the world

/// One body as the host's last solve left it. A body that is not named stays as it was.
struct HostBody {
    BodyId body;
    Pose pose;      // of the body frame (the frame of the mesh that was cooked), not of the centre of mass
    Motion motion;  // velocity of the centre of mass
    bool is_asleep = false;
};

/// One point where two bodies touch, or will within this step. Blows are told by how fast it closes, which the world
/// computes from the motions of both. A contact must come in at the latest in the step in which the bodies meet, and it
/// must not have been solved before. Then a thing is seen to break before it bounces.
struct HostContact {
    BodyId a, b;
    Vec3 point;                         // world, m
    Vec3 normal;                        // world, unit, from b towards a
    float distance = 0;                 // m, negative when they overlap
    uint32_t piece_a = 0, piece_b = 0;  // HostPiece::name, or 0: only the order of contacts hangs on it
    // N s along the normal that the host's last solve passed here, as its warm start knows it. Weights and presses
    // break what they lie on by it. At 0, only what is seen to be driven against something that does not yield breaks.
    float impulse = 0;
};

/// All that the host tells in a step. It is refused as a whole when a place is beyond 1,000 km of the origin, or
/// something is faster than 100 km/s (100,000 rad/s). Contacts of sleeping or held pairs may be in it. They are passed
/// over, and so are rows of bodies that are gone.
struct HostFrame {
    const HostBody* bodies = nullptr;
    uint32_t body_count = 0;
    const HostContact* contacts = nullptr;
    uint32_t contact_count = 0;
};

// ---- out of the world

/// A convex piece of a body: its corners, body frame, pulled in by HostShape::margin.
struct HostPiece {
    const Vec3* points = nullptr;
    uint32_t point_count = 0;  // at most 32
    uint32_t name = 0;         // other pieces of the body have others
};

/// What a host needs to make a body that the world came up with, or to make it anew.
struct HostShape {
    BodyId body;
    bool is_static = false;  // pinned: it never moves
    Pose pose;               // of the body frame
    Motion motion;
    double mass = 1;         // kg
    double centre[3] = {};   // of mass, body frame, m
    double inertia[6] = {};  // about the centre, body axes: xx yy zz xy xz yz, kg m2
    float margin = 0;        // m
    float friction = 0, restitution = 0;
    float rolling_friction = 0;  // a length, m: of both that touch together
    uint32_t layer = 1, mask = 0xffffffffu;
    const HostPiece* pieces = nullptr;
    uint32_t piece_count = 0;
};

struct HostMotion {
    BodyId body;
    Pose pose;
    Motion motion;
};

/// Contacts between these two are not to be solved in this step, nor for so many seconds after it. With `until_apart`
/// the time ends before, once their pieces overlap by no more than 0.1 mm. There are two reasons: siblings are born in
/// touch, and what a breaking body passed to its striker has been passed.
struct HostPair {
    BodyId a, b;
    float seconds = 0;
    bool until_apart = false;
};

/// What the host is to do before it solves this step, list by list. It is all that the game asked of the world since
/// the step before, and all that came of the step. Read it once after each step. The memory is good until the next call
/// that changes the world.
struct HostChanges {
    EventSpan<BodyId> removed;
    EventSpan<HostShape> born;      // spawned by the game, or broken off
    EventSpan<HostShape> reshaped;  // pieces came off: new mass, centre, inertia, pieces and motion, the pose stays
    EventSpan<BodyId> held;         // stand still, with infinite mass for everybody, until they are released
    EventSpan<HostMotion> released;
    EventSpan<HostMotion> moved;  // new velocities (impulses of what broke), or put elsewhere by the game
    EventSpan<BodyId> woken;
    EventSpan<HostPair> apart;
};

}  // namespace cullet
