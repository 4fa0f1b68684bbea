#include <algorithm>
#include <cstdio>

#include "perf/perf.hpp"
#include "sample_game/run_scene.hpp"

namespace cullet::perf {
namespace {

/// Least time of each frame of `repeat` runs.
bool measure_scene(const char* name, unsigned threads, uint32_t repeat, Figures& figures) {
    const Scene& scene = *find_scene(name);
    RunOptions options;
    options.scene = name;
    options.threads = threads;
    options.repeat = repeat;
    options.hash = HashWhen::Last;
    const Result<Report> played = play(plan_scene(scene, options), options);
    if (!played.ok()) {
        std::printf("%s\n", played.error().c_str());
        return false;
    }
    const Report& r = played.value();
    const std::string prefix =
        std::string(name) + ", " + std::to_string(threads) + " thread" + (threads == 1 ? ": " : "s: ");
    figures.add(prefix + "frame, p50", static_cast<double>(r.frame_ms.p50), "ms");
    figures.add(prefix + "frame, p99", static_cast<double>(r.frame_ms.p99), "ms");
    figures.add(prefix + "frame, worst", static_cast<double>(r.frame_ms.max), "ms");
    const auto yardstick = [&](const char* key) {
        const auto at = r.yardsticks.find(key);
        return at == r.yardsticks.end() ? 0.0 : at->second;
    };
    figures.add(prefix + "a unit", yardstick("unit_ns"), "ns");
    figures.add(prefix + "the budget as time", yardstick("budget_ms"), "ms");
    figures.add(prefix + "frames that broke something, p99", static_cast<double>(r.fracture_frames.p99_ms), "ms");
    const std::string scene_name = name;
    const bool is_pile = scene_name == "pile", has_many = is_pile || scene_name == "demolition";
    figures.add(prefix + "frames that worked on hits, p99 without the rigid step", r.damage_frames.p99_budgets,
                "budgets", has_many ? 0 : 1.25);
    figures.add(prefix + "hitch", r.hitch, "x", is_pile ? 0 : 2);
    figures.add(prefix + "hits", static_cast<double>(r.tasks.opened), "");
    figures.add(prefix + "hits decided after the hold", static_cast<double>(r.tasks.late), "");
    const double first = std::max(1.0, static_cast<double>(r.tasks.first_breaks));
    figures.add(prefix + "first breaks by touch that were not ready at the touch",
                100 - 100 * static_cast<double>(r.tasks.first_ready) / first, "%", is_pile ? 0 : 20);
    figures.add(prefix + "frames held", static_cast<double>(r.tasks.frames_held), "");
    double total = 0;
    for (const auto& [system, spread] : r.systems) total += spread.total;
    for (const auto& [system, spread] : r.systems)
        if (spread.total > 0.01 * total) figures.add(prefix + system + ", share", 100 * spread.total / total, "%");
    return r.repeats_agree;
}

bool measure_scene(const char* name, const Options& options, uint32_t repeat, Figures& figures) {
    bool is_good = true;
    for (const unsigned threads : options.threads)
        is_good &= measure_scene(name, threads, options.rounds_of_a_pass(repeat), figures);
    return is_good;
}

}  // namespace

bool measure_vase_frames(const Options& options, Figures& figures) {
    return measure_scene("vase", options, 3, figures);
}
bool measure_wall_frames(const Options& options, Figures& figures) {
    return measure_scene("wall", options, 3, figures);
}
bool measure_solid_frames(const Options& options, Figures& figures) {
    bool is_good = true;
    for (const char* scene : {"statue", "table", "bowl", "museum"})
        is_good &= measure_scene(scene, options, 3, figures);
    return is_good;
}
bool measure_pane_frames(const Options& options, Figures& figures) {
    return measure_scene("pane", options, 3, figures);
}
bool measure_demolition_frames(const Options& options, Figures& figures) {
    return measure_scene("demolition", options, 3, figures);
}
bool measure_pile_frames(const Options& options, Figures& figures) {
    return measure_scene("pile", options, 1, figures);  // minutes
}

}  // namespace cullet::perf
