// No break adds energy.
#pragma once
#include "systems/births/make_break.hpp"
#include "systems/bodies/rigid_energy.hpp"

namespace cullet {

/// J, of the pieces and debris that came of a break.
double pieces_energy(const Bodies& bodies, const Debris& debris, const Fragments& fragments, const Break& plan);

/// J, what body and strikers had at the touch, by the run, and do not have any more: the rigid solver took it while the
/// pieces were not known yet.
double owed_to_late(const BodyRows& state, Row<Tasks> task);

/// Of what just came of a break: the pieces and the debris may together have at most `allowed` (J), what the body had
/// and what strikers lost to it. The hidden run keeps to that, but not what follows from it. A rigid piece turns with
/// the inertia of its tetrahedra and not of its vertices (a few per cent). Of two bodies that break each other the one
/// takes the impulse that the other's run passed. Pieces that have more go nearer to the motion that they have in
/// common, which keeps momentum and angular momentum. With E_c the energy of that, what goes beyond it is multiplied by
/// s, s^2 = (allowed - E_c)/(E - E_c). Where E_c alone is too much, they turn less in common as well. Where a piece
/// holds a pin they go nearer to rest, and the support takes it.
void limit_energy(Births& births, const Break& plan, double allowed);

/// What is still too much after that is the pieces' common motion: of three bodies that break each other in one frame
/// the last got impulses that no other of the runs knew of. Pieces and strikers, one after another, go nearer to the
/// velocity that they have in common, by an impulse between their centres, until both together have lost what was too
/// much.
void share_with_strikers(Births& births, const Break& plan, double allowed);

}  // namespace cullet
