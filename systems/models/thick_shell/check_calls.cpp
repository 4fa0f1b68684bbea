#include "systems/models/thick_shell/check_calls.hpp"

#include "systems/models/thick_shell/quick/check_quick.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/springs/check_springs.hpp"
#include "systems/structures/shell/cook/check_shell_rows.hpp"

namespace cullet {

Result<void> check_worn_shell(const ShellView& shell, bool is_part, const std::string& name, const char* advice) {
    return check_shell_rows(shell, is_part ? Wear::CutOut : Wear::Worn, name, advice);
}

std::string trouble_of_run(const RunRows& state, uint32_t task) {
    const bool is_sound = is_quick_task(state, task) || state.shells.packs[state.tasks.shell[task]].count > 0;
    return is_sound ? "" : "has no stiffness";
}

Result<void> check_model_rows(const BodyRows& state, const std::string& name, const char* advice) {
    if (const Result<void> sound = check_springs(state, name, advice); !sound) return sound;
    return check_quick_rows(state, name, advice);
}

}  // namespace cullet
