// What happened in the last step. Spans stay good until the next step; the order is the same on any number of threads.
#pragma once
#include <cstdint>

#include "cullet/types.hpp"

namespace cullet {

/// A body of a world. Zero is null; a stale handle is refused, never followed.
struct BodyId {
    uint32_t index = 0, generation = 0;
    explicit operator bool() const { return generation != 0; }
    friend bool operator==(const BodyId&, const BodyId&) = default;
};

/// A breakable body was hit hard enough for damage to be looked at.
struct ImpactEvent {
    BodyId body, striker;
    uint64_t body_user_data = 0, striker_user_data = 0;
    Vec3 place;                // world, m
    Vec3 normal;               // world, unit, the way the body is pushed
    float approach_speed = 0;  // m/s
    double energy = 0;         // J, of the approach
    bool is_held = false;      // body and striker stand still until the damage is decided
    // N. Above 0, this is no blow but a weight or a press that squeezes the body for longer than it bears. The speed
    // and the energy are those of the blow that is run in its place. They are 0 where the body snaps at once or is
    // ground.
    float load = 0;
};

struct CrackStartedEvent {
    BodyId body;
    uint64_t body_user_data = 0;
    Vec3 place;  // world, m
};

struct FragmentBornEvent {
    BodyId fragment, parent;  // the largest piece keeps the parent's handle and is not born
    uint64_t body_user_data = 0;
    Vec3 place;  // world, centre of mass, m
    Motion motion;
    double mass = 0;  // kg
    uint32_t generation = 1;
};

/// A piece too small to be a body became a particle.
struct DebrisEvent {
    BodyId parent;  // of a piece that was ground between what does not yield: itself, which is gone
    uint64_t body_user_data = 0;
    Vec3 place, velocity;  // world
    double mass = 0;       // kg
};

/// A limit was reached. What was asked for did not happen; everything else did.
struct RefusedEvent {
    BodyId body;
    uint64_t body_user_data = 0;
    Vec3 place;  // world, its centre of mass, m
    /// The name in Settings to raise, for example "limits.bodies". Or "longest_edge" of CookSettings, to be shortened.
    /// Then cracks have filled the room that the body's mesh gives them, and no more of it splits in this hit. Or,
    /// where a cut of all bodies went through one that cannot be cut, why not and which one can.
    const char* setting = "";
};

/// Something went wrong with one body. It was frozen as it was, and is reported once.
struct FaultEvent {
    BodyId body;
    uint64_t body_user_data = 0;
    Vec3 place;               // world, its centre of mass, m
    const char* reason = "";  // a sentence
};

struct AsleepEvent {
    BodyId body;
    uint64_t body_user_data = 0;
    Vec3 place;  // world, its centre of mass, m
};

/// Two that yield to nothing leave a body less room than it takes, and it can give way no further. No game of forces
/// has an answer to that. It is held between them, in both of them alike, and goes free where it is once they leave it
/// its room. Told once each time.
struct SqueezedEvent {
    BodyId body, by;  // by: the one of the two that moves
    uint64_t body_user_data = 0, by_user_data = 0;
    Vec3 place;  // world, its centre of mass, m
};

template <class E>
struct EventSpan {
    const E* data = nullptr;
    uint32_t count = 0;
    const E* begin() const { return data; }
    const E* end() const { return data + count; }
    const E& operator[](uint32_t i) const { return data[i]; }
};

struct StepEvents {
    EventSpan<ImpactEvent> impacts;
    EventSpan<CrackStartedEvent> cracks_started;
    EventSpan<FragmentBornEvent> fragments_born;
    EventSpan<DebrisEvent> debris;
    EventSpan<RefusedEvent> refused;
    EventSpan<FaultEvent> faults;
    EventSpan<AsleepEvent> asleep;
    EventSpan<SqueezedEvent> squeezed;
};

}  // namespace cullet
