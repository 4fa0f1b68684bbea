// What a hit on a large body costs, system by system, inner loop and rigid engine aside: two vases of the same edge and
// wall, one of 10 and one of 100 thousand elements, hit by the same ball.
#include <algorithm>
#include <cstdio>
#include <map>

#include "engine/fp_mode.hpp"
#include "perf/cook_vase.hpp"
#include "perf/perf.hpp"
#include "systems/world_contents.hpp"

namespace cullet::perf {
namespace {

constexpr float kEdge = 0.006f, kHeight = 0.30f, kFewElements = 10'000, kManyElements = 100'000;
constexpr uint32_t kMostFrames = 60;

/// ms of each system, in the frames from the touch to the end of the hit.
using SystemTimes = std::map<std::string, double>;

struct Hit {
    SystemTimes times;
    uint32_t elements = 0, pieces = 0, hits = 0;
    double local = 0;   // ms, without the inner loop and the rigid engine
    double around = 0;  // of these what opens and closes the task and finds its pieces
};

/// The inner loop, and what only hands bodies to the rigid engine and back.
bool is_local(const std::string& system) {
    for (const char* other : {"advance_runs", "detect_contacts", "solve_rigid", "read_rigid"})
        if (system.find(other) != std::string::npos) return false;
    return true;
}

bool is_around(const std::string& system) {
    for (const char* own : {"take_blows", "predict_impacts", "open_tasks", "widen_regions", "fill_tasks",
                            "fill_stiffness", "start_tasks", "wake_regions", "measure_regions", "lay_regions",
                            "start_regions", "grant_units", "settle_tasks", "close_regions", "find_parts"})
        if (system.find(own) != std::string::npos) return true;
    return false;
}

Hit hit_once(const Model& model, float height, FractureMode mode) {
    Settings settings;
    settings.gravity = {};
    settings.units_a_frame = 1'000'000'000;
    settings.debris_share = 0, settings.debris_elements = 3;  // bodies, not debris
    settings.limits.vertices = 1u << 19, settings.limits.elements = 1u << 20, settings.limits.view_vertices = 1u << 22;
    World world = World::create(settings).value();
    const ModelId id = world.add_model(model).value();
    SpawnSettings spawn;
    spawn.thick_shell.fracture = mode;
    spawn.thick_shell.quick.strain_limit = 0.02f;
    const BodyId body = world.spawn(id, spawn).value();
    Hit hit;
    const auto& d = world.contents().data;
    const Profiler& profiler = world.contents().profiler;
    hit.elements = d.state.shells.elements[d.state.shell_of(d.state.bodies.structure[Row<Bodies>(body.index)])].count;
    SphereSettings ball;
    ball.radius = 0.03f, ball.mass = 0.3f;
    ball.pose.position = {0, 0.43f * height, height};
    ball.motion.velocity = {0, 0, -40};
    (void)world.add_sphere(ball).value();
    for (uint32_t frame = 0; frame < kMostFrames; ++frame) {
        const uint32_t number = profiler.frame_count();
        world.step();
        if (d.counts.opened == 0) continue;
        hit.hits = static_cast<uint32_t>(d.counts.opened);
        hit.pieces += d.told.of<FragmentBornEvent>().size() + d.told.of<DebrisEvent>().size();
        for (uint32_t zone = 0; zone < profiler.zone_count(); ++zone)
            hit.times[profiler.zone_name(zone)] += static_cast<double>(profiler.zone_ms(number, zone));
        if (world.report().open_hits == 0) break;
    }
    return hit;
}

/// Least time of each system: every round does the same work.
Hit hit_often(const Model& model, float height, FractureMode mode, uint32_t rounds) {
    Hit least = hit_once(model, height, mode);
    for (uint32_t round = 1; round < rounds; ++round) {
        const Hit next = hit_once(model, height, mode);
        for (auto& [system, ms] : least.times) ms = std::min(ms, next.times.at(system));
    }
    for (const auto& [system, ms] : least.times)
        if (is_local(system)) least.local += ms, least.around += is_around(system) ? ms : 0;
    return least;
}

/// False: one of the hits freed nothing.
bool compare_sizes(const char* name, const Model* models, const float* heights, FractureMode mode, uint32_t rounds,
                   Figures& figures) {
    const Hit few = hit_often(models[0], heights[0], mode, rounds);
    const Hit many = hit_often(models[1], heights[1], mode, rounds);
    const std::string prefix = std::string(name) + ": ";
    figures.add(prefix + "elements of the small body", few.elements, "");
    figures.add(prefix + "elements of the large body", many.elements, "");
    figures.add(prefix + "pieces of the small body", few.pieces, "");
    figures.add(prefix + "pieces of the large body", many.pieces, "");
    figures.add(prefix + "tasks", few.hits + many.hits, "");
    for (const auto& [system, ms] : many.times)
        if (ms > 0.02) figures.add_ratio(prefix + system, ms, few.times.at(system), "ms");
    figures.add_ratio(prefix + "opening and closing the hit, finding the pieces", many.around, few.around, "ms", 1.5);
    figures.add_ratio(prefix + "all but the inner loop and the rigid engine", many.local, few.local, "ms", 1.5);
    return few.pieces > 1 && many.pieces > 1;
}

}  // namespace

bool measure_local_hit(const Options& options, Figures& figures) {
    const FpMode mode;
    const float heights[2] = {kHeight, kHeight * std::sqrt(kManyElements / kFewElements)};
    // Fine: cracks of large fracture run along half of the body, so that its hits are not local.
    const Result<Model> small = cook_vase(kEdge, heights[0], FractureKind::Fine),
                        large = cook_vase(kEdge, heights[1], FractureKind::Fine);
    if (!small.ok() || !large.ok()) {
        std::printf("%s\n", (small.ok() ? large : small).error().c_str());
        return false;
    }
    const Model models[2] = {small.value(), large.value()};
    const uint32_t rounds = options.rounds_of_a_pass(9);
    bool is_good = compare_sizes("quick", models, heights, FractureMode::Quick, rounds, figures);
    is_good &= compare_sizes("hidden", models, heights, FractureMode::Hidden, std::min(rounds, 3u), figures);
    return is_good;
}

}  // namespace cullet::perf
