// Working memory of functions that need more than a stack should hold: a step runs on 64 KiB of stack, a host's jobs
// do.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#include "engine/assert.hpp"
#include "engine/memory.hpp"
#include "engine/tables.hpp"

namespace cullet {

/// Blocks that any thread takes and gives back without a lock. Which block it is says nothing, and what stands in it is
/// left over from others: nothing may be read before it is written.
class ScratchMemory {
 public:
    /// A function takes one block and the functions it calls at most two more: enough for 42 workers at once. Whoever
    /// finds none gets one of the system's; nobody waits, since all that wait may hold what the others wait for.
    static constexpr size_t kBlocks = 128;
    static constexpr size_t kBlockBytes = 160 * 1024;
    static constexpr bool kIsWorkingMemory = true;  // for systems
    CULLET_NAMED(scratch);

    ScratchMemory() : memory_(reserve_memory(kBlocks * kBlockBytes)) {}
    ~ScratchMemory() { release_memory(memory_, kBlocks * kBlockBytes); }
    ScratchMemory(const ScratchMemory&) = delete;
    ScratchMemory& operator=(const ScratchMemory&) = delete;

    /// Aligned to 64. The lowest that is free, so that few threads use few pages.
    std::byte* take();
    void give_back(std::byte* block);

 private:
    static constexpr size_t kBits = 64;
    std::byte* memory_;
    std::array<std::atomic<uint64_t>, kBlocks / kBits> taken_ = {};
};

/// One T in such a block while this lives. Arrays of T that have no initial value hold anything.
template <class T>
class Scratch {
 public:
    template <class... Arguments>
    explicit Scratch(ScratchMemory& memory, Arguments&&... arguments) : memory_(memory), block_(memory.take()) {
        static_assert(sizeof(T) <= ScratchMemory::kBlockBytes && alignof(T) <= 64);
        if constexpr (sizeof...(Arguments) == 0)
            value_ = new (block_) T;
        else
            value_ = new (block_) T(std::forward<Arguments>(arguments)...);
    }
    ~Scratch() {
        value_->~T();
        memory_.give_back(block_);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    T& operator*() const { return *value_; }
    T* operator->() const { return value_; }

 private:
    ScratchMemory& memory_;
    std::byte* block_;
    T* value_;
};

/// Several T in such a block while this lives, each with its initial value.
template <class T>
class ScratchArray {
 public:
    ScratchArray(ScratchMemory& memory, size_t count)
        : memory_(memory), block_(memory.take()), all_(reinterpret_cast<T*>(block_), count) {
        static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= 64);
        CULLET_ASSERT(count <= ScratchMemory::kBlockBytes / sizeof(T), "%zu values are too many for a block", count);
        std::uninitialized_value_construct(all_.begin(), all_.end());
    }
    ~ScratchArray() { memory_.give_back(block_); }
    ScratchArray(const ScratchArray&) = delete;
    ScratchArray& operator=(const ScratchArray&) = delete;

    T& operator[](size_t i) const { return all_[i]; }
    std::span<T> all() const { return all_; }

 private:
    ScratchMemory& memory_;
    std::byte* block_;
    std::span<T> all_;
};

}  // namespace cullet
