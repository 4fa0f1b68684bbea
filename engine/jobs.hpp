// Where work runs: on the calling thread, on threads of our own, in oneTBB, or on the host's job system. Work is cut
// into jobs by constants, never by the number of threads, so that none of these can change a result.
#pragma once
#include <cstdint>
#include <memory>
#include <type_traits>

#include "cullet/host.hpp"

namespace cullet {

class JobSystem {
 public:
    using Job = void (*)(void* context, uint32_t index);
    virtual ~JobSystem() = default;
    /// How many jobs may run at once, at least 1.
    virtual uint32_t worker_count() const = 0;
    /// Calls job(context, i) once for each i in [0, count), in any order on any threads, and returns when all are done.
    /// Each call runs with our floating-point mode (fp_mode.hpp) and the caller's assert handler. Jobs never wait for
    /// each other; a job may call parallel_for.
    virtual void parallel_for(uint32_t count, Job job, void* context) = 0;
};

enum class JobBackend : uint8_t { Tbb, Threads };

/// `threads` counts the caller; 1 runs everything on it and starts none. More than the machine has cores run on threads
/// of our own also where oneTBB is asked for; always, in builds with CULLET_JOBS_ON_STD_THREAD.
std::unique_ptr<JobSystem> make_jobs(JobBackend backend, uint32_t threads);
std::unique_ptr<JobSystem> make_host_jobs(const HostJobs& jobs);

/// parallel_for for anything callable with an index; the callable lives on the caller's stack.
template <class F>
void parallel_for(JobSystem& jobs, uint32_t count, F&& call) {
    jobs.parallel_for(
        count, [](void* context, uint32_t index) { (*static_cast<std::remove_reference_t<F>*>(context))(index); },
        const_cast<void*>(static_cast<const void*>(&call)));
}

}  // namespace cullet
