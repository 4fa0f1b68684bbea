#include "engine/memory.hpp"

#include <sys/mman.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace cullet {
namespace {

constexpr size_t kPage = 4096;
thread_local HostAllocator current_allocator;

// Stands before each block: who gives and takes it back.
struct alignas(64) Header {
    HostAllocator allocator;
    size_t bytes;  // header included
};

}  // namespace

MemoryScope::MemoryScope(const HostAllocator& allocator) : before_(current_allocator) {
    current_allocator = allocator;
}
MemoryScope::~MemoryScope() {
    current_allocator = before_;
}

std::byte* reserve_memory(size_t bytes) {
    if (bytes == 0) return nullptr;
    bytes += sizeof(Header);
    const HostAllocator& host = current_allocator;
    void* memory = host.allocate ? host.allocate(host.user, bytes, 64)
                                 : mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED || !memory) {
        std::fprintf(stderr, "cullet: could not reserve %zu bytes of memory; lower the limits in Settings.\n", bytes);
        std::abort();
    }
    auto* header = static_cast<Header*>(memory);
    header->allocator = host;
    header->bytes = bytes;
    return reinterpret_cast<std::byte*>(header + 1);
}

void release_memory(std::byte* memory, size_t) {
    if (!memory) return;
    Header* header = reinterpret_cast<Header*>(memory) - 1;
    if (header->allocator.release)
        header->allocator.release(header->allocator.user, header, header->bytes);
    else
        munmap(header, header->bytes);
}

void commit_memory(std::byte* memory, size_t bytes) {
#ifdef MADV_POPULATE_WRITE
    if (!memory || bytes == 0) return;
    const auto first = reinterpret_cast<uintptr_t>(memory) / kPage * kPage;
    const auto last = reinterpret_cast<uintptr_t>(memory) + bytes;
    madvise(reinterpret_cast<void*>(first), last - first, MADV_POPULATE_WRITE);  // older kernels refuse: harmless
#else
    (void)memory, (void)bytes;
#endif
}

}  // namespace cullet
