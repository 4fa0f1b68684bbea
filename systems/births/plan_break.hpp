// Which pieces of a broken body leave, and their rows.
#pragma once
#include "systems/births/planning.hpp"

namespace cullet {

/// Debris that the world has room for when a step's planning begins.
uint32_t free_debris(const Debris& debris);
/// Fragments that limits.fragments leaves room for then.
uint32_t free_fragments(const FragmentAges& ages, const DamageSettings& settings);

/// The task's structure has come apart. The largest fragment keeps the body's handle and its rows in that structure,
/// which becomes the body's own; the others get rows in order of mass, and their old rows will be dead. A piece that
/// finds no room stays with the largest and is counted with the setting to raise; it keeps its own motion for when it
/// leaves.
void plan_break(Planning& planning, Row<Tasks> task);

/// A body whose loose pieces found no room (is_owed_births) and that no task works on asks again. They leave with the
/// body's motion and what they have of their own; asleep, they have none any more.
void ask_again(Planning& planning, Row<Bodies> body);

/// A body that its damage model moves, and that tore: pieces leave it with the motions that the model finds. What has a
/// pin keeps the handle, else the largest; the model goes on moving it.
void plan_tear(Planning& planning, Row<Bodies> body);

/// A structure that stayed whole but has new cracks: the body keeps them.
void keep_cracks(Planning& planning, Row<Tasks> task);

}  // namespace cullet
