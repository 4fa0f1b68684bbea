// The order of one frame: impact in, fragments out. First contacts are detected and impulses predicted. Then damage is
// decided. Only then are contacts solved, so that what breaks does not throw the striker back. A host with its own
// physics (World::create_hosted) has moved the bodies before the frame, and solves after it.
//
// A slot holds the systems of each damage model, or of each structure (slots.hpp).
#include "engine/assert.hpp"
#include "systems/drawn/query_index.hpp"
#include "systems/slotted_plan.hpp"
#include "systems/systems.hpp"
#include "systems/tasks/run_loops.hpp"
#include "systems/world_contents.hpp"

namespace cullet {

FramePlan<WorldData> make_frame_plan(bool is_hosted, const DamageModels& models) {
    SlottedPlan plan(models, structures());
    plan.stage("start").then<remember_poses>();
    if (is_hosted) plan.then<read_rigid>();
    plan.then<take_blows>();
    if (CULLET_CHECKS_ON) plan.then<open_energy_balance>();
    plan.models(Slot::Rest)
        .then<detect_contacts>()
        .then<predict_impacts>()
        .then<meet_foreseen>()
        .then<foresee_impacts>()
        .then<open_tasks>()
        .models(Slot::Wake);
    plan.stage("damage").then<grant_units>().then<advance_runs>().loops();
    plan.models(Slot::Pass).then<settle_tasks>().models(Slot::Close);
    plan.stage("apply")
        .models(Slot::Group)
        .then<plan_births>()
        .structures(Slot::Fill)
        .then<plan_hulls>()
        .structures(Slot::Hull)
        .then<make_births>();
    plan.stage("solve");
    if (!is_hosted) plan.then<solve_rigid>().models(Slot::GiveBack).then<read_rigid>();
    plan.then<weigh_loads>().then<grind_crushed>().then<hold_squeezed>().then<fall_debris>();
    if (CULLET_CHECKS_ON) plan.then<close_energy_balance>();
    plan.then<fade_debris>();
    plan.stage("end")
        .models(Slot::Show)
        .structures(Slot::Draw)
        .then<bound_drawn>()
        .then<refresh_queries>()
        .structures(Slot::Compact);
    return plan.take();
}

}  // namespace cullet
