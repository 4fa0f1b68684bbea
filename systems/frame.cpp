// The order of one frame: impact in, fragments out. Contacts are detected and impulses predicted, damage is decided,
// and only then are contacts solved, so that what breaks does not throw the striker back. A host with its own physics
// (World::create_hosted) has moved the bodies before the frame, and solves after it.
#include "engine/assert.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/models/thick_shell/soft/soft_loop.hpp"
#include "systems/systems.hpp"
#include "systems/tasks/damage_loop.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

FramePlan<WorldData> make_frame_plan(bool is_hosted, const std::function<std::string()>& describe_damage_loop,
                                     const std::function<std::string()>& describe_soft_loop) {
    FramePlan<WorldData> plan;
    plan.stage("start").then<remember_poses>();
    if (is_hosted) plan.then<read_rigid>();
    plan.then<take_blows>();
    if (CULLET_CHECKS_ON) plan.then<open_energy_balance>();
    plan.then<freeze_soft_bodies>()
        .then<detect_contacts>()
        .then<predict_impacts>()
        .then<meet_foreseen>()
        .then<foresee_impacts>()
        .then<open_tasks>()
        .then<widen_regions>()
        .then<fill_tasks>()
        .then<fill_stiffness>()
        .then<start_tasks>()
        .then<wake_regions>()
        .then<measure_regions>()
        .then<lay_regions>()
        .then<start_regions>()
        .then<wake_soft_bodies>();
    plan.stage("damage")
        .then<grant_units>()
        .then<advance_damage>()
        .shows("thick shell, brittle: 300 to 4,000 times a hit, on its own clock", describe_damage_loop)
        .then<advance_soft>()
        .shows("thick shell, ductile and elastic: 8 to 1,000 times a frame", describe_soft_loop)
        .then<pass_soft>()
        .then<settle_tasks>()
        .then<close_regions>();
    plan.stage("apply")
        .then<find_parts>()
        .then<smooth_cracks>()
        .then<plan_births>()
        .then<fill_births>()
        .then<plan_hulls>()
        .then<fill_hulls>()
        .then<make_births>();
    plan.stage("solve");
    if (!is_hosted) plan.then<solve_rigid>().then<return_soft>().then<read_rigid>();
    plan.then<weigh_loads>();
    plan.then<fall_debris>();
    if (CULLET_CHECKS_ON) plan.then<close_energy_balance>();
    plan.then<fade_debris>();
    plan.stage("end")
        .then<show_soft>()
        .then<draw_shells>()
        .then<bound_drawn>()
        .then<refresh_queries>()
        .then<compact_shells>();
    return plan;
}

}  // namespace cullet
