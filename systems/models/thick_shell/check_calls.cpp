#include "systems/models/thick_shell/check_calls.hpp"

#include "systems/models/thick_shell/quick/check_quick.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/models/thick_shell/soft/check_soft.hpp"
#include "systems/models/thick_shell/springs/check_springs.hpp"
#include "systems/structures/shell/cook/check_shell_rows.hpp"
#include "systems/tasks/step_limits.hpp"

namespace cullet {

Result<void> check_thick_shell(ShellRows& rows, Row<Structures> structure, Wear wear, const std::string& name,
                               const char* advice) {
    const ShellView shell(rows, structure);
    if (const Result<void> sound = check_shell_rows(shell, wear, name, advice); !sound) return sound;
    const Shells& s = shell.shells();
    const auto refuse = [&](const std::string& what) { return Error{name + ": " + what + ". " + advice}; };
    const float step = s.time_step[shell.row],
                run = run_seconds(shell.state, shell.structures().material[shell.structure],
                                  shell.structures().area[shell.structure]);
    if (!(run <= kMostSteps * step))
        return refuse("shells.time_step is " + std::to_string(step) + " s for a hit of " + std::to_string(run) + " s");
    if (wear == Wear::Intact && (s.packs[shell.row].count == 0 || s.blocks[shell.row].count == 0))
        return refuse("it has " + std::to_string(s.packs[shell.row].count) + " stiffness packs and " +
                      std::to_string(s.blocks[shell.row].count) + " stiffness blocks; none of them may be 0");
    return {};
}

std::string trouble_of_run(const RunRows& state, uint32_t task) {
    const bool is_sound =
        is_quick_task(state, task) || state.shells.packs[state.shell_of(state.tasks.working[task])].count > 0;
    return is_sound ? "" : "has no stiffness";
}

Result<void> check_model_rows(const SoftRows& state, uint8_t own, const std::string& name, const char* advice) {
    if (const Result<void> sound = check_soft(state, name, advice); !sound) return sound;
    if (const Result<void> sound = check_springs(state, name, advice); !sound) return sound;
    return check_quick_rows(state, own, name, advice);
}

}  // namespace cullet
