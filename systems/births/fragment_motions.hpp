// How fragments move, as far as planning knows: with the body, or with each other.
#pragma once
#include "systems/births/planning.hpp"

namespace cullet {

/// Every piece goes on with the body's own motion, about the centres that the rigid world knows, so that momentum and
/// angular momentum are kept to rounding. Body axes.
void move_with_body(Planning& planning, const Break& plan, Vec3d velocity, Vec3d spin);

/// Of a body that was dented: its momentum and angular momentum are those that it had, though its mass lies otherwise.
void move_reshaped(Planning& planning, const Break& plan, Vec3d velocity, Vec3d spin);

/// The motions are final: before fragments become one, since the touches name them.
void settle(Planning& planning, Break& plan);

/// `joined` stays part of `fragment` and moves with it, as one that keeps momentum and angular momentum. What it was
/// stopped by, and that it was, goes on to be counted.
void join_motions(Fragments& fragments, Row<Fragments> fragment, Row<Fragments> joined);

/// J that pieces may have beyond the body's motion where none of them left. It is what the contact that is solved now
/// takes for certain: half of what two bodies lose that meet without bouncing. Of a late result it is what that has
/// taken.
double lost_to_touch(const BodyRows& state, Row<Tasks> task);

}  // namespace cullet
