// What springs that re-meshing makes know of those that it took away.
#pragma once
#include "systems/models/thick_shell/springs/spring_view.hpp"

namespace cullet {

/// The element keeps how far its springs have flowed. Before any of them is taken from it.
void remember_flow(const SpringView& view, uint32_t element);
/// A spring that has just been measured at the shape at rest has flowed as the elements at its edge had: the mean of
/// both, or of those beside them where they are new themselves. Where the shape at rest is the cooked one the plastic
/// length follows; where it is the one that the shell has now, that is the plastic length, and the cooked one follows.
/// False: nothing had flowed there.
bool carry_flow(const SpringView& view, uint32_t spring);

}  // namespace cullet
