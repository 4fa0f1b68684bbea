#include <immintrin.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <functional>
#include <memory>
#include <thread>

#include "engine/fp_mode.hpp"
#include "engine/jobs.hpp"
#include "engine/random.hpp"
#include "engine/simd.hpp"
#include "perf/cook_vase.hpp"
#include "perf/hidden_yardsticks.hpp"
#include "perf/perf.hpp"
#include "systems/damage/assemble.hpp"
#include "systems/damage/brittle_loop.hpp"
#include "systems/damage/energy.hpp"
#include "systems/damage/pair_cells.hpp"
#include "systems/damage/stress_check.hpp"
#include "systems/systems.hpp"

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
    std::string name;
    uint32_t steps;
    std::function<void(uint32_t steps)> run;
    std::function<void()> prepare = {};
    double best = 1e9;  // s a step
};
void take_turns(std::vector<Timed>& all, uint32_t rounds) {
    for (uint32_t r = 0; r < rounds; ++r)
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

void open_task(CookedVase& vase) {
    Tasks& tasks = vase.state.tasks;
    tasks.clear_rows(0, 1);
    tasks.shell[0] = vase.shell;
    tasks.time_step[0] = vase.state.shells.time_step[vase.shell];
    tasks.damping_time[0] = 0.15f * tasks.time_step[0];
    link_slopes(vase.view());
}

/// Our step as the frame runs it: the system, called by the inner loop on one thread or by a team.
class OurStep {
 public:
    explicit OurStep(State& state) : world_{state} { loop_.then<integrate_hidden>().finish(); }
    void run(uint32_t steps, JobSystem* team) {
        const BrittleLoop::Run run{0, 0, steps, nullptr};
        if (!team) return loop_.run_alone(world_, run);
        BrittleLoop::Team shared(loop_, world_, run, team->worker_count());
        parallel_for(*team, team->worker_count(), [&](uint32_t worker) { shared.work(worker); });
    }

 private:
    LoopWorld world_;
    BrittleLoop loop_;
};

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

/// As many bytes as a step moves, read in order and summed: the least that memory takes for them.
class Stream {
 public:
    explicit Stream(size_t bytes) : lines_(bytes / sizeof(Line)) {}
    uint32_t chunks() const { return static_cast<uint32_t>((lines_.size() + kLines - 1) / kLines); }
    void read(uint32_t chunk) {
        const size_t first = size_t{chunk} * kLines, end = std::min(first + kLines, lines_.size());
        sum_.fetch_add(sum(lines_[first].word, (end - first) * kWords), std::memory_order_relaxed);
    }

 private:
    static constexpr size_t kWords = 16, kLines = 2048;
    struct alignas(64) Line {
        uint32_t word[kWords] = {};
    };
    __attribute__((target("avx2"))) static uint32_t sum(const uint32_t* words, size_t count) {
        __m256i sums[8] = {};
        for (size_t i = 0; i < count; i += 64)
            for (size_t k = 0; k < 8 && i + 8 * k < count; ++k)
                sums[k] =
                    _mm256_add_epi32(sums[k], _mm256_load_si256(reinterpret_cast<const __m256i*>(words + i + 8 * k)));
        for (size_t k = 1; k < 8; ++k) sums[0] = _mm256_add_epi32(sums[0], sums[k]);
        return static_cast<uint32_t>(_mm256_extract_epi32(sums[0], 0) + _mm256_extract_epi32(sums[0], 5));
    }
    std::vector<Line> lines_;
    std::atomic<uint32_t> sum_{0};  // so that nothing is left out
};

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
    state.shells.cells[copy.row].count = 0;
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
    const float dt = vase.state.tasks.time_step[0], beta = vase.state.tasks.damping_time[0];
    OurStep ours(vase.state);
    const double apart = BareHidden::is_supported() ? difference(vase, ours, dt, beta) : 0;
    shake(shell);
    BareHidden bare(shell, dt, beta);
    PlainHidden plain(shell, dt, beta);
    std::unique_ptr<BareHidden> rows;
    if (BareHidden::is_supported() && stores_pairs_once(shell.shells(), shell.row))
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
        const std::string suffix = ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
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
        timed.push_back(
            {"its bytes read in order, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads"), steps,
             [r = runners.back().get()](uint32_t n) { r->run(n); }, [r = runners.back().get()] { r->prepare(); }});
    }
    const uint32_t row_packs = rows ? rows->pack_count() : 0;
    for (const unsigned threads : options.threads) {
        if (!rows) break;
        runners.push_back(std::make_unique<StepRunner>(
            threads, (row_packs + kChunkPacks - 1) / kChunkPacks, [&](uint32_t step, uint32_t chunk) {
                const uint32_t first = chunk * kChunkPacks;
                rows->run_packs(step, first, std::min(kChunkPacks, row_packs - first));
            }));
        timed.push_back(
            {"pairs twice, bare kernel, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads"), steps,
             [r = runners.back().get()](uint32_t n) { r->run(n); }, [r = runners.back().get()] { r->prepare(); }});
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
    figures.add(prefix + "bare and ours apart after 50 steps", apart, "of the largest u", 1e-5);
    return apart < 1e-5;
}

}  // namespace

bool measure_hidden_step(const Options& options, Figures& figures) {
    flush_denormals();
    double smallest = 0;
    bool is_good = measure("vase of 3,200", 0.30f, 0.0075f, {1.25, {4, 7}}, options, figures, smallest);
    is_good &= measure("vase of 11,000", 0.30f, 0.00405f, {1.25, {4, 6}, 1.8}, options, figures, smallest);
    is_good &= measure("vase of 98,000", 0.89f, 0.00405f, {1.25, {4, 0}, 1.8, 1.4}, options, figures, smallest);
    return is_good;
}

}  // namespace cullet::perf
