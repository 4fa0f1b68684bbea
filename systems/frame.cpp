// The order of one frame: impact in, fragments out. Contacts are detected and impulses predicted, damage is decided,
// and only then are contacts solved, so that what breaks does not throw the striker back. A host with its own physics
// (World::create_hosted) has moved the bodies before the frame, and solves after it.
#include "engine/assert.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/systems.hpp"
#include "systems/tasks/run_loops.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

FramePlan<WorldData> make_frame_plan(bool is_hosted, const RunLoops& loops) {
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
        .then<find_soft_strikers>()
        .then<share_soft_strikers>()
        .then<advance_runs>()
        .shows("thick shell, brittle: 300 to 4,000 times a hit, on its own clock", loops.hidden)
        .shows("thick shell, quick: 8 to 100 times a hit", loops.quick)
        .shows("thick shell, ductile and elastic: 8 to 1,000 times a frame", loops.soft_one_layer)
        .shows("the same, of bodies with an inner and an outer layer", loops.soft_layers)
        .then<shape_soft>()
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
