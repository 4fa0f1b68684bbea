// The systems of the quick mode's inner loop.
#include "systems/models/thick_shell/quick/grow_region.hpp"
#include "systems/models/thick_shell/quick/quick_loop.hpp"
#include "systems/models/thick_shell/quick/region_motion.hpp"
#include "systems/models/thick_shell/quick/systems.hpp"
#include "systems/models/thick_shell/shared/count_step.hpp"
#include "systems/models/thick_shell/springs/press_layers.hpp"
#include "systems/models/thick_shell/springs/spring_packs.hpp"

namespace cullet {

void push_region_patches(Of<Tasks> task, RunRows& rows) {
    region_forces(RegionView(rows, task.row));
}

// The kernel knows packs by their place in the shell: it is called for runs of neighbouring ones.
void integrate_region(Rows<MarkedPacks> packs, Of<Tasks> task, Turn turn, InChunks<SteppedRegion> rows) {
    const SteppedView view(rows.set, rows.set.quick_runs.springs[task.row]);
    const SpringStep step(view, turn.old_side);
    const bool is_pressed = has_energies(view.own(), view.row);
    const auto integrate = view.layout() == SpringLayout::OneLayer   ? integrate_spring_packs
                           : view.layout() == SpringLayout::Sandwich ? integrate_sandwich_packs
                                                                     : integrate_crossed_packs;
    const uint32_t end = packs.first + packs.count;
    for (uint32_t row = packs.first, next = 0; row < end; row = next) {
        next = row + 1;
        while (next < end && rows->marked_packs.pack[next] == rows->marked_packs.pack[next - 1] + 1) ++next;
        if (is_pressed) press_packs(view, turn.old_side, rows->marked_packs.pack[row], next - row);
        integrate(step, rows->marked_packs.pack[row], next - row);
    }
}

// Of the steps that are granted one is used up by each that is run, and as many as they are worth by cuts (pay_cuts).
void end_region_step(Of<Tasks> task, RunRows& rows) {
    const Row<Tasks> t = task.row;
    const RegionView region(rows, t);
    ++region.springs.own().steps[region.springs.row];
    hold_region(region);
    push_region(region);
    count_step(rows.tasks, rows.hidden_runs, t, rows.hidden_runs.end_time[t], [&] {
        return StepUnits{quick_units_a_step(rows, t), quick_units_of_end(rows, t)};
    });
}

void split_region(Of<Tasks> task, RunRows& rows) {
    const Row<Tasks> t = task.row;
    if (static_cast<TaskState>(rows.tasks.state[t]) == TaskState::Running) grow_region(rows, t);
}

// A run so short is not begun again: its step has the bound of the stiffest vertex in it.
void check_region_energy(Of<Tasks> task, RunRows& rows) {
    const Row<Tasks> t = task.row;
    if (static_cast<TaskState>(rows.tasks.state[t]) == TaskState::Dropped) return;
    if (has_blown_up(RegionView(rows, t))) rows.tasks.state[t] = static_cast<uint8_t>(TaskState::Dropped);
}

}  // namespace cullet
