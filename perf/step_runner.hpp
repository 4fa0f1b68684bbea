// Chunks of a step shared by threads as a bare kernel would share them: no jobs, no dispatch.
#pragma once
#include <immintrin.h>

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

#include "engine/fp_mode.hpp"

namespace cullet::perf {

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
        const FpMode mode;
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

}  // namespace cullet::perf
