// The spring substep as the frame runs it (inner loop, teams, tables) on grids of three sizes, beside the bare kernel,
// the plain loop and Bullet's soft body; and two layers beside one.
#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <algorithm>
#include <memory>

#include "engine/fp_mode.hpp"
#include "engine/jobs.hpp"
#include "perf/our_springs.hpp"
#include "perf/perf.hpp"
#include "perf/springs.hpp"
#include "perf/stream.hpp"
#include "sample_game/spring_bench.hpp"
#include "systems/models/thick_shell/springs/spring_lists.hpp"
#include "systems/models/thick_shell/springs/spring_loop.hpp"

namespace cullet::perf {
namespace {

constexpr uint32_t kSides[] = {105, 320, 1000};
constexpr uint32_t kLargestInBullet = 320;  // its links of 1,000 x 1,000 take a gigabyte, and longer each

/// n x n points a centimetre apart, row by row; right-angled triangles, one-way diagonals: 3 springs a point.
SpringNet grid_net(uint32_t n) {
    SpringNet net;
    for (uint32_t y = 0; y < n; ++y)
        for (uint32_t x = 0; x < n; ++x)
            net.points.push_back({0.01f * static_cast<float>(x), 0, 0.01f * static_cast<float>(y)});
    for (uint32_t y = 0; y < n; ++y)
        for (uint32_t x = 0; x < n; ++x) {
            const uint32_t v = y * n + x;
            if (x + 1 < n) net.springs.push_back({v, v + 1});
            if (y + 1 < n) net.springs.push_back({v, v + n});
            if (x + 1 < n && y + 1 < n) net.springs.push_back({v, v + n + 1});
        }
    net.mass = 1e-3f;
    net.stiffness = 100;
    net.dt = 0.2f * std::sqrt(net.mass / net.stiffness);
    net.damping = 0.1f * net.stiffness * net.dt;
    return net;
}

std::vector<Vec3> drawn_out(const SpringNet& net) {
    std::vector<Vec3> start;
    for (const Vec3 p : net.points) start.push_back({1.1f * p.x, 0.1f * p.x * p.z, p.z});
    return start;
}

/// The net in tables, drawn out.
SpringBench make_ours(const SpringNet& net, const std::vector<Vec3>& start) {
    SpringBench bench = bench_of(net);
    for (uint32_t v = 0; v < start.size(); ++v) bench.view().place(v, start[v]);
    measure_lengths(bench.view());
    return bench;
}

/// The frame's way: the inner loop on the calling thread, or a team.
class OurSprings {
 public:
    OurSprings(SpringBench& bench, unsigned threads)
        : world_{bench.state()},
          row_(bench.springs()),
          loop_(make_spring_loop(bench.view().layout())),
          jobs_(threads > 1 ? make_jobs(JobBackend::Threads, threads) : nullptr) {}
    void run(uint32_t steps) {
        const SpringLoop::Run run{row_, world_.state.shell_springs.steps[row_], steps, nullptr};
        if (!jobs_) return loop_.run_alone(world_, run);
        SpringLoop::Team team(loop_, world_, run, jobs_->worker_count());
        parallel_for(*jobs_, jobs_->worker_count(), [&](uint32_t worker) { team.work(worker); });
    }

 private:
    SpringWorld world_;
    Row<ShellSprings> row_;
    SpringLoop loop_;
    std::unique_ptr<JobSystem> jobs_;
};

/// Least time of a link and iteration of a patch of as many nodes, reordered: s.
double time_links(uint32_t n, uint32_t rounds) {
    btSoftBodyWorldInfo info;
    info.m_sparsesdf.Initialize();
    const auto side = static_cast<int>(n);
    const std::unique_ptr<btSoftBody> body(
        btSoftBodyHelpers::CreatePatch(info, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, side, side, 0, true));
    body->setTotalMass(1);
    btSoftBodyHelpers::ReoptimizeLinkOrder(body.get());
    body->updateLinkConstants();
    const auto solve = btSoftBody::getSolver(btSoftBody::ePSolver::Linear);
    double least = 1e9;
    for (uint32_t round = 0; round < rounds; ++round)
        least = std::min(least, seconds([&] {
                             for (int i = 0; i < 4; ++i) solve(body.get(), 1, 0);
                         }));
    return least / (4.0 * body->m_links.size());
}

/// What a substep moves: slots read, lengths written back, and of each vertex its place read, the next one fetched and
/// written, its velocity read and written, its inverse mass.
size_t bytes_of_substep(SpringBench& bench) {
    const SpringView view = bench.view();
    const SpringPacks& packs = bench.state().spring_packs;
    size_t slots = 0;
    for (uint32_t p = 0; p < view.pack_count(); ++p) slots += packs.slot_count[view.pack(p)];
    return slots * (sizeof(SpringSlot) + sizeof SpringSlot{}.length) +
           size_t{view.shell.vertex_count()} * (16 + 16 + 16 + 12 + 12 + 4);
}

struct GridTimes {
    double bare = 1e9, plain = 1e9, bullet = 0, stream = 1e9;
    double bytes = 0;          // a spring
    std::vector<double> ours;  // by number of threads
};

/// ns a spring and step; all take turns. `apart`: how far ours and the bare kernel are after the first 50 steps, m.
GridTimes time_grid(uint32_t n, const Options& options, double& apart) {
    const FpMode mode;
    const SpringNet net = grid_net(n);
    const std::vector<Vec3> start = drawn_out(net);
    SpringBench bench = make_ours(net, start);
    BareSprings bare(net, start);
    PlainSprings plain(net, start);
    std::vector<std::unique_ptr<OurSprings>> ours;
    for (const unsigned threads : options.threads) ours.push_back(std::make_unique<OurSprings>(bench, threads));
    ours[0]->run(50);
    apart = 0;
    if (BareSprings::is_supported()) {
        for (int i = 0; i < 50; ++i) bare.step();
        for (uint32_t v = 0; v < start.size(); ++v)
            apart = std::max(apart, double{length(bench.view().position(v) - bare.position(v))});
    }
    GridTimes times;
    times.ours.assign(options.threads.size(), 1e9);
    Stream stream(bytes_of_substep(bench));
    times.bytes = static_cast<double>(bytes_of_substep(bench)) / static_cast<double>(net.springs.size());
    const uint32_t steps = std::max(2u, 100000 / static_cast<uint32_t>(start.size()));
    const uint32_t rounds = options.rounds_of_a_pass(n > 500 ? 24 : 90);
    const double each = 1e9 / (double(steps) * static_cast<double>(net.springs.size()));
    for (uint32_t round = 0; round < rounds; ++round) {
        for (size_t t = 0; t < ours.size(); ++t)
            times.ours[t] = std::min(times.ours[t], each * seconds([&] { ours[t]->run(steps); }));
        const auto all = [&](auto& loop) {
            return each * seconds([&] {
                       for (uint32_t i = 0; i < steps; ++i) loop.step();
                   });
        };
        if (BareSprings::is_supported()) {
            times.bare = std::min(times.bare, all(bare));
            times.stream = std::min(times.stream, each * seconds([&] {
                                                      for (uint32_t i = 0; i < steps; ++i) stream.read_all();
                                                  }));
        }
        if (round % 4 == 0) times.plain = std::min(times.plain, all(plain));
    }
    times.bullet = 1e9 * time_links(std::min(n, kLargestInBullet), std::max(2u, rounds / 4));
    return times;
}

/// Two layers over one, of the same sheet of elements.
void measure_layers(const Options& options, Figures& figures) {
    const FpMode mode;
    const BenchMesh sheet = bench_strip(52, 104, 0.01);  // about 11 thousand vertices
    double least[3] = {1e9, 1e9, 1e9};
    const SpringLayout layouts[] = {SpringLayout::OneLayer, SpringLayout::Sandwich, SpringLayout::Crossed};
    std::vector<std::unique_ptr<SpringBench>> benches;
    for (const SpringLayout layout : layouts) {
        SpringSettings settings;
        settings.layout = layout;
        benches.push_back(std::make_unique<SpringBench>(sheet, 0.005, BenchMaterial{}, settings));
        benches.back()->set_velocity(100, {0.1f, 0.1f, 0.1f});
    }
    const double each = 1e9 / (10.0 * benches[0]->view().spring_count());
    for (uint32_t round = 0; round < options.rounds_of_a_pass(90); ++round)
        for (size_t k = 0; k < benches.size(); ++k)
            least[k] = std::min(least[k],
                                each * seconds([&] { run_springs(benches[k]->state(), benches[k]->springs(), 10); }));
    figures.add_ratio("sandwich / one layer, 11 thousand vertices", least[1], least[0], "ns a spring", 2.5);
    figures.add_ratio("the paper's two layers / one layer", least[2], least[0], "ns a spring");
}

}  // namespace

bool measure_springs(const Options& options, Figures& figures) {
    bool is_good = true;
    double smallest = 0;
    for (const uint32_t n : kSides) {
        const std::string grid = std::to_string(n) + " x " + std::to_string(n);
        double apart = 0;
        const GridTimes times = time_grid(n, options, apart);
        figures.add(grid + ": plain loop, a spring and step", times.plain, "ns");
        figures.add(grid + ": a substep moves", times.bytes, "bytes a spring");
        if (BareSprings::is_supported())
            figures.add(grid + ": its bytes read in order, 1 thread", times.stream, "ns a spring");
        // Its links of the largest grid are not measured: a ratio with a smaller one is of two sizes, and has no limit.
        const bool is_same_size = n <= kLargestInBullet;
        const std::string bullet =
            is_same_size ? "Bullet"
                         : "Bullet at " + std::to_string(kLargestInBullet) + " x " + std::to_string(kLargestInBullet);
        figures.add(grid + ": " + bullet + ", a link and iteration, reordered", times.bullet, "ns");
        double alone = 0;
        for (size_t t = 0; t < times.ours.size(); ++t) {
            const unsigned threads = options.threads[t];
            const std::string name =
                grid + (threads == 1 ? ", 1 thread: " : ", " + std::to_string(threads) + " threads: ");
            const double ours = times.ours[t];
            if (threads == 1) {
                alone = ours;
                if (BareSprings::is_supported())
                    figures.add_ratio(name + "substep / bare kernel", ours, times.bare, "ns a spring", 1.2);
            }
            const double least_ratio = !is_same_size ? 0 : threads == 1 ? 2.3 : threads == 2 ? 4.0 : 0;
            figures.add_ratio(name + bullet + ", an iteration / substep", ours, times.bullet, "ns a spring",
                              least_ratio, true);
            if (threads == 2 && alone > 0)
                figures.add_ratio(name + "one thread / two", ours, alone, "ns a spring", 1.7, true);
            if (threads == 1 && n == kSides[0]) smallest = ours;
            if (threads == 1 && n == kSides[2] && smallest > 0) {
                figures.add_ratio("growth from the smallest grid to the largest", ours, smallest, "ns a spring", 1.3);
                if (BareSprings::is_supported())
                    figures.add_ratio("the largest grid's bytes read in order / the smallest's substep", times.stream,
                                      smallest, "ns a spring");
            }
        }
        if (!BareSprings::is_supported()) continue;
        const double most = 1e-5 * n / 100;  // rounding grows with the size of the numbers
        figures.add(grid + ": ours and the bare kernel apart after 50 steps", apart, "m", most);
        is_good &= apart < most;
    }
    measure_layers(options, figures);
    return is_good;
}

}  // namespace cullet::perf
