#include "engine/memory.hpp"

#include <sys/mman.h>

#include <cstdint>
#include <new>

namespace cullet {
namespace {

constexpr size_t kPage = 4096;
thread_local HostAllocator current_allocator;

// Stands before each block: who gives and takes it back.
struct alignas(64) Header {
    HostAllocator allocator;
    void* given;
    size_t bytes;  // of what was given
};

constexpr size_t kLine = 64, kColours = kPage / kLine;

// Columns that are read side by side would otherwise all begin at the same place of a page. Their rows of the same
// number would share one set of the first-level cache, which has 8 to 12 places a set. So each block begins at a line
// of its own, spread by the number of its first page.
size_t colour_of(const void* memory) {
    const auto page = static_cast<uint32_t>(reinterpret_cast<uintptr_t>(memory) / kPage);
    return (page * 2654435761u >> 16) % kColours;
}

}  // namespace

MemoryScope::MemoryScope(const HostAllocator& allocator) : before_(current_allocator) {
    current_allocator = allocator;
}
MemoryScope::~MemoryScope() {
    current_allocator = before_;
}

bool is_reserved_zero() {
    return !current_allocator.allocate;
}

std::byte* reserve_memory(size_t bytes) {
    if (bytes == 0) return nullptr;
    bytes += sizeof(Header) + kColours * kLine;
    const HostAllocator& host = current_allocator;
    void* memory = host.allocate ? host.allocate(host.user, bytes, 64)
                                 : mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED || !memory) throw std::bad_alloc();
    auto* header = reinterpret_cast<Header*>(static_cast<std::byte*>(memory) + colour_of(memory) * kLine);
    header->allocator = host;
    header->given = memory;
    header->bytes = bytes;
    return reinterpret_cast<std::byte*>(header + 1);
}

void release_memory(std::byte* memory, size_t) {
    if (!memory) return;
    Header* header = reinterpret_cast<Header*>(memory) - 1;
    if (header->allocator.release)
        header->allocator.release(header->allocator.user, header->given, header->bytes);
    else
        munmap(header->given, header->bytes);
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
