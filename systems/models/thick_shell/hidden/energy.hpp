// Energy of a hidden run, for the test of every 64 steps (thick shell note B7: above 1.05 of the start, redo with
// dt/2).
#pragma once
#include "components/run_rows.hpp"

namespace cullet {

struct TaskEnergy {
    double kinetic = 0, membrane = 0, bending = 0, contact = 0, strikers = 0;  // J; strikers of infinite mass count 0
    double work = 0;  // J, that strikers of infinite mass have done: a lift on its way up
    double total() const { return kinetic + membrane + bending + contact + strikers; }
};

/// Energy at (u, v) as they are. Sums in double over fixed chunks, added in order. Uses the side of the probe that the
/// next step will write (steps_done tells which), and Elements.slope, as scratch: call it between steps. Costs about
/// one step.
TaskEnergy task_energy(RunRows& state, Row<Tasks> task);

/// B7's redo criterion: energy above 1.05 of the start and of the work put in, or not finite.
bool is_blown_up(const TaskEnergy& energy, double start_energy);

/// Parts of the above, for one chunk of rows, in this order. First the kinetic energy of vertices [first, first +
/// count), which also writes u into side `side` of the probe. Then membrane_energy (stress_check.hpp), which writes the
/// slopes. Last the bending energy of the elements' halves of their hinges.
double kinetic_energy(ShellView shell, uint32_t side, uint32_t first, uint32_t count);
double bending_energy(ShellView shell, uint32_t first, uint32_t count);

}  // namespace cullet
