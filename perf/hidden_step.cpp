#include <immintrin.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <functional>
#include <memory>
#include <thread>

#include "engine/random.hpp"
#include "engine/simd.hpp"
#include "perf/hidden_yardsticks.hpp"
#include "perf/perf.hpp"
#include "systems/damage/energy.hpp"
#include "systems/damage/stress_check.hpp"
#include "systems/motion/integrate_packs.hpp"
#include "tests/support/shell_meshes.hpp"

namespace cullet::perf {
namespace {

constexpr uint32_t kChunkPacks = 32;  // 256 vertices

void flush_denormals() {
    _mm_setcsr(0x9fc0);
}

/// Runs `steps` steps of chunks on `threads` threads. A thread claims chunks from its own end, so that it meets the
/// same ones every step and finds them in its cache; who finishes the last chunk opens the next step.
class StepRunner {
 public:
    StepRunner(unsigned threads, uint32_t chunks, std::function<void(uint32_t step, uint32_t chunk)> work)
        : threads_(threads), chunks_(chunks), work_(std::move(work)) {
        for (unsigned t = 1; t < threads; ++t) workers_.emplace_back([this, t] { wait_for_runs(t); });
    }
    ~StepRunner() {
        is_over_ = true;
        wake_.fetch_add(1);
        wake_.notify_all();
        for (auto& w : workers_) w.join();
    }
    /// Wakes the workers, which sleep while other things are measured, and returns when all of them spin.
    void prepare() {
        ready_.store(0);
        wake_.fetch_add(1);
        wake_.notify_all();
        while (ready_.load() < threads_ - 1) _mm_pause();
    }
    void run(uint32_t steps) {
        steps_ = steps;
        done_.store(0);
        left_.store(threads_ - 1);
        claim_.store(0);
        go_.fetch_add(1);
        work_through(0);
        while (left_.load() > 0) _mm_pause();
    }

 private:
    void wait_for_runs(unsigned thread) {
        flush_denormals();
        for (uint32_t seen = 0;; ++seen) {
            wake_.wait(seen);
            if (is_over_) return;
            const uint32_t before = go_.load();
            ready_.fetch_add(1);
            while (go_.load(std::memory_order_acquire) == before) _mm_pause();
            work_through(thread);
            left_.fetch_sub(1);
        }
    }
    /// claim_: step in the upper half, chunks taken from the front and from the back in 16 bits each.
    void work_through(unsigned thread) {
        const uint64_t one = thread % 2 == 0 ? 1u : 1u << 16;
        for (;;) {
            uint64_t claim = claim_.load(std::memory_order_acquire);
            const auto step = static_cast<uint32_t>(claim >> 32);
            if (step >= steps_) return;
            const auto front = static_cast<uint32_t>(claim & 0xffff),
                       back = static_cast<uint32_t>(claim >> 16 & 0xffff);
            if (front + back == chunks_) {
                _mm_pause();
                continue;
            }
            if (!claim_.compare_exchange_weak(claim, claim + one, std::memory_order_acq_rel)) continue;
            work_(step, one == 1 ? front : chunks_ - 1 - back);
            if (done_.fetch_add(1, std::memory_order_acq_rel) + 1 == (step + 1) * uint64_t{chunks_})
                claim_.store(uint64_t{step + 1} << 32, std::memory_order_release);
        }
    }

    unsigned threads_;
    uint32_t chunks_, steps_ = 0;
    std::function<void(uint32_t, uint32_t)> work_;
    std::vector<std::thread> workers_;
    alignas(64) std::atomic<uint64_t> claim_{0};
    alignas(64) std::atomic<uint64_t> done_{0};
    alignas(64) std::atomic<uint32_t> wake_{0}, go_{0};
    std::atomic<unsigned> left_{0}, ready_{0};
    std::atomic<bool> is_over_{false};
};

/// Least time of many runs, taken in turns, so that a busy moment of the machine hits all alike.
struct Timed {
    const char* name;
    uint32_t steps;
    std::function<void(uint32_t steps)> run;
    std::function<void()> prepare = {};
    double best = 1e9;  // s a step
};
void take_turns(std::vector<Timed>& all, int rounds) {
    for (int r = 0; r < rounds; ++r)
        for (Timed& t : all) {
            if (t.prepare) t.prepare();
            t.run(2);  // fills the caches that the others have emptied
            if (t.prepare) t.prepare();
            t.best = std::min(t.best, seconds([&] { t.run(t.steps); }) / t.steps);
        }
}

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

void measure(uint32_t frequency, const Options& options) {
    State state;
    const Row<Materials> porcelain = test::add_material(state, 70e9, 0.2, 2400);
    const Row<Shells> row = test::make_test_shell(state, test::sphere_mesh(frequency, 0.15), 0.005, porcelain, {}, 64);
    const ShellView shell(state, row);
    const Row<Tasks> task = test::make_test_task(state, row);
    const float dt = state.tasks.time_step[task], beta = state.tasks.damping_time[task];
    shake(shell);
    BareHidden bare(shell, dt, beta);
    PlainHidden plain(shell, dt, beta);
    const uint32_t packs = state.shells.packs[row].count, chunks = (packs + kChunkPacks - 1) / kChunkPacks;
    const HiddenStep sides[2] = {{shell, dt, beta, 0}, {shell, dt, beta, 1}};
    const auto ours = [&](uint32_t step, uint32_t chunk) {
        const uint32_t first = chunk * kChunkPacks;
        integrate_packs(sides[step & 1], first, std::min(kChunkPacks, packs - first));
    };
    const auto bare_chunk = [&](uint32_t step, uint32_t chunk) {
        const uint32_t first = chunk * kChunkPacks;
        bare.run_packs(step, first, std::min(kChunkPacks, packs - first));
    };
    // Under half a millisecond a run, so that some runs meet no other process.
    const uint32_t steps = std::max(2u, 26000 / shell.vertex_count()) & ~1u;
    std::vector<std::unique_ptr<StepRunner>> runners;
    std::vector<std::string> names;
    std::vector<Timed> timed;
    names.reserve(16);
    timed.push_back({"plain element loops, 1 thread", steps, [&](uint32_t n) {
                         for (uint32_t i = 0; i < n; ++i) plain.step();
                     }});
    for (const unsigned threads : options.threads) {
        const std::string suffix = ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
        for (const bool is_bare : {true, false}) {
            if (is_bare && !BareHidden::is_supported()) continue;
            if (is_bare)
                runners.push_back(std::make_unique<StepRunner>(threads, chunks, bare_chunk));
            else
                runners.push_back(std::make_unique<StepRunner>(threads, chunks, ours));
            names.push_back((is_bare ? "bare kernel" : "ours") + suffix);
            timed.push_back({names.back().c_str(), steps, [r = runners.back().get()](uint32_t n) { r->run(n); },
                             [r = runners.back().get()] { r->prepare(); }});
        }
    }
    timed.push_back({"strain pass, 1 thread", steps / 2, [&](uint32_t n) {
                         for (uint32_t i = 0; i < n; ++i) strain_elements(shell, 0, 0, shell.element_count());
                     }});
    timed.push_back({"stress check, 1 thread", steps / 2, [&](uint32_t n) {
                         for (uint32_t i = 0; i < n; ++i) {
                             check_stress(shell, 0);
                         }
                     }});
    timed.push_back({"energy test, 1 thread", steps / 2, [&](uint32_t n) {
                         for (uint32_t i = 0; i < n; ++i) (void)task_energy(state, task);
                     }});
    take_turns(timed, shell.vertex_count() > 50000 ? 20 : 300);
    const double per_vertex = 1e9 / shell.vertex_count();
    const double plain_time = timed[0].best;
    std::printf("%u vertices, %u triangles, dt %.3g us, %zu bytes a vertex\n", shell.vertex_count(),
                shell.element_count(), 1e6 * static_cast<double>(dt), bare.bytes() / shell.vertex_count());
    double last_bare = 0;
    for (const Timed& t : timed) {
        const std::string name = t.name;
        std::printf("  %-32s %8.1f us  %6.2f ns a vertex", t.name, 1e6 * t.best, per_vertex * t.best);
        if (name.starts_with("bare")) last_bare = t.best;
        if (name.starts_with("ours"))
            std::printf("  %.2f x bare, %.1f times plain", last_bare > 0 ? t.best / last_bare : 0, plain_time / t.best);
        if (name.starts_with("stress")) std::printf("  %.2f ns a triangle", 1e9 * t.best / shell.element_count());
        std::printf("\n");
    }
}

}  // namespace

bool measure_hidden_step(const Options& options, Figures&) {
    flush_denormals();
    const std::pair<const char*, SimdLevel> levels[] = {{"best", SimdLevel::Best},
                                                        {"scalar", SimdLevel::Scalar},
                                                        {"sse4", SimdLevel::Sse4},
                                                        {"avx2", SimdLevel::Avx2},
                                                        {"avx512", SimdLevel::Avx512}};
    for (const auto& [name, level] : levels)
        if (options.simd == name && !set_simd_level(level)) {
            std::printf("this machine has no %s\n", name);
            return false;
        }
    for (const uint32_t frequency : {18u, 33u, 99u}) measure(frequency, options);
    set_simd_level(SimdLevel::Best);
    return true;
}

}  // namespace cullet::perf
