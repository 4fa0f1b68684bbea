#include "systems/models/thick_shell/model.hpp"

#include "systems/models/thick_shell/check_calls.hpp"
#include "systems/models/thick_shell/cook_shell.hpp"
#include "systems/models/thick_shell/hidden/restart.hpp"
#include "systems/models/thick_shell/hidden/systems.hpp"
#include "systems/models/thick_shell/loops.hpp"
#include "systems/models/thick_shell/open_calls.hpp"
#include "systems/models/thick_shell/piece_calls.hpp"
#include "systems/models/thick_shell/quick/systems.hpp"
#include "systems/models/thick_shell/restore_calls.hpp"
#include "systems/models/thick_shell/shared/cancel_run.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/quick_body.hpp"
#include "systems/models/thick_shell/shared/settings.hpp"
#include "systems/models/thick_shell/shared/working_room.hpp"
#include "systems/models/thick_shell/soft/soft_body.hpp"
#include "systems/models/thick_shell/soft/soft_calls.hpp"
#include "systems/models/thick_shell/soft/systems.hpp"
#include "systems/models/thick_shell/spawn_calls.hpp"
#include "systems/models/thick_shell/systems.hpp"

namespace cullet {

DamageModel thick_shell_model() {
    DamageModel model("thick_shell");
    model.at(Slot::Rest).then<freeze_soft_bodies>();
    model.at(Slot::Wake)
        .then<widen_regions>()
        .then<want_stiffness>()
        .then<fill_tasks>()
        .then<fill_stiffness>()
        .then<start_tasks>()
        .then<wake_regions>()
        .then<measure_regions>()
        .then<lay_regions>()
        .then<start_regions>()
        .then<wake_soft_bodies>()
        .then<find_soft_strikers>()
        .then<share_soft_strikers>();
    model.at(Slot::Pass).then<shape_soft>().then<pass_soft>();
    model.at(Slot::Close).then<close_regions>();
    model.at(Slot::Group).then<find_parts>().then<smooth_cracks>();
    model.at(Slot::GiveBack).then<return_soft>();
    model.at(Slot::Show).then<show_soft>();
    register_loops(model);
    model.cook_settings<&CookSettings::thick_shell>();
    model.spawn_settings<&SpawnSettings::thick_shell>()
        .spawn_settings<&SpawnSettings::thick_shell, &ThickShellSpawnSettings::quick>("quick")
        .spawn_settings<&SpawnSettings::thick_shell, &ThickShellSpawnSettings::springs>("springs");
    model.cooks<cook_thick_shell>().spawns<spawn_body>().spawns_own<spawn_shell>().says_why_not_cut<why_not_cut>();
    model.takes<working_shell, begin_run>().takes_late<give_late_rows>().needs_room<room_of_hit, may_find_room>();
    model.lasts<run_length>().works_on_parts<is_cut_out>().cancels<cancel_run>();
    model.moves_rest<motion_of_rest>().inherits<inherit_fracture>().keeps_cell_names<is_quick_body>();
    model.has_energy<soft_energy>().takes_blows<push_soft_body, explode_soft_body>();
    model.makes_way<call_up_soft_body, is_soft_driven_into>();
    model.may_tear<is_awake, look_for_pieces, take_torn>().tears<hand_off_torn, give_torn_pieces, keep_torn_body>();
    model.keeps_for_bodies<follow_body, release_soft>();
    model.restores<restore_scratch, restore_sums>();
    model.checks<check_thick_shell>().checks_own<trouble_of_run, check_model_rows>();
    return model;
}

}  // namespace cullet
