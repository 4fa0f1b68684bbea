// The quick mode at a castle of 11,000 vertices and 22,000 triangles: what frames that worked on hits cost, without the
// rigid step, in substeps of the bare spring kernel on the whole mesh with two threads.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <thread>

#include "engine/fp_mode.hpp"
#include "perf/perf.hpp"
#include "perf/springs.hpp"
#include "sample_game/meshes.hpp"
#include "sample_game/props.hpp"
#include "sample_game/run_scene.hpp"
#include "systems/cook/model_contents.hpp"

namespace cullet::perf {
namespace {

constexpr uint32_t kStepsARound = 20;
/// What two threads make of one, of the bare kernel, at most: seen 1.62 and 0.84 ns a spring. On a busy machine the
/// shared substep takes far longer than that, and no limit may grow by it.
constexpr double kTwoThreads = 1.9;

/// Every edge of the castle as it is cooked, whose order keeps neighbours near each other.
SpringNet castle_net() {
    const Mesh mesh = make_castle(3, 11'000);
    CookSettings settings;
    settings.thickness = 0.025f;
    settings.longest_edge = 100;
    settings.thick_shell.measures_threshold = false;
    Result<Model> model = cook(view_of(mesh), settings);
    SpringNet net;
    if (!model.ok()) return net;
    const Workbench& state = model->contents->state;
    const Range vertices = state.shells.vertices[state.shell_of(model->contents->shell)];
    const Range elements = state.shells.elements[state.shell_of(model->contents->shell)];
    for (uint32_t v = 0; v < vertices.count; ++v) net.points.push_back(state.vertices.rest[vertices.first + v]);
    for (uint32_t e = 0; e < elements.count; ++e)
        for (size_t k = 0; k < 3; ++k) {
            const auto& corner = state.elements.corner[elements.first + e];
            const uint32_t a = corner[k], b = corner[(k + 1) % 3];
            net.springs.push_back({std::min(a, b), std::max(a, b)});
        }
    std::sort(net.springs.begin(), net.springs.end());
    net.springs.erase(std::unique(net.springs.begin(), net.springs.end()), net.springs.end());
    net.mass = 1e-2f;
    net.stiffness = 100;
    net.dt = 0.1f * std::sqrt(net.mass / net.stiffness);
    net.damping = 0.1f * net.stiffness * net.dt;
    return net;
}

/// ms, one thread.
double time_substep(const SpringNet& net, uint32_t rounds) {
    const FpMode mode;
    BareSprings bare(net, net.points);
    double least = 1e9;
    for (uint32_t round = 0; round < rounds; ++round)
        least = std::min(least, 1e3 / kStepsARound * seconds([&] {
                                    for (uint32_t i = 0; i < kStepsARound; ++i) bare.step();
                                }));
    return least;
}

/// ms, two threads: each has half of the packs, and they wait for each other behind each substep.
double time_shared_substep(const SpringNet& net, uint32_t rounds) {
    BareSprings bare(net, net.points);
    const uint32_t half = bare.pack_count() / 2;
    std::atomic<uint32_t> arrived{0};
    const auto step = [&](uint32_t number, uint32_t first, uint32_t end) {
        bare.step_packs(number & 1, first, end);
        ++arrived;
        while (arrived.load() < 2 * (number + 1)) __builtin_ia32_pause();
    };
    std::thread other([&] {
        const FpMode mode;
        for (uint32_t i = 0; i < rounds * kStepsARound; ++i) step(i, half, bare.pack_count());
    });
    const FpMode mode;
    double least = 1e9;
    uint32_t number = 0;
    for (uint32_t round = 0; round < rounds; ++round)
        least = std::min(least, 1e3 / kStepsARound * seconds([&] {
                                    for (uint32_t i = 0; i < kStepsARound; ++i) step(number++, 0, half);
                                }));
    other.join();
    return least;
}

bool measure_kind(const char* kind, uint32_t layers, double substep_ms, const Options& options, Figures& figures) {
    const Scene& scene = *find_scene("castle");
    RunOptions run;
    run.scene = "castle";
    run.threads = 2;
    run.repeat = options.rounds_of_a_pass(9);
    run.hash = HashWhen::Last;
    run.frames = 120;
    run.set = {std::string("scene.cracks=") + kind, "scene.layers=" + std::to_string(layers)};
    const Result<Report> played = play(plan_scene(scene, run), run);
    if (!played.ok()) {
        std::printf("%s\n", played.error().c_str());
        return false;
    }
    const Report& r = played.value();
    const auto budget = r.yardsticks.find("budget_ms");
    if (budget == r.yardsticks.end()) return false;
    if (r.damage_frames.count == 0 || r.fragments.born + r.fragments.debris == 0) {
        std::printf("quick: %s, %u layers: nothing came off, so there is nothing to measure\n", kind, layers);
        return false;
    }
    const std::string prefix = std::string(kind) + (layers == 1 ? ", one layer: " : ", two layers: ");
    const double alone = r.damage_frames.p99_budgets * budget->second;
    figures.add(prefix + "frames that worked on hits, p99 without the rigid step, in bare substeps", alone / substep_ms,
                "substeps", layers == 1 ? 100 : 250);
    figures.add(prefix + "the same", alone, "ms");
    figures.add(prefix + "with the rigid step", static_cast<double>(r.damage_frames.p99_ms), "ms");
    figures.add(prefix + "frames that worked on hits", static_cast<double>(r.damage_frames.count), "");
    figures.add(prefix + "hits", static_cast<double>(r.tasks.opened), "");
    figures.add(prefix + "frames that hits were held", static_cast<double>(r.tasks.frames_held), "");
    figures.add(prefix + "hits decided after the hold", static_cast<double>(r.tasks.late), "");
    figures.add(prefix + "live fragments", static_cast<double>(r.fragments.live), "", 300);
    for (const auto& [system, spread] : r.systems)
        if (spread.max > 0.1 * alone)
            figures.add(prefix + system + ", worst frame", static_cast<double>(spread.max), "ms");
    return r.repeats_agree;
}

}  // namespace

bool measure_quick(const Options& options, Figures& figures) {
    if (!BareSprings::is_supported()) {
        std::printf("quick: the bare kernel needs AVX2; nothing is measured\n");
        return true;
    }
    const SpringNet net = castle_net();
    if (net.springs.empty()) return false;
    const uint32_t rounds = options.rounds_of_a_pass(90);
    const double alone = time_substep(net, rounds), shared = time_shared_substep(net, rounds);
    const double substep = std::min(shared, alone / kTwoThreads);
    figures.add("springs of the castle", static_cast<double>(net.springs.size()), "");
    figures.add("bare substep, one thread", alone, "ms");
    figures.add("bare substep, shared by two threads", shared, "ms");
    figures.add("bare substep, the less of that and one thread over 1.9", substep, "ms");
    bool is_good = true;
    for (const uint32_t layers : {1u, 2u})
        for (const char* kind : {"fine", "coarse", "large"})
            is_good &= measure_kind(kind, layers, substep, options, figures);
    return is_good;
}

}  // namespace cullet::perf
