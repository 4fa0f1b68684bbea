#include <algorithm>
#include <cstdio>
#include <memory>

#include "engine/fp_mode.hpp"
#include "engine/jobs.hpp"
#include "engine/random.hpp"
#include "perf/cook_vase.hpp"
#include "perf/hidden_yardsticks.hpp"
#include "perf/our_step.hpp"
#include "perf/perf.hpp"
#include "perf/step_runner.hpp"
#include "perf/stream.hpp"
#include "perf/turns.hpp"
#include "systems/models/thick_shell/hidden/energy.hpp"
#include "systems/models/thick_shell/stiffness/assemble.hpp"
#include "systems/models/thick_shell/stiffness/element_stress.hpp"
#include "systems/models/thick_shell/stiffness/pair_cells.hpp"

namespace cullet::perf {
namespace {

constexpr uint32_t kChunkPacks = 32;  // 256 vertices

void shake(ShellView shell) {
    const Random random{11};
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const auto r = [&](uint64_t k) { return static_cast<float>(1e-6 * (random.uniform(v, k) - 0.5)); };
        const Vec3 u{r(0), r(1), r(2)};
        shell.state.vertices.displacement.set(shell.vertex(v), u);
        shell.state.vertices.velocity.set(shell.vertex(v), {});
        for (int side = 0; side < 2; ++side) shell.state.vertices.probe.set(shell.vertex(v), {u.x, u.y, u.z, 0}, side);
    }
}

void open_task(CookedVase& vase) {
    Tasks& tasks = vase.state.tasks;
    tasks.clear_rows(0, 1);
    tasks.working[0] = vase.shell;
    HiddenRuns& runs = vase.state.hidden_runs;
    runs.clear_rows(0, 1);
    runs.time_step[0] = vase.state.shells.time_step[vase.state.shell_of(vase.shell)];
    runs.damping_time[0] = 0.15f * runs.time_step[0];
    link_slopes(vase.view());
}

/// Largest difference of the places after as many steps of both, as a share of the largest displacement.
double difference(CookedVase& vase, OurStep& ours, float dt, float beta) {
    constexpr uint32_t kSteps = 50;
    const ShellView shell = vase.view();
    shake(shell);
    BareHidden bare(shell, dt, beta);
    for (uint32_t i = 0; i < kSteps; ++i) bare.run_packs(i & 1, 0, bare.pack_count());
    ours.run(kSteps, nullptr);
    double most = 0, farthest = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const Vec3 u = shell.state.vertices.displacement[shell.vertex(v)];
        farthest = std::max(farthest, double{length(u)});
        most = std::max(most, double{length(u - bare.displacement(v))});
    }
    return most / farthest;
}

/// What a step moves besides stiffness, bytes a vertex: v and u read and written, the probe read, the next one fetched
/// and written, the inverse mass.
constexpr size_t kVectorBytes = 24 + 24 + 16 + 16 + 16 + 4;

/// Limits of the issues: times the bare kernel, how much faster than plain element loops on one and two threads, how
/// much faster on two threads than on one, times what a vertex of the smallest vase costs.
struct Limits {
    double bare = 0, plain[2] = {}, two_threads = 0, smallest = 0;
};

/// A copy of the shell with its pairs stored twice, whatever its size.
ShellView with_pairs_twice(CookedVase& vase) {
    State& state = vase.state;
    ShellRoom room = room_of(state, vase.shell);
    const ShellRoom stiffness = stiffness_room(vase.view(), 0);
    room.blocks = 3 * stiffness.blocks, room.links = 3 * stiffness.links;
    const ShellView copy(state, copy_shell(state, vase.shell, room));
    if (!copy.row.exists()) return copy;
    state.structures.cells[copy.structure].count = 0;
    return assemble_stiffness(copy) ? copy : ShellView(state, {});
}

/// `smallest`: ns a vertex of our step on one thread on the smallest vase; 0 before it is measured.
bool measure(const char* name, float height, float edge, const Limits& limits, const Options& options, Figures& figures,
             double& smallest) {
    const Result<Model> model = cook_vase(edge, height);
    if (!model.ok()) {
        std::printf("%s\n", model.error().c_str());
        return false;
    }
    const FpMode mode;
    CookedVase vase(*model);
    open_task(vase);
    const ShellView shell = vase.view();
    const float dt = vase.state.hidden_runs.time_step[0], beta = vase.state.hidden_runs.damping_time[0];
    OurStep ours(vase.state);
    const double apart = BareHidden::is_supported() ? difference(vase, ours, dt, beta) : 0;
    shake(shell);
    BareHidden bare(shell, dt, beta);
    PlainHidden plain(shell, dt, beta);
    std::unique_ptr<BareHidden> rows;
    if (BareHidden::is_supported() && stores_pairs_once(shell.structures(), shell.structure))
        if (const ShellView twice = with_pairs_twice(vase); twice.row.exists())
            rows = std::make_unique<BareHidden>(twice, dt, beta);
    const uint32_t packs = shell.shells().packs[shell.row].count, chunks = (packs + kChunkPacks - 1) / kChunkPacks;
    const auto bare_chunk = [&](uint32_t step, uint32_t chunk) {
        const uint32_t first = chunk * kChunkPacks;
        bare.run_packs(step, first, std::min(kChunkPacks, packs - first));
    };
    // About a millisecond a run, so that some runs meet no other process; even, because sides take turns.
    const uint32_t steps = std::max(2u, 100000 / shell.vertex_count()) & ~1u;
    std::vector<std::unique_ptr<StepRunner>> runners;
    std::vector<std::unique_ptr<JobSystem>> teams;
    std::vector<Timed> timed;
    timed.push_back({"plain element loops, 1 thread", steps / 4 + 1, [&](uint32_t n) {
                         for (uint32_t i = 0; i < n; ++i) plain.step();
                     }});
    for (const unsigned threads : options.threads) {
        const std::string suffix = on_threads(threads);
        if (BareHidden::is_supported()) {
            runners.push_back(std::make_unique<StepRunner>(threads, chunks, bare_chunk));
            timed.push_back({"bare kernel" + suffix, steps, [r = runners.back().get()](uint32_t n) { r->run(n); },
                             [r = runners.back().get()] { r->prepare(); }});
        }
        teams.push_back(threads > 1 ? make_jobs(JobBackend::Threads, threads) : nullptr);
        timed.push_back({"ours" + suffix, steps, [&ours, t = teams.back().get()](uint32_t n) { ours.run(n, t); }});
    }
    Stream stream(bare.bytes() + kVectorBytes * shell.vertex_count());
    for (const unsigned threads : options.threads) {
        if (!BareHidden::is_supported()) break;
        runners.push_back(std::make_unique<StepRunner>(threads, stream.chunks(),
                                                       [&](uint32_t, uint32_t chunk) { stream.read(chunk); }));
        timed.push_back({"its bytes read in order" + on_threads(threads), steps,
                         [r = runners.back().get()](uint32_t n) { r->run(n); },
                         [r = runners.back().get()] { r->prepare(); }});
    }
    const uint32_t row_packs = rows ? rows->pack_count() : 0;
    for (const unsigned threads : options.threads) {
        if (!rows) break;
        runners.push_back(std::make_unique<StepRunner>(
            threads, (row_packs + kChunkPacks - 1) / kChunkPacks, [&](uint32_t step, uint32_t chunk) {
                const uint32_t first = chunk * kChunkPacks;
                rows->run_packs(step, first, std::min(kChunkPacks, row_packs - first));
            }));
        timed.push_back({"pairs twice, bare kernel" + on_threads(threads), steps,
                         [r = runners.back().get()](uint32_t n) { r->run(n); },
                         [r = runners.back().get()] { r->prepare(); }});
    }
    timed.push_back({"strain pass, 1 thread", steps / 2, [&](uint32_t n) {
                         for (uint32_t i = 0; i < n; ++i) strain_elements(shell, 0, 0, shell.element_count());
                     }});
    timed.push_back({"stress check, both passes, 1 thread", steps / 2, [&](uint32_t n) {
                         for (uint32_t i = 0; i < n; ++i) {
                             strain_elements(shell, 0, 0, shell.element_count());
                             stress_elements(shell, 0, shell.element_count(), kNeverStarts);
                         }
                     }});
    take_turns(timed, options.rounds_of_a_pass(200));
    const std::string prefix = std::string(name) + ": ";
    figures.add(prefix + "vertices", shell.vertex_count(), "");
    const double plain_time = timed[0].best, nanoseconds = 1e9 / shell.vertex_count();
    figures.add(prefix + "stiffness", static_cast<double>(bare.bytes()) / shell.vertex_count(), "bytes a vertex");
    if (rows)
        figures.add(prefix + "stiffness, pairs twice", static_cast<double>(rows->bytes()) / shell.vertex_count(),
                    "bytes a vertex");
    double last_bare = 0, alone = 0;
    const double smallest_whole = smallest;  // 0: this is the smallest
    size_t team = 0;
    for (const Timed& t : timed) {
        figures.add(prefix + t.name, nanoseconds * t.best, "ns a vertex");
        if (t.name.starts_with("bare")) last_bare = t.best;
        if (!t.name.starts_with("ours")) continue;
        if (last_bare > 0)
            figures.add_ratio(prefix + t.name + " / bare kernel", nanoseconds * t.best, nanoseconds * last_bare,
                              "ns a vertex", limits.bare);
        const unsigned threads = options.threads[team++];
        figures.add_ratio(prefix + "plain element loops / " + t.name, nanoseconds * t.best, nanoseconds * plain_time,
                          "ns a vertex", threads <= 2 ? limits.plain[threads - 1] : 0, true);
        if (threads == 1) {
            alone = t.best;
            if (smallest == 0) smallest = nanoseconds * t.best;
            if (limits.smallest > 0)
                figures.add_ratio(prefix + t.name + " / a vertex of 3,200", nanoseconds * t.best, smallest,
                                  "ns a vertex", limits.smallest);
        } else if (alone > 0) {
            figures.add_ratio(prefix + "1 thread / " + t.name, nanoseconds * t.best, nanoseconds * alone, "ns a vertex",
                              threads == 2 ? limits.two_threads : 0, true);
        }
    }
    for (const Timed& t : timed)
        if (smallest_whole > 0 && limits.smallest > 0 && t.name == "its bytes read in order, 1 thread")
            figures.add_ratio(prefix + t.name + " / a vertex's step of 3,200", nanoseconds * t.best, smallest_whole,
                              "ns a vertex");
    figures.add(prefix + "bare and ours apart after 50 steps", apart, "of the largest u", 1e-5);
    return apart < 1e-5;
}

}  // namespace

bool measure_hidden_step(const Options& options, Figures& figures) {
    const FpMode mode;
    double smallest = 0;
    bool is_good = measure("vase of 3,200", 0.30f, 0.0075f, {1.25, {4, 7}}, options, figures, smallest);
    is_good &= measure("vase of 11,000", 0.30f, 0.00405f, {1.25, {4, 6}, 1.8}, options, figures, smallest);
    is_good &= measure("vase of 98,000", 0.89f, 0.00405f, {1.25, {4, 0}, 1.8, 1.4}, options, figures, smallest);
    is_good &= measure_hidden_region_step(options, figures);
    return is_good;
}

}  // namespace cullet::perf
