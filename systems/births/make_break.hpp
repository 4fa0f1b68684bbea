// The pieces of a broken body, whose rows are filled, become bodies of the rigid world.
#pragma once
#include "systems/models.hpp"
#include "systems/structure_calls.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// What making births may touch.
struct Births {
    WorldRows& state;
    Fragments& fragments;
    const Touches& touches;
    Blows& blows;
    Debris& debris;
    DebrisAges& debris_ages;
    RigidWorld& rigid;
    const DamageModels& models;
    DamageCounts& counts;
    Arena& arena;
    Events<DrawnChanged>& changed;
    Events<FragmentBornEvent>& born;
    Events<DebrisEvent>& debris_events;
    Step step;

    /// Of what a body is made of.
    const StructureCalls& calls(Row<Structures> structure) const { return calls_of(state.structures, structure); }
};

/// Motions, rigid bodies, debris and events of all pieces, in order of mass; strikers get what they really passed.
void make_break(Births& births, const Break& plan);

}  // namespace cullet
