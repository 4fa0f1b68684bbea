// A world is made, stepped and asked how it goes.
#include "components/commit_ahead.hpp"
#include "engine/host_scope.hpp"
#include "systems/api/checks.hpp"
#include "systems/api/cost.hpp"
#include "systems/cook/materials.hpp"
#include "systems/models.hpp"
#include "systems/tasks/run_loops.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

/// For which a frame asks the system, for hits to come: a quarter of a millisecond where page faults are dear.
constexpr uint64_t kBytesAhead = 256 * 1024;

/// Queue by queue, in the order of queues_told: members of StepEvents in another one do not compile.
template <class... E>
StepEvents spans_of(const Queues<E...>& told) {
    return {EventSpan<E>{told.template of<E>().all().data(), told.template of<E>().size()}...};
}

}  // namespace

World::Contents::Contents(const Settings& s, const Host& h, std::unique_ptr<RigidWorld> rigid,
                          std::shared_ptr<const DamageModels> models)
    : settings(s),
      host(h),
      jobs(h.jobs.parallel_for ? make_host_jobs(h.jobs) : make_jobs(JobBackend::Tbb, s.threads)),
      data(s) {
    fill_materials(data.state.materials);
    data.rigid = std::move(rigid);
    if (!data.rigid) {
        const HostRoom room{s.limits.bodies, kMostCellParts * data.state.cells.limit(), data.state.hull_points.limit()};
        auto made = std::make_unique<HostRigidWorld>(room, data.state.bodies.generation.data());
        hosted = made.get();
        data.rigid = std::move(made);
    }
    data.rigid->use_jobs(*jobs);
    data.rigid->set_gravity(s.gravity);
    data.damage_models = std::move(models);
    const uint32_t most_runs = data.state.tasks.limit() + data.damage_models->most_moving(data.state);
    data.run_loops = std::make_unique<RunLoops>(*jobs, profiler, *data.damage_models, most_runs);
    plan = make_frame_plan(hosted != nullptr, *data.damage_models);
    plan.finish(profiler);
    counters = {profiler.add_counter("units used"), profiler.add_counter("units left"),
                profiler.add_counter("open tasks"), profiler.add_counter("births"),
                profiler.add_counter("holds"),      profiler.add_counter("refusals")};
}
World::Contents::~Contents() = default;

void World::Contents::count() {
    const Tasks& tasks = data.state.tasks;
    uint32_t open = 0, held = 0;
    for (uint32_t t = 0; t < tasks.size(); ++t) {
        const bool is_open = static_cast<TaskState>(tasks.state[t]) != TaskState::Free;
        open += is_open;
        held += is_open && tasks.is_held[t];
    }
    profiler.count(counters.units_used, data.counts.units_used);
    profiler.count(counters.units_left, data.counts.units_left);
    profiler.count(counters.open_tasks, open);
    profiler.count(counters.births, data.told.of<FragmentBornEvent>().size());
    profiler.count(counters.holds, held);
    profiler.count(counters.refusals, data.told.of<RefusedEvent>().size());
}

World::World(std::unique_ptr<Contents> contents) : contents_(std::move(contents)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;
World::Contents& World::contents() {
    return *contents_;
}
const World::Contents& World::contents() const {
    return *contents_;
}

void World::step() {
    const HostScope call(contents_->host);
    if (!contents_->hosted) return contents_->step();
    const Host& host = contents_->host;
    if (host.log)
        host.log(host.user, LogLevel::Error,
                 "World::step() without a HostFrame does nothing in a world of create_hosted; give it the frame.");
}

void World::Contents::step() {
    WorldData& d = data;
    if (host.zone_begin) host.zone_begin(host.user, "cullet step");
    d.told.for_each([](auto& events) { events.clear(); });
    d.between.of<DrawnChanged>().clear();
    d.arena.reset();
    if (recorder) recorder->begin_step();
    profiler.begin_frame(d.step_info.frame);
    plan.step(d, *jobs, profiler, after_each_system ? &after_each_system : nullptr, &host);
    count();
    profiler.end_frame();
    commit_ahead(d.state, d.ready_for, kBytesAhead);
    if (recorder) {
        recorder->end_step(d.step_info.frame, d.state);
        const char* const trouble = recorder->untold_trouble();
        if (trouble && host.log) host.log(host.user, LogLevel::Error, trouble);
    }
    ++d.step_info.frame;
    if (host.zone_end) host.zone_end(host.user);
    log.tell(host, d);
}

void World::Contents::set_veto(bool (*game_allows)(void* user, const ImpactEvent& impact), void* user) {
    allows = game_allows;
    allows_user = user;
    data.damage_settings.allows = nullptr;
    if (!game_allows) return;
    data.damage_settings.allows_user = this;
    data.damage_settings.allows = [](void* self, const ImpactEvent& impact) {
        const auto& world = *static_cast<Contents*>(self);
        const bool answer = world.allows(world.allows_user, impact);
        if (world.recorder) world.recorder->answer(answer);
        return answer;
    };
}

StepReport World::report() const {
    const WorldData& d = contents_->data;
    StepReport report;
    report.frame = d.step_info.frame;
    report.units_used = d.counts.units_used;
    report.units_left = d.counts.units_left;
    const Tasks& tasks = d.state.tasks;
    for (uint32_t t = 0; t < tasks.size(); ++t) {
        report.open_hits += static_cast<TaskState>(tasks.state[t]) != TaskState::Free;
        report.held_bodies += tasks.is_held[t] && static_cast<TaskState>(tasks.state[t]) != TaskState::Free;
    }
    const Bodies& bodies = d.state.bodies;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        const auto kind = static_cast<BodyKind>(bodies.kind[b]);
        report.bodies += kind != BodyKind::Free;
        report.awake += kind == BodyKind::Dynamic && !bodies.is_asleep[b];
    }
    for (uint32_t i = 0; i < d.state.debris.size(); ++i) report.debris += d.state.debris.is_used[i];
    report_cost(d, report);
    return report;
}

RigidReport World::rigid_report() const {
    const RigidCounts counts = contents_->data.rigid->counts();
    return {counts.pairs, counts.contacts, counts.sweeps};
}

StepEvents World::events() const {
    return spans_of(contents_->data.told);
}

uint64_t World::hash() const {
    return contents_->data.state.hash();
}

Result<void> World::set_gravity(Vec3 gravity) {
    const HostScope call(contents_->host);
    if (const Result<void> valid = check_gravity("gravity", gravity); !valid) return valid;
    if (contents_->recorder) contents_->recorder->set_gravity(gravity);
    WorldData& d = contents_->data;
    if (d.step_info.gravity == gravity) return {};
    d.step_info.gravity = gravity;
    d.rigid->set_gravity(gravity);  // wakes them
    for (uint32_t b = 0; b < d.state.bodies.size(); ++b) d.state.bodies.is_asleep[b] = 0;
    return {};
}

void World::set_veto(bool (*allows)(void* user, const ImpactEvent& impact), void* user) {
    contents_->set_veto(allows, user);
}

std::string World::describe_frame() {
    Settings settings;
    settings.limits = {16, 1, 4096, 4096, 1, 4096, 16};
    const auto contents = std::make_unique<Contents>(
        settings, Host{}, std::make_unique<HostRigidWorld>(HostRoom{}, nullptr), damage_models());
    return contents->plan.describe();
}

}  // namespace cullet
