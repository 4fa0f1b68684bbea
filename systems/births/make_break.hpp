// The pieces of a broken body, whose rows are filled, become bodies of the rigid world.
#pragma once
#include "systems/world_data.hpp"

namespace cullet {

/// What making births may touch.
struct Births {
    SoftRows& state;
    Blows& blows;
    Debris& debris;
    DebrisAges& debris_ages;
    RigidWorld& rigid;
    const DamageModels& models;
    DamageCounts& counts;
    Arena& arena;
    Events<ShellChanged>& changed;
    Events<FragmentBornEvent>& born;
    Events<DebrisEvent>& debris_events;
    Step step;
};

/// Motions, rigid bodies, crumbs and events of all pieces, in order of mass; strikers get what they really passed.
void make_break(Births& births, const Break& plan);

}  // namespace cullet
