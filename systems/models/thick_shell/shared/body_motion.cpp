#include "systems/models/thick_shell/shared/body_motion.hpp"

#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {

// Cuts and new vertices leave the centre where it is.
BodyMotion::BodyMotion(const RunRows& state, Row<Tasks> task)
    : centre(vertex_sums(ShellView(const_cast<RunRows&>(state), state.tasks.source[task])).centre()),
      velocity(state.tasks.start_velocity[task]),
      spin(state.tasks.start_spin[task]) {}

}  // namespace cullet
