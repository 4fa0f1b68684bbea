// Work on pairs of bodies, on the threads that there are, each with working memory of its own.
#pragma once
#include <atomic>
#include <deque>
#include <thread>

#include "engine/bullet/pair_algorithm.hpp"
#include "engine/jobs.hpp"
#include "engine/rigid_allocations.hpp"

namespace cullet::bullet {

class Scratches {
 public:
    explicit Scratches(uint32_t body_limit) : body_limit_(body_limit) { make(1); }
    /// Without jobs all runs on the calling thread.
    void use_jobs(JobSystem& jobs) {
        jobs_ = &jobs;
        make(jobs.worker_count());
    }
    /// Of the thread that steps the world, outside of run().
    PairScratch& own() { return slots_[0].scratch; }
    /// Calls call(index, scratch) for each index below `count`, in any order and several at once.
    template <class Call>
    void run(uint32_t count, Call call) {
        const auto job = [&](uint32_t index) {
            uint64_t allocations = 0;
            {
                InsideRigidEngine guard(allocations);
                Slot& slot = lease();
                call(index, slot.scratch);
                slot.is_busy.clear(std::memory_order_release);
            }
            allocations_.fetch_add(allocations, std::memory_order_relaxed);
        };
        if (jobs_ && count > 1) return parallel_for(*jobs_, count, job);
        for (uint32_t index = 0; index < count; ++index) job(index);
    }
    /// Calls for memory on other threads than that which steps the world.
    uint64_t allocations() const { return allocations_.load(std::memory_order_relaxed); }

 private:
    struct Slot {
        explicit Slot(uint32_t body_limit) : scratch(body_limit) {}
        PairScratch scratch;
        std::atomic_flag is_busy;
    };
    void make(uint32_t count) {
        slots_.clear();
        while (slots_.size() < count) slots_.emplace_back(body_limit_);
    }
    // No more jobs run at once than there are workers.
    Slot& lease() {
        for (;; std::this_thread::yield())
            for (Slot& slot : slots_)
                if (!slot.is_busy.test_and_set(std::memory_order_acquire)) return slot;
    }
    uint32_t body_limit_;
    JobSystem* jobs_ = nullptr;
    std::deque<Slot> slots_;
    std::atomic<uint64_t> allocations_ = 0;
};

}  // namespace cullet::bullet
