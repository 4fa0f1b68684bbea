#include "sample_game/run_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

#include "engine/hash.hpp"
#include "sample_game/allocations.hpp"
#include "sample_game/drawn_meshes.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/pictures.hpp"
#include "sample_game/progress.hpp"
#include "sample_game/rest.hpp"
#include "sample_game/yardsticks.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

uint32_t hardware_threads() {
    return std::clamp(std::thread::hardware_concurrency(), 1u, 64u);
}

void watch_tables(World& world, RunRecord& record, const uint64_t& frame) {
    world.contents().after_each_system = [&world, &record, &frame,
                                          drawn = DrawnMeshes()](const PlannedSystem<WorldData>& system) mutable {
        if (!record.first_fault.empty()) return;
        std::string fault = world.contents().data.state.validate();
        if (fault.empty() && std::string_view(system.name) == "draw_shells") fault = drawn.check_changed(world);
        if (!fault.empty()) record.first_fault = fmt::format("after {}, frame {}: {}", system.name, frame, fault);
    };
}

void step_counted(GameWorld& game, bool counts, RunRecord& record) {
    if (!counts) return game.step();
    start_counting_allocations();
    game.step();
    const AllocationCounts found = stop_counting_allocations();
    record.allocations += found.ours;
    record.rigid_allocations += found.rigid;
}

void take_times(const Profiler& profiler, RunRecord& record) {
    const uint32_t frames = profiler.frame_count();
    record.zone_ms.resize(profiler.zone_count());
    for (uint32_t n = 0; n < frames; ++n) record.frame_ms.push_back(profiler.frame_ms(n));
    for (uint32_t zone = 0; zone < profiler.zone_count(); ++zone) {
        record.zone_names.push_back(profiler.zone_name(zone));
        record.zone_rows.push_back(profiler.zone_rows(zone));
        for (uint32_t n = 0; n < frames; ++n) record.zone_ms[zone].push_back(profiler.zone_ms(n, zone));
    }
}

/// One run from the first frame to the last. Fills the report's sums, which are the same for each run.
Result<RunRecord> play_once(const Scene& scene, const ScenePlan& plan, const RunOptions& options, uint32_t repeat,
                            Report& report) {
    Result<GameWorld> made = GameWorld::create(plan);
    if (!made.ok()) return Error{made.error()};
    GameWorld& game = made.value();
    RunRecord record;
    uint64_t frame = 0;
    if (options.validates) watch_tables(game.world(), record, frame);
    const uint32_t frames = frame_count(scene, options);
    Pictures pictures(scene, plan, options, frames);
    const Matter start = measure_matter(game.world());
    report.energy_j.peak = start.kinetic_energy;
    Progress progress(options.repeat > 1 ? fmt::format("{}, {} of {}", scene.name, repeat + 1, options.repeat)
                                         : scene.name);
    for (frame = 0; frame < frames; ++frame) {
        if (repeat == 0)
            if (auto drawn = pictures.take(game); !drawn.ok()) return Error{drawn.error()};
        game.before_step();
        step_counted(game, frame >= kFirstCountedFrame && !options.validates, record);
        game.after_step();
        record.broke.push_back(game.broke());
        record.has_damage.push_back(game.world().report().units_used > 0);
        if (options.hash == HashWhen::Every) record.hashes.push_back(game.world().hash());
        report.energy_j.peak = std::max(report.energy_j.peak, measure_matter(game.world()).kinetic_energy);
        progress.show(static_cast<double>(frame + 1) / frames,
                      fmt::format("{} bodies, {} awake", game.world().report().bodies, game.world().report().awake));
    }
    if (repeat == 0) {
        if (auto drawn = pictures.take(game); !drawn.ok()) return Error{drawn.error()};
        if (auto sheet = pictures.finish(); !sheet.ok()) return Error{sheet.error()};
    }
    if (options.hash != HashWhen::Off) record.last_hash = game.world().hash();
    take_times(game.world().contents().profiler, record);
    game.world().contents().after_each_system = nullptr;
    if (!options.trace.empty() && repeat + 1 == options.repeat)
        if (auto written = game.world().contents().profiler.write_trace(options.trace); !written.ok())
            return Error{written.error()};
    if (repeat > 0) return record;

    const Matter end = measure_matter(game.world());
    report.mass_kg = {game.mass_put_in(), end.mass, end.debris_mass};
    report.momentum_ns.start = start.momentum;
    report.momentum_ns.end = end.momentum;
    report.energy_j.start = start.kinetic_energy;
    report.energy_j.end = end.kinetic_energy;
    report.fragments = {game.born, end.fragments, end.asleep, game.world().report().debris};
    report.awake = {end.awake, end.awake_cells};
    report.rest = measure_rest(game, report.energy_j.peak);
    report.events = game.events;
    report.refused = game.refused;
    report.faults = game.events["fault"];
    report.fault_list = game.faults;
    report.notes.insert(report.notes.end(), game.refusals().begin(), game.refusals().end());
    report.units.used = game.units_used;
    report.units.most = game.most_units;
    fill_counts(game.world(), report);
    return record;
}

/// Least time of each frame of two runs. Empty, or a sentence when the runs were not the same.
std::string fold(RunRecord& into, const RunRecord& other, uint32_t repeat) {
    for (size_t f = 0; f < into.frame_ms.size(); ++f) into.frame_ms[f] = std::min(into.frame_ms[f], other.frame_ms[f]);
    for (size_t z = 0; z < into.zone_ms.size(); ++z)
        for (size_t f = 0; f < into.zone_ms[z].size(); ++f)
            into.zone_ms[z][f] = std::min(into.zone_ms[z][f], other.zone_ms[z][f]);
    into.allocations = std::max(into.allocations, other.allocations);
    into.rigid_allocations = std::max(into.rigid_allocations, other.rigid_allocations);
    for (size_t f = 0; f < into.hashes.size(); ++f)
        if (into.hashes[f] != other.hashes[f])
            return fmt::format("Run {} is not run 1: the state differs from frame {} on.", repeat + 1, f);
    if (into.last_hash != other.last_hash)
        return fmt::format("Run {} is not run 1: the state differs after the last frame.", repeat + 1);
    return "";
}

/// Of each frame, ms: what the rigid world took.
std::vector<float> rigid_times(const RunRecord& record) {
    std::vector<float> sum(record.frame_ms.size());
    for (size_t z = 0; z < record.zone_names.size(); ++z)
        if (record.zone_names[z] == "detect_contacts" || record.zone_names[z] == "solve_rigid")
            for (size_t f = 0; f < sum.size(); ++f) sum[f] += record.zone_ms[z][f];
    return sum;
}

void fill_times(const ScenePlan& plan, const RunRecord& record, Report& report) {
    report.frame_ms = spread_of(record.frame_ms);
    for (size_t z = 0; z < record.zone_names.size(); ++z)
        report.systems[record.zone_names[z]] = spread_of(record.zone_ms[z], record.zone_rows[z]);
    const std::vector<float> rigid = rigid_times(record);
    std::vector<float> broke, quiet, damage, damage_alone;
    for (size_t f = 0; f < record.frame_ms.size(); ++f) {
        if (record.broke[f]) broke.push_back(record.frame_ms[f]);
        if (record.has_damage[f]) damage.push_back(record.frame_ms[f]);
        if (record.has_damage[f]) damage_alone.push_back(record.frame_ms[f] - rigid[f]);
        if (!record.broke[f] && !record.has_damage[f]) quiet.push_back(record.frame_ms[f]);
    }
    report.fracture_frames = {broke.size(), percentile(broke, 0.5), percentile(broke, 0.99), percentile(broke, 1)};
    report.damage_frames = {damage.size(), percentile(damage, 0.5), percentile(damage, 0.99), percentile(damage, 1), 0};
    if (!plan.models.empty()) report.yardsticks = measure_yardsticks(plan.models[0]);
    const double budget_ms =
        1e-6 * static_cast<double>(plan.settings.units_a_frame) * report.yardsticks["unit_ns"] / plan.settings.threads;
    report.yardsticks["budget_ms"] = budget_ms;
    if (budget_ms > 0)
        report.damage_frames.p99_budgets = static_cast<double>(percentile(damage_alone, 0.99)) / budget_ms;
    report.hitch =
        static_cast<double>(report.fracture_frames.max_ms) / (static_cast<double>(percentile(quiet, 0.5)) + budget_ms);
}

void fill_hashes(const RunRecord& record, HashWhen when, Report& report) {
    if (when == HashWhen::Off) return;
    report.hash = fmt::format("{:016x}", record.last_hash);
    uint64_t chain = 0;
    for (const uint64_t hash : record.hashes) chain = hash_bytes(&hash, sizeof hash, chain);
    if (when == HashWhen::Every) report.hash_chain = fmt::format("{:016x}", chain);
}

}  // namespace

uint32_t frame_count(const Scene& scene, const RunOptions& options) {
    if (options.frames > 0) return options.frames;
    return static_cast<uint32_t>(std::lround(scene.frames * (1000.0 / 60) / options.dt_ms));
}

Result<Keys> keys_of(const Scene& scene, const RunOptions& options) {
    Keys keys = scene.keys();
    const auto set = [&keys](const std::string& assignment) { return keys.set(assignment); };
    if (auto done = set(fmt::format("threads={}", hardware_threads())); !done.ok()) return Error{done.error()};
    for (const std::string& assignment : options.set)
        if (auto done = set(assignment); !done.ok()) return Error{done.error()};
    if (options.threads > 0)
        if (auto done = set(fmt::format("threads={}", options.threads)); !done.ok()) return Error{done.error()};
    return keys;
}

Result<ScenePlan> plan_scene(const Scene& scene, const Keys& keys, const RunOptions& options) {
    Progress progress(fmt::format("{}: cooking", scene.name));
    return scene.plan({keys, options.mesh, static_cast<float>(0.001 * options.dt_ms), &Progress::cooked, &progress});
}

Result<Report> play(const Scene& scene, const ScenePlan& plan, const RunOptions& options) {
    Report report;
    report.scene = scene.name;
    report.seed = plan.seed;
    report.dt_s = static_cast<double>(plan.settings.step_seconds);
    report.frames = frame_count(scene, options);
    report.threads = plan.settings.threads;
    report.machine = describe_machine();
    report.repeats = options.repeat;
    report.notes = plan.notes;
    RunRecord record;
    for (uint32_t repeat = 0; repeat < options.repeat; ++repeat) {
        Result<RunRecord> played = play_once(scene, plan, options, repeat, report);
        if (!played.ok()) return Error{played.error()};
        if (!played->first_fault.empty()) return Error{played->first_fault};
        if (repeat == 0) {
            record = std::move(played).value();
        } else if (const std::string difference = fold(record, played.value(), repeat); !difference.empty()) {
            report.repeats_agree = false;
            report.notes.push_back(difference);
        }
    }
    report.allocations_in_frames = record.allocations;
    report.allocations_in_rigid = record.rigid_allocations;
    fill_hashes(record, options.hash, report);
    fill_times(plan, record, report);
    report.peak_rss_bytes = peak_resident_bytes();
    return report;
}

}  // namespace cullet
