// What is to be filled, in which order.
#pragma once
#include "systems/births/planning.hpp"

namespace cullet {

/// Something leaves. The heaviest come first, so that the longest work begins first; what waits for the body goes on to
/// its pieces.
void order_births(Planning& planning, Break& plan);

}  // namespace cullet
