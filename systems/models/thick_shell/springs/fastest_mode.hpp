#pragma once
#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {

/// Square of an angular frequency that no mode of the springs about their shape at rest is above, 1/s2, also after any
/// of its edges were cut. It is the largest of all elements, each alone with its share of its springs and its third of
/// the masses. A structure vibrates no faster than its fastest element (Irons and Treharne 1971). By power iteration,
/// from below, within some hundredths. O(elements).
double fastest_mode(const SpringView& view);

}  // namespace cullet
