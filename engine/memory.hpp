// Address space for columns: reserved for the limit at once, given pages as it fills, never moved. Not malloc.
#pragma once
#include <cstddef>

namespace cullet {

/// `bytes` of zeros that cost no memory until they are written. Aborts with a sentence when the address space is full.
std::byte* reserve_memory(size_t bytes);
void release_memory(std::byte* memory, size_t bytes);
/// Gives pages to [memory, memory + bytes) now, so that a frame meets no page fault.
void commit_memory(std::byte* memory, size_t bytes);

}  // namespace cullet
