#include "engine/memory.hpp"

#include <sys/mman.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace cullet {
namespace {
constexpr size_t kPage = 4096;
size_t in_pages(size_t bytes) {
    return (bytes + kPage - 1) / kPage * kPage;
}
}  // namespace

std::byte* reserve_memory(size_t bytes) {
    if (bytes == 0) return nullptr;
    void* memory =
        mmap(nullptr, in_pages(bytes), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) {
        std::fprintf(stderr, "cullet: could not reserve %zu bytes of address space; lower the limits in Settings.\n",
                     bytes);
        std::abort();
    }
    return static_cast<std::byte*>(memory);
}

void release_memory(std::byte* memory, size_t bytes) {
    if (memory) munmap(memory, in_pages(bytes));
}

void commit_memory(std::byte* memory, size_t bytes) {
#ifdef MADV_POPULATE_WRITE
    if (!memory || bytes == 0) return;
    const auto first = reinterpret_cast<uintptr_t>(memory) / kPage * kPage;
    const auto last = reinterpret_cast<uintptr_t>(memory) + bytes;
    madvise(reinterpret_cast<void*>(first), in_pages(last - first),
            MADV_POPULATE_WRITE);  // older kernels refuse: harmless
#else
    (void)memory, (void)bytes;
#endif
}

}  // namespace cullet
