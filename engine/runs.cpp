#include "engine/runs.hpp"

#include <algorithm>

#include "engine/assert.hpp"

namespace cullet {
namespace {

constexpr uint32_t kMostWorkers = 64;

/// Time that workers need who take one after the other.
uint64_t makespan(std::span<const LoopRun> runs, uint32_t workers) {
    uint64_t busy[kMostWorkers] = {};
    const uint32_t count = std::min(workers, kMostWorkers);
    for (const LoopRun& run : runs) *std::min_element(busy, busy + count) += run.units();
    return *std::max_element(busy, busy + count);
}

/// How many of the runs, longest first, all workers should share: those that would keep one at work when the others
/// have nothing left. Who shares waits at each barrier: two workers do in six tenths of the time what one does.
uint32_t count_shared(std::span<const LoopRun> runs, uint32_t workers) {
    if (workers < 2) return 0;
    uint32_t best = 0;
    uint64_t shared = 0, least = makespan(runs, workers);
    for (uint32_t count = 1; count <= std::min<size_t>(runs.size(), workers); ++count) {
        if (!runs[count - 1].may_be_shared()) break;
        shared += runs[count - 1].units() * 6 / (5 * workers);
        const uint64_t time = shared + makespan(runs.subspan(count), workers);
        if (time < least) least = time, best = count;
    }
    return best;
}

bool is_longer(const LoopRun& a, const LoopRun& b) {
    if (a.units() != b.units()) return a.units() > b.units();
    return a.zone() != b.zone() ? a.zone() < b.zone() : a.row() < b.row();
}

}  // namespace

void LoopRun::run_alone(Profiler& profiler) const {
    const uint64_t start = now_ns();
    calls_->alone(*this);
    profiler.add_span(zone_, start, now_ns());
}

void LoopRun::run_together(JobSystem& jobs, Profiler& profiler) const {
    calls_->together(*this, jobs, profiler);
}

void Runs::add(const LoopRun& run) {
    CULLET_ASSERT(list_.size() < list_.capacity(), "more than %zu runs in a frame", list_.capacity());
    list_.push_back(run);
}

uint64_t Runs::advance(JobSystem& jobs, Profiler& profiler) {
    std::sort(list_.begin(), list_.end(), is_longer);
    const uint32_t shared = count_shared(list_, jobs.worker_count());
    for (uint32_t i = 0; i < shared; ++i) list_[i].run_together(jobs, profiler);
    parallel_for(jobs, static_cast<uint32_t>(list_.size()) - shared,
                 [&](uint32_t i) { list_[shared + i].run_alone(profiler); });
    uint64_t left_over = 0;
    for (const LoopRun& run : list_) left_over += run.left_over();
    return left_over;
}

}  // namespace cullet
