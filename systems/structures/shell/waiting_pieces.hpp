// Pieces that found no room go on with the body, and leave it with what they had of their own.
#pragma once
#include "components/body_rows.hpp"
#include "components/fragments.hpp"

namespace cullet {

/// While a body owes births, velocities of its vertices are those of pieces that wait, relative to the body's motion,
/// body axes; zero of what is left. The rest of the body has what takes their momentum and angular momentum to zero. A
/// further hit forgets them.
void forget_own_motions(ShellView shell);

/// The fragment's vertices move as it does.
void keep_own_motion(ShellView shell, const Fragments& fragments, Row<Fragments> of);
/// What the body moves like, by its largest fragment, is not the pieces' own.
void subtract_motion(ShellView shell, const Fragments& fragments, Row<Fragments> of_body);

/// Fragments that have motions of their own get them, and the heaviest what is left for it; vertices are still again.
void take_own_motions(ShellView shell, Fragments& fragments, Rows<Fragments> of);

/// J that the body's waiting pieces and its rest have beyond the body's own motion.
double waiting_energy(const BodyRows& state, Row<Bodies> body);
/// Where that is more than `allowed`, all of them slow down to it. What they have then.
double limit_waiting(BodyRows& state, Row<Bodies> body, double allowed);

}  // namespace cullet
