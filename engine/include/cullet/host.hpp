// What a host may give to cullet: memory, jobs, a log, profiler zones, an assert handler. Plain C function pointers,
// every one of them optional; `user` comes back as the first argument.
//
// Threads: allocate, release, log and the zone functions are called only on a thread that is in a call of cullet's.
// That is the one that makes, steps or changes the world, or cooks. No job calls them. assertion_failed may come from
// a job.
#pragma once
#include <cstddef>
#include <cstdint>

namespace cullet {

/// Gives the large blocks: every column of every table at its limit, event queues, the frame's scratch memory, the
/// profiler's samples. They are taken when a world is made (World::create) or a model (cook, read_model), and given
/// back with it. They are hundreds of megabytes at the default limits, and only what is used of them is written. So
/// give address space that costs nothing until it is written, or lower the limits. Small things, and cooking's working
/// lists, go through operator new at the same times. Bullet, Embree and oneTBB have their own memory. A step takes
/// nothing. Both or neither must be set.
struct HostAllocator {
    void* user = nullptr;
    /// `size` bytes aligned to `alignment` (64), zeroed or not. Null: the call that makes or loads the
    /// world, or reads or cooks the model, is refused with a sentence.
    void* (*allocate)(void* user, size_t size, size_t alignment) = nullptr;
    /// `size` as it was asked for.
    void (*release)(void* user, void* memory, size_t size) = nullptr;
};

/// The host's job system. Without it cullet runs on Settings::threads threads of its own (1: only the caller's).
struct HostJobs {
    void* user = nullptr;
    uint32_t (*worker_count)(void* user) = nullptr;
    /// Must call job(context, i) once for each i in [0, count) and return when all are done. Any order and any threads
    /// will do. Jobs do not wait for each other, so one thread may run them all. A job needs 64 KiB of stack at most.
    void (*parallel_for)(void* user, uint32_t count, void (*job)(void* context, uint32_t index),
                         void* context) = nullptr;
};

enum class LogLevel : uint8_t { Info, Warning, Error };

struct Host {
    HostAllocator allocator;
    HostJobs jobs;
    void* user = nullptr;
    /// One sentence, without a line end. Must not call the world. Two things are warnings. One is a limit that was
    /// reached: at the end of step(), each at most once a simulated second; the events tell all. The other is a model
    /// whose hits will be late unless it breaks quickly: in add_model. Errors are faults of bodies, at the end of
    /// step(). Refused calls speak through their Result alone.
    void (*log)(void* user, LogLevel level, const char* sentence) = nullptr;
    /// A named stretch of work, on the thread that steps. "cullet step" is around the whole. In it stands one zone for
    /// each pass of the frame that has something to do, named by its systems. What runs on all workers has one zone
    /// around the pass; jobs have none of their own. `name` lives as long as the world.
    void (*zone_begin)(void* user, const char* name) = nullptr;
    void (*zone_end)(void* user) = nullptr;
    /// A bug in cullet was found, in Debug and Checked builds. It comes from step(), from its jobs on whatever thread,
    /// from calls that change a world, and from cook and read_model with a host. When it returns the program aborts.
    void (*assertion_failed)(void* user, const char* sentence) = nullptr;
};

}  // namespace cullet
