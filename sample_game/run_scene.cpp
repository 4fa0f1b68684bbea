#include "sample_game/run_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/hash.hpp"
#include "sample_game/allocations.hpp"
#include "sample_game/drawn_meshes.hpp"
#include "sample_game/game_world.hpp"
#include "sample_game/model_shelf.hpp"
#include "sample_game/pictures.hpp"
#include "sample_game/progress.hpp"
#include "sample_game/rest.hpp"
#include "sample_game/yardsticks.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

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

/// What the world has counted since it was made.
FrameFacts facts_so_far(GameWorld& game) {
    const DamageCounts& counts = game.world().contents().data.counts;
    const RunSums& sums = game.sums();
    FrameFacts facts;
    facts.opened = counts.opened;
    facts.broke = counts.broke;
    facts.late = counts.late;
    facts.frames_held = counts.frames_held;
    facts.born = sums.born;
    facts.units = sums.units_used;
    for (const auto& [name, count] : sums.events) {
        if (name == "debris") facts.debris = count;
        if (name == "refused") facts.refused = count;
    }
    return facts;
}

/// What a script still waits for when its own length is over was never looked at: that is no success.
Result<void> check_end(const GameWorld& game, const RunOptions& options, uint32_t frames, Report& report) {
    const std::string place = game.waits_at();
    if (place.empty()) return {};
    const std::string sentence =
        fmt::format("{}: the script still waits here when the run ends after {} frames", place, frames);
    if (options.frames == 0) return Error{sentence + "; give game.scene{seconds = ...} or --frames more."};
    if (report.notes.empty() || report.notes.back() != sentence + ".") report.notes.push_back(sentence + ".");
    return {};
}

void fill_run(const GameWorld& game, const ScenePlan& plan, const RunOptions& options, Report& report) {
    const Stage& stage = game.stage();
    const Settings settings = stage.settings();
    report.scene = plan.scene.name;
    report.seed = stage.seed();
    report.dt_s = static_cast<double>(settings.step_seconds);
    report.frames = frame_count(stage.story, options);
    report.threads = settings.threads;
}

void fill_sums(GameWorld& game, const Matter& start, Report& report) {
    const Matter end = measure_matter(game.world());
    report.mass_kg = {game.mass_put_in(), end.mass, end.debris_mass};
    report.momentum_ns.start = start.momentum;
    report.momentum_ns.end = end.momentum;
    report.energy_j.start = start.kinetic_energy;
    report.energy_j.end = end.kinetic_energy;
    const StepReport last = game.world().report();
    report.fragments = {game.sums().born, end.fragments, end.asleep, last.debris, last.retired, last.faded};
    report.awake = {end.awake, end.awake_cells};
    report.rest = measure_rest(game, report.energy_j.peak);
    report.events = game.sums().events;
    report.refused = game.sums().refused;
    report.faults = game.sums().events["fault"];
    report.fault_list = game.sums().faults;
    report.notes.insert(report.notes.end(), game.stage().notes.begin(), game.stage().notes.end());
    if (const uint64_t squeezed = game.sums().events["squeezed"]; squeezed == 1)
        report.notes.push_back(game.sums().squeezed + ".");
    else if (squeezed > 1)
        report.notes.push_back(fmt::format("{}, the first of {}.", game.sums().squeezed, squeezed));
    report.units.used = game.sums().units_used;
    report.units.most = game.sums().most_units;
    if (!game.stage().models.empty()) report.yardsticks = measure_yardsticks(game.stage().models[0].model);
    fill_counts(game.world(), report);
}

/// One run from the first frame to the last. Fills the report's sums, which are the same for each run.
Result<RunRecord> play_once(const ScenePlan& plan, const RunOptions& options, uint32_t repeat, Report& report) {
    ScenePlan own = plan;
    own.record = repeat == 0 ? options.record : "";
    own.is_silent = repeat > 0;
    Result<GameWorld> made = GameWorld::create(own);
    if (!made.ok()) return Error{made.error()};
    GameWorld& game = made.value();
    fill_run(game, plan, options, report);
    RunRecord record;
    record.settings = game.stage().settings();
    uint64_t frame = 0;
    if (options.validates) watch_tables(game.world(), record, frame);
    const auto frames = static_cast<uint32_t>(report.frames);
    Pictures pictures(game.stage().story, report.threads, options, frames);
    const Matter start = measure_matter(game.world());
    report.energy_j.peak = start.kinetic_energy;
    Progress progress(options.repeat > 1 ? fmt::format("{}, {} of {}", report.scene, repeat + 1, options.repeat)
                                         : report.scene);
    for (frame = 0; frame < frames; ++frame) {
        if (repeat == 0)
            if (auto drawn = pictures.take(game); !drawn.ok()) return Error{drawn.error()};
        game.before_step();
        if (!game.failure().empty()) return Error{game.failure()};
        const FrameFacts before = facts_so_far(game);
        step_counted(game, frame >= kFirstCountedFrame && !options.validates, record);
        game.after_step();
        record.facts.push_back(facts_so_far(game) - before);
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
    const Profiler& profiler = game.world().contents().profiler;
    take_times(profiler, record);
    game.world().contents().after_each_system = nullptr;
    if (!options.trace.empty() && repeat + 1 == options.repeat) {
        if (auto written = profiler.write_trace(options.trace); !written.ok()) return Error{written.error()};
        if (profiler.left_out() > 0)
            report.notes.push_back(fmt::format("{}: the last {} spans and counters found no room; trace fewer frames.",
                                               options.trace, profiler.left_out()));
    }
    if (repeat == 0) fill_sums(game, start, report);
    if (repeat == 0 && profiler.frame_count() < frames)
        report.notes.push_back(
            fmt::format("Times are those of the first {} frames and of the last one.", profiler.frame_count() - 1));
    game.before_step();  // what the script does at the very end: its last expectations
    if (!game.failure().empty()) return Error{game.failure()};
    if (auto ended = check_end(game, options, frames, report); !ended.ok()) return Error{ended.error()};
    if (auto stopped = game.world().stop_recording(); !stopped.ok())
        return Error{options.record + ": " + stopped.error()};
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

void fill_times(const RunRecord& record, Report& report) {
    report.frame_ms = spread_of(record.frame_ms);
    report.each_frame_ms = record.frame_ms;
    report.each_frame_broke.assign(record.broke.begin(), record.broke.end());
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
    const double budget_ms = 1e-6 * static_cast<double>(record.settings.units_a_frame) * report.yardsticks["unit_ns"] /
                             record.settings.threads;
    report.yardsticks["budget_ms"] = budget_ms;
    if (budget_ms > 0)
        report.damage_frames.p99_budgets = static_cast<double>(percentile(damage_alone, 0.99)) / budget_ms;
    // What dents does so in the frame after it was worked on, or later.
    const auto first = std::find(record.has_damage.begin(), record.has_damage.end(), true) - record.has_damage.begin();
    const float worst = broke.empty() && !damage.empty()
                            ? *std::max_element(record.frame_ms.begin() + first, record.frame_ms.end())
                            : report.fracture_frames.max_ms;
    report.hitch = static_cast<double>(worst) / (static_cast<double>(percentile(quiet, 0.5)) + budget_ms);
}

void fill_worst_frame(const RunRecord& record, Report& report) {
    const auto worst = std::max_element(record.frame_ms.begin(), record.frame_ms.end());
    if (worst == record.frame_ms.end() || record.facts.size() != record.frame_ms.size()) return;
    const auto f = static_cast<size_t>(worst - record.frame_ms.begin());
    report.worst_frame.frame = f;
    report.worst_frame.ms = *worst;
    report.worst_frame.facts = record.facts[f];
    for (size_t z = 0; z < record.zone_names.size(); ++z) {
        if (record.zone_ms[z][f] <= report.worst_frame.system_ms) continue;
        report.worst_frame.system = record.zone_names[z];
        report.worst_frame.system_ms = record.zone_ms[z][f];
    }
}

void fill_hashes(const RunRecord& record, HashWhen when, Report& report) {
    if (when == HashWhen::Off) return;
    report.hash = fmt::format("{:016x}", record.last_hash);
    uint64_t chain = 0;
    for (const uint64_t hash : record.hashes) chain = hash_bytes(&hash, sizeof hash, chain);
    if (when == HashWhen::Every) report.hash_chain = fmt::format("{:016x}", chain);
}

}  // namespace

uint32_t frame_count(const Story& story, const RunOptions& options) {
    if (options.frames > 0) return options.frames;
    return static_cast<uint32_t>(std::max(1l, std::lround(1000 * story.seconds / options.dt_ms)));
}

ScenePlan plan_scene(const Scene& scene, const RunOptions& options) {
    ScenePlan plan;
    plan.scene = scene;
    plan.set = options.set;
    plan.threads = options.threads;
    plan.step_ms = options.dt_ms;
    plan.mesh_path = options.mesh;
    plan.materials_path = options.materials;
    plan.model = options.model;
    plan.shelf = std::make_shared<ModelShelf>();
    return plan;
}

Result<Keys> keys_of(const Scene& scene, const RunOptions& options) {
    Result<Story> story = read_story(plan_scene(scene, options));
    if (!story.ok()) return Error{story.error()};
    return std::move(story->keys);
}

Result<Report> play(const ScenePlan& plan, const RunOptions& options) {
    Report report;
    report.machine = describe_machine();
    report.repeats = options.repeat;
    RunRecord record;
    for (uint32_t repeat = 0; repeat < options.repeat; ++repeat) {
        Result<RunRecord> played = play_once(plan, options, repeat, report);
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
    fill_times(record, report);
    fill_worst_frame(record, report);
    report.peak_rss_bytes = peak_resident_bytes();
    return report;
}

}  // namespace cullet
