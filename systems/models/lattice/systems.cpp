#include "systems/models/lattice/systems.hpp"

#include <algorithm>

#include "systems/models/lattice/break_rooms.hpp"
#include "systems/models/lattice/gather_blow.hpp"
#include "systems/models/lattice/loop.hpp"

namespace cullet::lattice {

void start_breaks(EachOwn<TaskOpened> opened, LatticeRows rows, const Blows& blows) {
    gather_blow(rows, blows, opened->task);
    begin_run(rows, opened->task);
}

void work_break(Of<Tasks> task, LatticeRows rows) {
    const Row<Tasks> t = task.row;
    Tasks& tasks = rows.tasks;
    tasks.steps_granted[t] -= tasks.steps_granted[t] > 0;
    ++tasks.steps_done[t];
    uint64_t units = 0;
    const bool is_done = advance_run(rows, t, units);
    // What was granted for more steps pays for a long one; the rest is owed.
    const auto paid = static_cast<uint32_t>(std::min<uint64_t>(tasks.steps_granted[t], units / kUnitsAStep));
    tasks.steps_granted[t] -= paid;
    tasks.units_owed[t] += units - paid * kUnitsAStep;
    if (!is_done) return;
    const RoomOfRun& run = run_of(rows, t);
    const auto pieces = static_cast<uint32_t>(room_of_task(rows, t)->broken.pieces.size());
    LatticeResults& results = rows.lattice_results;
    results.pieces[t] = pieces;
    results.cracks[t] = run.run.crack_count;
    results.gate[t] = rows.lattice_runs.speed[t] > 0 ? run.run.gate : 0;
    tasks.crack_count[t] = pieces > 1 ? run.run.crack_count : 0;
    tasks.start_count[t] = 0;
    tasks.state[t] = static_cast<uint8_t>(TaskState::Whole);  // count_pieces tells whether it broke
}

void count_pieces(EachOwn<TaskEnded> ended, Tables<Tasks, SolidWork> rows) {
    const Row<Tasks> task = ended->task;
    Tasks& tasks = rows.tasks;
    tasks.part_count[task] = 1;
    if (static_cast<TaskState>(tasks.state[task]) == TaskState::Dropped || tasks.crack_count[task] == 0) return;
    const auto count = static_cast<uint32_t>(room_of_task(rows, task)->broken.pieces.size());
    tasks.part_count[task] = count;
    if (count > 1) tasks.state[task] = static_cast<uint8_t>(count > kMostParts ? TaskState::Dropped : TaskState::Broke);
}

}  // namespace cullet::lattice
