// What a host may give to cullet: memory, jobs, a log, profiler zones, an assert handler. Plain C function pointers,
// every one of them optional; `user` comes back as the first argument.
//
// Threads: allocate, release, log and the zone functions may be called from any thread that runs a job of cullet's.
#pragma once
#include <cstddef>
#include <cstdint>

namespace cullet {

/// Memory for what a world and a model allocate when they are made. A step allocates nothing. Both or neither must be
/// set.
struct HostAllocator {
    void* user = nullptr;
    /// `size` bytes aligned to `alignment` (a power of two), zeroed or not, or null when there are none.
    void* (*allocate)(void* user, size_t size, size_t alignment) = nullptr;
    void (*release)(void* user, void* memory, size_t size) = nullptr;
};

/// The host's job system. Without it cullet runs on Settings::threads threads of its own (1: only the caller's).
struct HostJobs {
    void* user = nullptr;
    uint32_t (*worker_count)(void* user) = nullptr;
    /// Must call job(context, i) once for each i in [0, count) and return when all are done. Any order, any threads;
    /// jobs do not wait for each other, so one thread may run them all.
    void (*parallel_for)(void* user, uint32_t count, void (*job)(void* context, uint32_t index),
                         void* context) = nullptr;
};

enum class LogLevel : uint8_t { Info, Warning, Error };

struct Host {
    HostAllocator allocator;
    HostJobs jobs;
    void* user = nullptr;
    /// One sentence, without a line end. Never called during the parallel part of a step.
    void (*log)(void* user, LogLevel level, const char* sentence) = nullptr;
    /// A named stretch of work on this thread; `name` lives as long as the program.
    void (*zone_begin)(void* user, const char* name) = nullptr;
    void (*zone_end)(void* user) = nullptr;
    /// A bug in cullet, in Debug and Checked builds. When it returns the program aborts.
    void (*assertion_failed)(void* user, const char* sentence) = nullptr;
};

}  // namespace cullet
