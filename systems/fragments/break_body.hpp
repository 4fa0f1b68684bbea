// One body falls apart: its pieces get rows, shells, motions and rigid bodies.
#pragma once
#include "systems/world_data.hpp"

namespace cullet {

/// What making births may touch.
struct Births {
    State& state;
    RigidWorld& rigid;
    const DamageSettings& settings;
    DamageCounts& counts;
    Arena& arena;
    Events<ShellChanged>& changed;
    Events<FragmentBornEvent>& born;
    Events<DebrisEvent>& debris_events;
    Events<RefusedEvent>& refused;
    Step step;
};

/// The task's shell has more than one part (Fragments). The largest keeps the body's handle; the others are planned,
/// reserved and made in order of mass. A piece that finds no room stays with the largest, and is counted with the
/// setting to raise.
void break_body(Births& births, Row<Tasks> task);

/// A shell that stayed whole but has new cracks: the body keeps them.
void keep_cracks(Births& births, Row<Tasks> task);

}  // namespace cullet
