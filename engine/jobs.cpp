#include "engine/jobs.hpp"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "engine/assert.hpp"
#include "engine/fp_mode.hpp"

namespace cullet {
namespace {

#ifdef CULLET_JOBS_ON_STD_THREAD
constexpr bool kJobsOnStdThread = true;  // the thread sanitizer does not see through oneTBB
#else
constexpr bool kJobsOnStdThread = false;
#endif

// What a job has of its caller, on whatever thread it runs.
struct JobMode {
    explicit JobMode(AssertHandler of_caller) : handler(of_caller) {}
    FpMode fp;
    AssertScope handler;
};

class CallerJobs final : public JobSystem {
 public:
    uint32_t worker_count() const override { return 1; }
    void parallel_for(uint32_t count, Job job, void* context) override {
        const FpMode mode;
        for (uint32_t i = 0; i < count; ++i) job(context, i);
    }
};

class TbbJobs final : public JobSystem {
 public:
    explicit TbbJobs(uint32_t threads) : threads_(threads), arena_(static_cast<int>(threads)) {
        arena_.initialize();
        // oneTBB starts its threads, and allocates, at the first pass that has more than one job: not in a frame.
        parallel_for(
            8 * threads, [](void*, uint32_t) {}, nullptr);
    }
    uint32_t worker_count() const override { return threads_; }
    void parallel_for(uint32_t count, Job job, void* context) override {
        const AssertHandler handler = assert_handler();
        arena_.execute([&] {
            oneapi::tbb::parallel_for(
                0u, count, 1u,
                [&](uint32_t i) {
                    const JobMode mode(handler);
                    job(context, i);
                },
                oneapi::tbb::simple_partitioner());
        });
    }

 private:
    uint32_t threads_;
    oneapi::tbb::task_arena arena_;
};

// Threads of our own that sleep between passes. Serves where more threads are asked for than the machine has cores, and
// the thread sanitizer. A pass
// is numbered; a thread that comes late to one finds all of its jobs taken. Callers take turns; a pass inside of a job
// of this same system runs on that job's thread.
class ThreadJobs final : public JobSystem {
 public:
    explicit ThreadJobs(uint32_t threads) {
        for (uint32_t t = 1; t < threads; ++t) threads_.emplace_back([this] { work(); });
    }
    ~ThreadJobs() override {
        {
            const std::lock_guard lock(mutex_);
            is_ending_ = true;
        }
        wake_.notify_all();
        for (std::thread& thread : threads_) thread.join();
    }
    uint32_t worker_count() const override { return static_cast<uint32_t>(threads_.size()) + 1; }
    void parallel_for(uint32_t count, Job job, void* context) override {
        if (count == 0) return;
        if (current() == this) {
            const FpMode mode;
            for (uint32_t i = 0; i < count; ++i) job(context, i);
            return;
        }
        const std::lock_guard turn(turn_);
        {
            const std::lock_guard lock(mutex_);
            job_ = job, context_ = context, count_ = count, handler_ = assert_handler();
            next_ = 0, done_ = 0;
            ++pass_;
        }
        wake_.notify_all();
        take_jobs();
        std::unique_lock lock(mutex_);
        finished_.wait(lock, [&] { return done_ == count_ && busy_ == 0; });
        count_ = 0;
    }

 private:
    static const ThreadJobs*& current() {
        static thread_local const ThreadJobs* jobs = nullptr;
        return jobs;
    }
    void take_jobs() {
        const JobMode mode(handler_);
        const ThreadJobs* const before = std::exchange(current(), this);
        for (;;) {
            const uint32_t i = next_.fetch_add(1, std::memory_order_relaxed);
            if (i >= count_) {
                current() = before;
                return;
            }
            job_(context_, i);
            done_.fetch_add(1, std::memory_order_acq_rel);
        }
    }
    void work() {
        uint64_t seen = 0;
        std::unique_lock lock(mutex_);
        for (;;) {
            wake_.wait(lock, [&] { return is_ending_ || (pass_ != seen && count_ > 0); });
            if (is_ending_) return;
            seen = pass_;
            ++busy_;
            lock.unlock();
            take_jobs();
            lock.lock();
            if (--busy_ == 0) finished_.notify_one();
        }
    }
    std::mutex turn_, mutex_;
    std::condition_variable wake_, finished_;
    std::vector<std::thread> threads_;
    Job job_ = nullptr;
    void* context_ = nullptr;
    AssertHandler handler_;
    uint32_t count_ = 0, busy_ = 0;
    uint64_t pass_ = 0;
    bool is_ending_ = false;
    std::atomic<uint32_t> next_{0}, done_{0};
};

class ForeignJobs final : public JobSystem {
 public:
    explicit ForeignJobs(const HostJobs& jobs) : jobs_(jobs) {}
    uint32_t worker_count() const override {
        const uint32_t count = jobs_.worker_count ? jobs_.worker_count(jobs_.user) : 1;
        return count ? count : 1;
    }
    void parallel_for(uint32_t count, Job job, void* context) override {
        struct Call {
            Job job;
            void* context;
            AssertHandler handler;
        } call{job, context, assert_handler()};
        jobs_.parallel_for(
            jobs_.user, count,
            [](void* outer, uint32_t index) {
                const auto* inner = static_cast<const Call*>(outer);
                const JobMode mode(inner->handler);
                inner->job(inner->context, index);
            },
            &call);
    }

 private:
    HostJobs jobs_;
};

}  // namespace

std::unique_ptr<JobSystem> make_jobs(JobBackend backend, uint32_t threads) {
    if (threads <= 1) return std::make_unique<CallerJobs>();
    // oneTBB has no more workers than the machine has cores, whatever an arena asks for.
    const bool fits_tbb = threads <= static_cast<uint32_t>(oneapi::tbb::info::default_concurrency());
    if (backend == JobBackend::Threads || kJobsOnStdThread || !fits_tbb) return std::make_unique<ThreadJobs>(threads);
    return std::make_unique<TbbJobs>(threads);
}

std::unique_ptr<JobSystem> make_host_jobs(const HostJobs& jobs) {
    return std::make_unique<ForeignJobs>(jobs);
}

}  // namespace cullet
