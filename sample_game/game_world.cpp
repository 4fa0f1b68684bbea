#include "sample_game/game_world.hpp"

#include <algorithm>
#include <tuple>

#include "components/state.hpp"
#include "sample_game/script/script.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

bool is_dynamic(const Bodies& bodies, uint32_t b) {
    return bodies.kind[b] == static_cast<uint8_t>(BodyKind::Dynamic);
}

bool is_free(const Bodies& bodies, uint32_t b) {
    return bodies.kind[b] == static_cast<uint8_t>(BodyKind::Free);
}

uint32_t cell_count(const State& state, uint32_t body) {
    const Row<Structures> shell = state.bodies.structure[body];
    return shell.exists() ? state.structures.cells[shell].count : 0;
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

const char* kind_of_shape(const State& state, uint32_t b) {
    const Bodies& bodies = state.bodies;
    if (bodies.is_sphere[b]) return "sphere";
    if (!bodies.structure[b].exists())
        return bodies.kind[b] == static_cast<uint8_t>(BodyKind::Kinematic) ? "box" : "triangles";
    const auto shape = static_cast<ShapeKind>(state.structures.shape[bodies.structure[b]]);
    if (shape != ShapeKind::Cells) return shape == ShapeKind::Box ? "box" : "hull";
    return cell_count(state, b) > 1 ? "compound" : "hull";
}

FragmentShapes::Ratio ratio_of(std::vector<float> ratios) {
    if (ratios.empty()) return {};
    std::sort(ratios.begin(), ratios.end());
    const auto at = [&](size_t k) { return static_cast<double>(ratios[k]); };
    return {at(0), at(ratios.size() / 2), at(ratios.size() - 1)};
}

// A piece, or what pieces came off; one that was measured has both ratios.
void count_shapes(const State& state, Report& report) {
    static constexpr const char* kKinds[] = {"cells", "hull", "box"};  // ShapeKind
    const Bodies& bodies = state.bodies;
    const Structures& structures = state.structures;
    std::vector<float> boxes[3], hulls[3];
    report.shapes = {{"sphere", 0}, {"hull", 0}, {"compound", 0}, {"box", 0}, {"triangles", 0}};
    for (const char* kind : kKinds) report.fragment_shapes[kind] = {};
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (is_free(bodies, b)) continue;
        ++report.shapes[kind_of_shape(state, b)];
        const Row<Structures> shell = bodies.structure[b];
        if (!shell.exists() || (!bodies.parent[b].exists() && !(structures.hull_ratio[shell] > 0))) continue;
        const size_t kind = structures.shape[shell];
        ++report.fragment_shapes[kKinds[kind]].count;
        if (!(structures.hull_ratio[shell] > 0)) continue;
        boxes[kind].push_back(structures.box_ratio[shell]);
        hulls[kind].push_back(structures.hull_ratio[shell]);
    }
    for (size_t kind = 0; kind < 3; ++kind) {
        FragmentShapes& found = report.fragment_shapes[kKinds[kind]];
        found.measured = hulls[kind].size();
        found.box_ratio = ratio_of(boxes[kind]);
        found.hull_ratio = ratio_of(hulls[kind]);
    }
}

}  // namespace

Matter measure_matter(const World& world) {
    const State& state = world.contents().data.state;
    const Bodies& bodies = state.bodies;
    Matter matter;
    for (uint32_t b = 0; b < bodies.size(); ++b) {
        if (is_free(bodies, b)) continue;
        const bool has_shell = bodies.structure[b].exists();
        if (!has_shell && !is_dynamic(bodies, b)) continue;
        matter.mass += bodies.mass[b];
        matter.fragments += born_of(state.fragment_ages, b) > 0;
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

GameWorld::GameWorld(std::unique_ptr<Stage> stage, std::unique_ptr<Script> script)
    : stage_(std::move(stage)), script_(std::move(script)) {}
GameWorld::GameWorld(GameWorld&&) noexcept = default;
GameWorld::~GameWorld() = default;

Result<GameWorld> GameWorld::create(const ScenePlan& plan, const Host& host) {
    auto stage = std::make_unique<Stage>();
    stage->plan = plan;
    stage->host = host;
    if (!plan.materials_path.empty())
        if (const Result<void> read = stage->read_materials(plan.materials_path); !read.ok())
            return Error{read.error()};
    auto script = std::make_unique<Script>(*stage);
    if (auto done = script->start(); !done.ok()) return Error{done.error()};
    if (const Result<World*> stands = stage->stand(); !stands.ok()) return Error{stands.error()};
    return GameWorld(std::move(stage), std::move(script));
}

void GameWorld::take(const Result<void>& done) {
    if (!done.ok() && failure_.empty()) failure_ = done.error();
}

void GameWorld::before_step() {
    if (failure_.empty()) take(script_->go_on());
}

void GameWorld::after_step() {
    stage_->after_step();
    if (failure_.empty()) take(script_->tell_events());
}

std::string GameWorld::waits_at() const {
    return script_->waits_at();
}

void fill_counts(const World& world, Report& report) {
    const WorldData& data = world.contents().data;
    data.state.for_each_table([&](const AnyTable& table) { report.tables[table.name()] = table.size(); });
    const DamageCounts& counts = data.counts;
    report.tasks = {counts.opened,       counts.broke,       counts.dropped,    counts.redone,
                    counts.late,         counts.frames_held, counts.ahead_hits, counts.ahead_misses,
                    counts.first_breaks, counts.first_ready};
    report.clamped = counts.clamped;
    report.crushed_j = counts.crushing_energy;
    report.sweeps = data.rigid->counts().sweeps;
    report.units.left = counts.units_left;
    report.units.slow_soft_frames = counts.slow_soft_frames;
    const SoftBodies& soft = data.state.soft_bodies;
    for (uint32_t s = 0; s < soft.size(); ++s)
        if (soft.is_used[s]) report.units.softening = std::max(report.units.softening, double{soft.softening[s]});
    for (size_t k = 0; k < 3; ++k) report.momentum_ns.impulse[k] = counts.impulse_to_static[k];
    count_shapes(data.state, report);
}

}  // namespace cullet
