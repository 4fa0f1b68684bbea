// Address space for columns: reserved for the limit at once, given pages as it fills, never moved. Not malloc.
#pragma once
#include <cstddef>

#include "cullet/host.hpp"

namespace cullet {

/// While one of these lives, what this thread reserves comes from the host's allocator (when it has one) instead of the
/// system's address space. Each block remembers where it came from.
class MemoryScope {
 public:
    explicit MemoryScope(const HostAllocator& allocator);
    ~MemoryScope();
    MemoryScope(const MemoryScope&) = delete;
    MemoryScope& operator=(const MemoryScope&) = delete;

 private:
    HostAllocator before_;
};

/// `bytes` of memory aligned to 64 that costs nothing until it is written; from the system it is zero. Throws
/// std::bad_alloc when there is none: files choose limits too, so who makes a world or a model answers with a sentence.
/// Nothing is reserved within a step.
std::byte* reserve_memory(size_t bytes);
/// What this thread reserves now is zero: the system gives it, not a host's allocator.
bool is_reserved_zero();
void release_memory(std::byte* memory, size_t bytes);  // null is allowed
/// Gives pages to [memory, memory + bytes) now, so that a frame meets no page fault.
void commit_memory(std::byte* memory, size_t bytes);

}  // namespace cullet
