#include "sample_game/allocations.hpp"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "engine/rigid_allocations.hpp"

namespace cullet {
namespace {

std::atomic<bool> is_counting{false};
std::atomic<uint64_t> ours{0}, rigid{0};

// The thread-locals of rigid_allocations.cpp stand in the executable's own block and need no allocation to be read.
void count_one() {
    if (inside_rigid_engine()) ++rigid_allocation_count();
    if (!is_counting.load(std::memory_order_relaxed)) return;
    (inside_rigid_engine() ? rigid : ours).fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

void start_counting_allocations() {
    ours = 0;
    rigid = 0;
    is_counting = true;
}

AllocationCounts stop_counting_allocations() {
    is_counting = false;
    return {ours, rigid};
}

}  // namespace cullet

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define CULLET_HAS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer) || __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
#define CULLET_HAS_SANITIZER 1
#endif
#endif

#ifndef CULLET_HAS_SANITIZER
// glibc's allocator under its other names. Through dlsym(RTLD_NEXT) the first call would allocate before there is
// anything to call. libstdc++'s operator new calls malloc or aligned_alloc and is counted there.
extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);

void* malloc(size_t bytes) {
    cullet::count_one();
    return __libc_malloc(bytes);
}
void* calloc(size_t count, size_t bytes) {
    cullet::count_one();
    return __libc_calloc(count, bytes);
}
void* realloc(void* memory, size_t bytes) {
    cullet::count_one();
    return __libc_realloc(memory, bytes);
}
void* memalign(size_t alignment, size_t bytes) {
    cullet::count_one();
    return __libc_memalign(alignment, bytes);
}
void* aligned_alloc(size_t alignment, size_t bytes) {
    cullet::count_one();
    return __libc_memalign(alignment, bytes);
}
int posix_memalign(void** memory, size_t alignment, size_t bytes) {
    if (alignment % sizeof(void*) != 0 || (alignment & (alignment - 1)) != 0 || alignment == 0) return EINVAL;
    cullet::count_one();
    void* found = __libc_memalign(alignment, bytes);
    if (!found) return ENOMEM;
    *memory = found;
    return 0;
}
}  // extern "C"
#else
// The sanitizer keeps malloc and operator new, and tells of each call.
#include <sanitizer/allocator_interface.h>

namespace cullet {
namespace {
[[maybe_unused]] const int is_told = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, size_t) { count_one(); }, [](const volatile void*) {});
}  // namespace
}  // namespace cullet
#endif
