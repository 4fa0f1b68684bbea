// The hidden step as the frame runs it on a large body: on a cut-out round the hit, whose border a rigid rest holds.
#include <cstdio>
#include <memory>

#include "engine/fp_mode.hpp"
#include "perf/cook_vase.hpp"
#include "perf/our_step.hpp"
#include "perf/perf.hpp"
#include "perf/turns.hpp"
#include "systems/models/thick_shell/hidden/hidden_region.hpp"
#include "systems/models/thick_shell/run_hit.hpp"

namespace cullet::perf {
namespace {

constexpr float kEdge = 0.00405f, kSmallEdge = 0.0075f;  // m
constexpr float kHeight = 0.89f, kSmallHeight = 0.30f;   // m

/// A ball against the wall, 0.43 of the vase's height up. Task row 0; `region_vertices` 0: the whole shell.
bool open(CookedVase& vase, float height, uint32_t region_vertices) {
    HitDescription hit;
    hit.point = {0, 0.43f * height, 0.35f * height};
    hit.normal = {0, 0, -1};
    hit.striker_speed = 40;
    hit.striker_inverse_mass = 1 / 0.3f;
    hit.striker_radius = 0.03f;
    hit.region_vertices = region_vertices;
    return open_hit(vase.state, vase.shell, hit);
}

struct Sized {
    CookedVase vase;
    OurStep step, step_with_rest;
    uint32_t vertices = 0;

    Sized(const Model& model, float height, uint32_t region_vertices)
        : vase(model), step(vase.state), step_with_rest(vase.state, true) {
        if (!open(vase, height, region_vertices)) return;
        vertices = vase.state.shells.vertices[vase.state.shell_of(vase.state.tasks.working[0])].count;
    }
};

}  // namespace

// The small body moves whole, the large one by its cut-out: both as the frame opens them, in tables of their own.
bool measure_hidden_region_step(const Options& options, Figures& figures) {
    const Result<Model> small_model = cook_vase(kSmallEdge, kSmallHeight),
                        model = cook_vase(kEdge, kHeight, FractureKind::Fine);
    if (!small_model.ok() || !model.ok()) {
        std::printf("%s\n", (small_model.ok() ? model : small_model).error().c_str());
        return false;
    }
    const FpMode mode;
    const auto small = std::make_unique<Sized>(*small_model, kSmallHeight, 0);
    const auto large = std::make_unique<Sized>(*model, kHeight, kWholeCopyVertices);
    if (small->vertices == 0 || large->vertices == 0 || !is_hidden_region(large->vase.state, 0)) {
        std::printf("the hidden step on a cut-out: no room for the hit, or it took the whole body\n");
        return false;
    }
    std::vector<std::unique_ptr<JobSystem>> teams;
    std::vector<Timed> timed;
    for (const unsigned threads : options.threads) {
        teams.push_back(threads > 1 ? make_jobs(JobBackend::Threads, threads) : nullptr);
        JobSystem* const team = teams.back().get();
        const auto steps_of = [](const Sized& body) { return std::max(2u, 100000 / body.vertices) & ~1u; };
        timed.push_back({"", steps_of(*small), [&small, team](uint32_t n) { small->step.run(n, team); }});
        timed.push_back({"", steps_of(*large), [&large, team](uint32_t n) { large->step.run(n, team); }});
        timed.push_back({"", steps_of(*large), [&large, team](uint32_t n) { large->step_with_rest.run(n, team); }});
    }
    take_turns(timed, options.rounds_of_a_pass(200));
    const std::string prefix = "vase of 98,000, as the frame steps it, on a cut-out: ";
    figures.add(prefix + "vertices simulated", large->vertices, "");
    double alone = 0;
    for (size_t t = 0; t < options.threads.size(); ++t) {
        const unsigned threads = options.threads[t];
        const auto each = [&](size_t k, const Sized& body) { return 1e9 * timed[3 * t + k].best / body.vertices; };
        const double of_small = each(0, *small), of_cut_out = each(1, *large), with_rest = each(2, *large);
        const std::string suffix = on_threads(threads);
        figures.add_ratio(prefix + "ours" + suffix + " / a vertex of 3,200", of_cut_out, of_small, "ns a vertex",
                          threads <= 2 ? 1.4 : 0);
        figures.add_ratio(prefix + "with the rest that holds its border" + suffix + " / a vertex of 3,200", with_rest,
                          of_small, "ns a vertex", threads <= 2 ? 1.4 : 0);
        if (threads == 1)
            alone = of_cut_out;
        else if (alone > 0)
            figures.add_ratio(prefix + "1 thread / ours" + suffix, of_cut_out, alone, "ns a vertex", 0, true);
    }
    return true;
}

}  // namespace cullet::perf
