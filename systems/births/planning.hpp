// What planning births may touch, and what is left of what the frame and the world have room for.
#pragma once
#include "systems/models.hpp"
#include "systems/structure_calls.hpp"
#include "systems/world_data.hpp"

namespace cullet {

struct Planning {
    WorldRows& state;
    Fragments& fragments;
    Touches& touches;
    QueuedHits& queued;
    Blows& blows;
    const DamageSettings& settings;
    const DamageModels& models;
    DamageCounts& counts;
    Arena& arena;
    Events<Break>& breaks;
    Events<Birth>& births;
    Events<DrawnChanged>& changed;
    Events<RefusedEvent>& refused;
    uint32_t debris_left;  // that the world has room for, less those of the breaks planned so far
    uint32_t fragments_left = kNone, births_left = kNone;  // the same of limits.fragments and limits.births_a_frame

    /// Of what a body is made of.
    const StructureCalls& calls(Row<Structures> structure) const { return calls_of(state.structures, structure); }
    const StructureCalls& calls(const Break& plan) const { return calls(plan.broken); }
};

/// The limit that refuses one more piece, or null.
inline const char* full_of_births(const Planning& planning) {
    if (planning.fragments_left == 0) return "limits.fragments";
    return planning.births_left == 0 ? "limits.births_a_frame" : nullptr;
}

inline void count_births(Planning& planning, uint32_t born, uint32_t given_back) {
    planning.fragments_left += given_back - born;
    planning.births_left += given_back - born;
}

}  // namespace cullet
