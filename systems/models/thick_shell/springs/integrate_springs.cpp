#include "systems/models/thick_shell/springs/press_layers.hpp"
#include "systems/models/thick_shell/springs/spring_packs.hpp"
#include "systems/models/thick_shell/springs/systems.hpp"

namespace cullet {
namespace {

template <class Kernel>
void integrate(const Rows<SpringPacks>& packs, const SteppedView& view, Turn turn, Kernel kernel) {
    const uint32_t first = packs.first - view.own().packs[view.row].first;
    if (has_energies(view.own(), view.row)) press_packs(view, turn.old_side, first, packs.count);
    const SpringStep step(view, turn.old_side);
    kernel(step, first, packs.count);
}

}  // namespace

// The kernel reads and writes through the columns' addresses; the parameters say which.
void integrate_springs(Rows<SpringPacks> packs, Of<ShellSprings> springs, Turn turn, InChunks<SteppedTables> rows) {
    integrate(packs, SteppedView(rows.set, springs.row), turn, integrate_spring_packs);
}

void integrate_layers(Rows<SpringPacks> packs, Of<ShellSprings> springs, Turn turn, InChunks<SteppedTables> rows) {
    const SteppedView view(rows.set, springs.row);
    integrate(packs, view, turn,
              view.layout() == SpringLayout::Crossed ? integrate_crossed_packs : integrate_sandwich_packs);
}

void end_spring_step(Of<ShellSprings> springs, ShellSprings& own) {
    ++own.steps[springs.row];
}

}  // namespace cullet
