// How a world is set up. Said once for all headers: SI units, right-handed axes with y up, triangles counter-clockwise
// seen from outside.
#pragma once
#include <cstdint>

#include "cullet/types.hpp"

namespace cullet {

/// Room that a world has. Address space is reserved for it when the world is made; memory comes as it fills. A limit
/// that is reached refuses the later things, counts them and raises an event with its name. Nothing else happens.
struct LimitSettings {
    uint32_t bodies = 4096;             // rigid bodies alive at once, fragments included; 1 to 2^20
    uint32_t models = 256;              // 1 to 2^20
    uint32_t vertices = 1u << 20;       // of models, broken bodies and damage tasks; 4096 to 2^26
    uint32_t elements = 1u << 21;       // triangles of the same; 4096 to 2^26
    uint32_t open_hits = 64;            // damage tasks at once; 1 to 1024
    uint32_t view_vertices = 1u << 23;  // of all drawn meshes; 4096 to 2^28
    uint32_t debris = 8192;             // pieces too small to be bodies; 1 to 2^24
    uint32_t queued_hits = 256;         // hits and blows that wait, on bodies whose hit is still worked off; 1 to 2^16
    // Pieces that find no room by these two stay part of the body, and ask again in the next frame. At the defaults
    // `bodies` alone counts.
    uint32_t fragments = 1u << 20;       // pieces alive that broke off something; 1 to 2^20
    uint32_t births_a_frame = 1u << 20;  // pieces that become bodies in one frame; 1 to 2^20
};

struct Settings {
    Vec3 gravity{0, -9.81f, 0};         // m/s2, at most 10000 a component
    float step_seconds = 1.0f / 60.0f;  // fixed step, s; 1/1000 to 1/20
    uint32_t threads = 1;  // of cullet's own, the caller counted; unused when the host gives jobs; 1 to 256
    /// Damage work and soft bodies a frame, in units of 2 ns of one thread. 8 million are 8 ms of a frame on two cores.
    /// Ductile and elastic bodies that are awake take up to half of it first. A hit that one worker has to do alone
    /// takes at most half. 1000 to 1e15. More units finish a hit in fewer frames. No wall clock decides, so that the
    /// same run gives the same bytes on a fast and on a slow machine.
    uint64_t units_a_frame = 8'000'000;
    /// A fast hit that is still being worked off holds its bodies where they touch, for at most this long, s; 0 to 1.
    /// 0: never. Bodies that break quickly are held too when their hits do not fit units_a_frame.
    float hold_seconds = 0.1f;
    /// The first touch of a body in flight is foreseen up to this many frames before it comes. It is foreseen against
    /// what stands still or is slow. Its hit is worked off until then. A touch that comes as foreseen is applied at
    /// once, without a hold. 0 to 60; 0: never. Not where the host moves the bodies.
    uint32_t frames_ahead = 8;
    /// Fragments break again down to this generation (0: only whole bodies break); 0 to 100. Blows and weights keep to
    /// it. What is squeezed by those that do not yield snaps past it, unless it is 0.
    uint32_t generations = 3;
    /// Pieces lighter than this share of the intact body, or of fewer elements than `break_elements`, do not break
    /// again; 0 to 1. Each break of a smaller piece costs a task and gives debris. Blows and weights keep to it. What
    /// the game moves, as a press, squeezes it apart below it too. Once half of it would be debris, all of it becomes
    /// debris.
    float break_share = 0.05f;
    uint32_t break_elements = 12;  // 0 to 1000000
    /// Pieces lighter than this share of the intact body, or of fewer elements than `debris_elements`, become debris;
    /// 0 to 1.
    float debris_share = 0.0005f;
    uint32_t debris_elements = 6;  // any number; 0 and 1: the share alone decides
    float debris_seconds = 0;      // debris is gone so long after its birth, s; 0 to 1e6, 0: it stays
    LimitSettings limits;
};

}  // namespace cullet
