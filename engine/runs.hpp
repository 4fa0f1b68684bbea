// All inner loops of a frame on all workers, by one policy: the longest first, one job each; but those that would keep
// one worker longer than the others are shared by all workers, one after another.
#pragma once
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "engine/inner_loop.hpp"
#include "engine/jobs.hpp"
#include "engine/profiler.hpp"

namespace cullet {

/// One run of one loop, whatever its world is: a small struct of references, of which the run keeps a copy.
class LoopRun {
 public:
    /// `units`: what it costs, counted alike in all of a list. `may_be_shared`: it has rows enough for a pass to be
    /// worth a barrier. `units_left(world, row)`, where given, tells afterwards how many units were not used. The loop,
    /// and what the world refers to, must outlive the run.
    template <class World>
    LoopRun(const InnerLoop<World>& loop, const World& world, const typename InnerLoop<World>::Run& run, uint64_t units,
            bool may_be_shared, uint32_t zone, uint64_t (*units_left)(World&, uint32_t row) = nullptr)
        : loop_(&loop),
          goes_on_(reinterpret_cast<void (*)()>(run.goes_on)),
          left_over_(reinterpret_cast<void (*)()>(units_left)),
          calls_(&kCalls<World>),
          units_(units),
          row_(run.body),
          first_(run.first),
          repetitions_(run.repetitions),
          zone_(zone),
          may_be_shared_(may_be_shared) {
        static_assert(std::is_trivially_copyable_v<World> && sizeof(World) <= sizeof(world_));
        std::construct_at(reinterpret_cast<World*>(world_), world);
    }

    uint64_t units() const { return units_; }
    uint32_t row() const { return row_; }
    uint32_t zone() const { return zone_; }
    bool may_be_shared() const { return may_be_shared_; }
    void run_alone(Profiler& profiler) const;
    void run_together(JobSystem& jobs, Profiler& profiler) const;
    uint64_t left_over() const { return left_over_ ? calls_->left_over(*this) : 0; }

 private:
    struct Calls {
        void (*alone)(const LoopRun&);
        void (*together)(const LoopRun&, JobSystem&, Profiler&);
        uint64_t (*left_over)(const LoopRun&);
    };
    template <class World>
    World& world() const {
        return *std::launder(reinterpret_cast<World*>(world_));
    }
    template <class World>
    const InnerLoop<World>& loop() const {
        return *static_cast<const InnerLoop<World>*>(loop_);
    }
    template <class World>
    typename InnerLoop<World>::Run run() const {
        return {row_, first_, repetitions_, reinterpret_cast<bool (*)(World&, uint32_t)>(goes_on_)};
    }
    template <class World>
    void share(JobSystem& jobs, Profiler& profiler) const {
        const uint32_t workers = jobs.worker_count();
        typename InnerLoop<World>::Team team(loop<World>(), world<World>(), run<World>(), workers);
        parallel_for(jobs, workers, [&](uint32_t worker) {
            const uint64_t start = now_ns();
            team.work(worker);
            profiler.add_span(zone_, start, now_ns());
        });
    }
    template <class World>
    static void call_alone(const LoopRun& r) {
        r.loop<World>().run_alone(r.world<World>(), r.run<World>());
    }
    template <class World>
    static void call_together(const LoopRun& r, JobSystem& jobs, Profiler& profiler) {
        r.share<World>(jobs, profiler);
    }
    template <class World>
    static uint64_t call_left_over(const LoopRun& r) {
        return reinterpret_cast<uint64_t (*)(World&, uint32_t)>(r.left_over_)(r.world<World>(), r.row_);
    }
    template <class World>
    static constexpr Calls kCalls = {call_alone<World>, call_together<World>, call_left_over<World>};

    const void* loop_;
    alignas(void*) mutable std::byte world_[2 * sizeof(void*)];
    void (*goes_on_)();  // of the loop's world, as left_over_
    void (*left_over_)();
    const Calls* calls_;
    uint64_t units_;
    uint32_t row_, first_, repetitions_, zone_;
    bool may_be_shared_;
};

/// The runs of a frame. Allocates when it is made, and never again.
class Runs {
 public:
    explicit Runs(uint32_t most) { list_.reserve(most); }
    void clear() { list_.clear(); }
    void add(const LoopRun& run);
    /// Runs all of them; returns the units that they left over.
    uint64_t advance(JobSystem& jobs, Profiler& profiler);

 private:
    std::vector<LoopRun> list_;
};

}  // namespace cullet
