#include "sample_game/game_world.hpp"

#include <fmt/format.h>

#include <tuple>

#include "sample_game/scenes/scenes.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

constexpr size_t kMostFaults = 20;  // sentences; all are counted

bool is_dynamic(const Bodies& bodies, uint32_t b) {
    return bodies.kind[b] == static_cast<uint8_t>(BodyKind::Dynamic);
}

bool is_free(const Bodies& bodies, uint32_t b) {
    return bodies.kind[b] == static_cast<uint8_t>(BodyKind::Free);
}

uint32_t cell_count(const State& state, uint32_t body) {
    const Row<Shells> shell = state.bodies.shell[body];
    return shell.exists() ? state.shells.cells[shell].count : 0;
}

void add_moving(Matter& matter, double mass, Vec3 velocity) {
    const Vec3d v(velocity);
    matter.momentum[0] += mass * v.x, matter.momentum[1] += mass * v.y, matter.momentum[2] += mass * v.z;
    matter.kinetic_energy += 0.5 * mass * dot(v, v);
}

double spin_energy(const Bodies& bodies, uint32_t b) {
    const Vec3d w(rotate(conjugate(bodies.orientation[b]), bodies.spin[b]));
    return 0.5 * dot(w, bodies.inertia[b] * w);
}

}  // namespace

Matter measure_matter(const World& world) {
    const State& state = world.contents().data.state;
    const Bodies& bodies = state.bodies;
    Matter matter;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (is_free(bodies, b)) continue;
        const bool has_shell = bodies.shell[b].exists();
        if (!has_shell && !is_dynamic(bodies, b)) continue;
        matter.mass += bodies.mass[b];
        matter.fragments += has_shell && bodies.parent[b].exists();
        if (!is_dynamic(bodies, b) || bodies.has_pins[b]) continue;
        add_moving(matter, bodies.mass[b], bodies.velocity[b]);
        matter.kinetic_energy += spin_energy(bodies, b);
        if (bodies.is_asleep[b]) {
            ++matter.asleep;
        } else {
            ++matter.awake;
            matter.awake_cells += cell_count(state, b);
        }
    }
    for (uint32_t d = 0; d < state.debris.size(); ++d) {
        if (!state.debris.is_used[d]) continue;
        matter.debris_mass += state.debris.mass[d];
        if (!state.debris.is_resting[d]) add_moving(matter, state.debris.mass[d], state.debris.velocity[d]);
    }
    matter.mass += matter.debris_mass;
    return matter;
}

Result<GameWorld> GameWorld::create(const ScenePlan& plan, const Host& host) {
    Result<World> world = World::create(plan.settings, host);
    if (!world.ok()) return Error{world.error()};
    GameWorld game(plan, std::move(world).value());
    if (auto done = game.set_up(); !done.ok()) return Error{done.error()};
    return game;
}

Result<void> GameWorld::set_up() {
    for (const Model& model : plan_->models) {
        Result<ModelId> id = world_.add_model(model);
        if (!id.ok()) return Error{id.error()};
        models_.push_back(*id);
    }
    for (const Prop& prop : plan_->props)
        if (auto id = world_.add_static(view_of(prop.mesh), prop.contact); !id.ok()) return Error{id.error()};
    for (const SphereSettings& ball : plan_->balls) {
        if (auto id = world_.add_sphere(ball); !id.ok()) return Error{id.error()};
        mass_put_in_ += static_cast<double>(ball.mass);
    }
    before_step();  // so that the first picture shows what stands at the start
    if (!refusals_.empty()) return Error{refusals_[0]};
    return {};
}

bool GameWorld::wants_more() const {
    return plan_->fragments_wanted == 0 || measure_matter(world_).fragments < plan_->fragments_wanted;
}

void GameWorld::before_step() {
    while (next_spawn_ < plan_->spawns.size() && plan_->spawns[next_spawn_].frame <= frame_) {
        if (!wants_more()) {
            next_spawn_ = plan_->spawns.size();
            return;
        }
        const Spawn& spawn = plan_->spawns[next_spawn_++];
        SpawnSettings settings = spawn.settings;
        settings.pins = spawn.pins.data();
        settings.pin_count = static_cast<uint32_t>(spawn.pins.size());
        const Result<BodyId> id = world_.spawn(models_[spawn.model], settings);
        if (!id.ok())
            refusals_.push_back(id.error());
        else
            mass_put_in_ += world_.mass(id.value()).value();
    }
}

void GameWorld::after_step() {
    ++frame_;
    const StepEvents step = world_.events();
    events["impact"] += step.impacts.count;
    events["crack_started"] += step.cracks_started.count;
    events["fragment_born"] += step.fragments_born.count;
    events["debris"] += step.debris.count;
    events["refused"] += step.refused.count;
    events["fault"] += step.faults.count;
    events["asleep"] += step.asleep.count;
    for (const RefusedEvent& event : step.refused) ++refused[event.setting];
    for (const FaultEvent& event : step.faults)
        if (faults.size() < kMostFaults)
            faults.push_back(fmt::format("Frame {}, body {}: {}", frame_, event.body.index, event.reason));
    born += step.fragments_born.count;
    broke_ = step.fragments_born.count + step.debris.count + step.cracks_started.count > 0;
    const uint64_t used = world_.report().units_used;
    units_used += used;
    most_units = used > most_units ? used : most_units;
}

void fill_counts(const World& world, Report& report) {
    const WorldData& data = world.contents().data;
    std::apply([&](auto... table) { ((report.tables[(data.state.*table).name()] = (data.state.*table).size()), ...); },
               State::tables());
    const DamageCounts& counts = data.counts;
    report.tasks = {counts.opened, counts.broke, counts.dropped, counts.redone, counts.late, counts.frames_held, 0, 0};
    report.clamped = counts.clamped;
    report.sweeps = data.rigid->counts().sweeps;
    report.units.left = counts.units_left;
    for (size_t k = 0; k < 3; ++k) report.momentum_ns.impulse[k] = counts.impulse_to_static[k];
    report.shapes = {{"sphere", 0}, {"hull", 0}, {"compound", 0}, {"box", 0}, {"triangles", 0}};
    const Bodies& bodies = data.state.bodies;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (is_free(bodies, b)) continue;
        const uint32_t cells = cell_count(data.state, b);
        const bool is_kinematic = bodies.kind[b] == static_cast<uint8_t>(BodyKind::Kinematic);
        ++report.shapes[bodies.is_sphere[b]        ? "sphere"
                        : bodies.shell[b].exists() ? (cells > 1 ? "compound" : "hull")
                        : is_kinematic             ? "box"
                                                   : "triangles"];
    }
}

}  // namespace cullet
