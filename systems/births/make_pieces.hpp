// The fragments of one body enter the world.
#pragma once
#include "systems/births/make_break.hpp"
#include "systems/births/moment.hpp"

namespace cullet {

/// Debris, rows, rigid bodies and events of what leaves, and the shape of what is left. Children first: their hulls are
/// found among the body's, which change last. From here on the child of the largest is the body.
void make_pieces(Births& births, const Break& plan, const Moment& moment);

}  // namespace cullet
