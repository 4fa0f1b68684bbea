// What a world is made of, for the sample game, tests and measurements.
#pragma once
#include <functional>

#include "cullet/host.hpp"
#include "cullet/world.hpp"
#include "engine/frame_plan.hpp"
#include "engine/host_rigid_world.hpp"
#include "systems/api/host_log.hpp"
#include "systems/api/recorder.hpp"
#include "systems/world_data.hpp"

namespace cullet {

struct World::Contents {
    /// Without `rigid` the host moves the bodies.
    Contents(const Settings& settings, const Host& host, std::unique_ptr<RigidWorld> rigid,
             std::shared_ptr<const DamageModels> models);
    ~Contents();
    /// What is inside of a world, as one.
    static World world_of(std::unique_ptr<Contents> contents) { return World(std::move(contents)); }

    Settings settings;
    Host host;
    std::unique_ptr<JobSystem> jobs;
    Profiler profiler;
    WorldData data;
    HostRigidWorld* hosted = nullptr;  // data.rigid, where the host moves the bodies
    FramePlan<WorldData> plan;
    HostLog log;
    struct Counters {
        uint32_t units_used = 0, units_left = 0, open_tasks = 0, births = 0, holds = 0, refusals = 0;
    } counters;  // in the trace
    /// Their values of the step that ends.
    void count();
    /// One frame of the plan, with all that goes round it.
    void step();
    std::unique_ptr<Recorder> recorder;  // null: nothing is written down
    /// The game's; its answers are written down.
    bool (*allows)(void* user, const ImpactEvent& impact) = nullptr;
    void* allows_user = nullptr;
    void set_veto(bool (*allows)(void* user, const ImpactEvent& impact), void* user);
    /// Called between systems when set: --validate.
    std::function<void(const PlannedSystem<WorldData>&)> after_each_system;
};

/// The systems of a frame in their order (frame.cpp). With `is_hosted` bodies were moved before it. The models must
/// outlive it.
FramePlan<WorldData> make_frame_plan(bool is_hosted, const DamageModels& models);

}  // namespace cullet
