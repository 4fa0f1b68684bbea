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

/// The task's shell has more than one part (Fragments). The largest keeps the body's handle and its rows in that shell,
/// which becomes the body's own; the others are planned, reserved and made in order of mass, and their old rows are
/// dead. A piece that finds no room stays with the largest and is counted with the setting to raise.
void break_body(Births& births, Row<Tasks> task);

/// A body whose loose pieces found no room (is_owed_births) and that no task works on asks again. They leave with the
/// body's own motion.
void ask_again(Births& births, Row<Bodies> body);

/// A shell that stayed whole but has new cracks: the body keeps them.
void keep_cracks(Births& births, Row<Tasks> task);

}  // namespace cullet
