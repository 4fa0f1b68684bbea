// What a host may give to cullet: memory, jobs, a log, profiler zones, an assert handler. Plain C function pointers,
// every one of them optional; `user` comes back as the first argument.
//
// Threads: allocate, release, log and the zone functions are called only on a thread that is in a call of cullet's:
// the one that makes, steps or changes the world, or cooks. No job calls them. assertion_failed may come from a job.
#pragma once
#include <cstddef>
#include <cstdint>

namespace cullet {

/// The large blocks, taken when a world is made (World::create) or a model (cook, read_model) and given back with it:
/// every column of every table at its limit, event queues, the frame's scratch memory, the profiler's samples. Hundreds
/// of megabytes at the default limits, of which only what is used is written: give address space that costs nothing
/// until then, or lower the limits. Small things go through operator new at the same times, cooking's working lists
/// too, and Bullet, Embree and oneTBB have their own. A step takes nothing. Both or neither must be set.
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
    /// Must call job(context, i) once for each i in [0, count) and return when all are done. Any order, any threads;
    /// jobs do not wait for each other, so one thread may run them all. A job needs 64 KiB of stack at most.
    void (*parallel_for)(void* user, uint32_t count, void (*job)(void* context, uint32_t index),
                         void* context) = nullptr;
};

enum class LogLevel : uint8_t { Info, Warning, Error };

struct Host {
    HostAllocator allocator;
    HostJobs jobs;
    void* user = nullptr;
    /// One sentence, without a line end. Warnings: a limit that was reached (at the end of step(), each at most once a
    /// simulated second; the events tell all), a model whose hits will be late unless it breaks quickly (in add_model).
    /// Errors: faults of bodies (at the end of step()). Refused calls speak through their Result alone. Must not call
    /// the world.
    void (*log)(void* user, LogLevel level, const char* sentence) = nullptr;
    /// A named stretch of work, on the thread that steps: "cullet step" around the whole, in it one for each pass of
    /// the frame that has something to do, named by its systems. What runs on all workers has one zone around the pass;
    /// jobs have none of their own. `name` lives as long as the world.
    void (*zone_begin)(void* user, const char* name) = nullptr;
    void (*zone_end)(void* user) = nullptr;
    /// A bug in cullet, in Debug and Checked builds: in step(), in its jobs on whatever thread, in calls that change a
    /// world, and in cook and read_model when they are given a host. When it returns the program aborts.
    void (*assertion_failed)(void* user, const char* sentence) = nullptr;
};

}  // namespace cullet
