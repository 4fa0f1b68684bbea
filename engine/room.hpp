// Lists of steps that may not ask the system for memory: in a room they are laid one behind the other, and forgotten
// all at once.
#pragma once
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "engine/memory.hpp"

namespace cullet {

/// Memory for one piece of work at a time.
class Room {
 public:
    explicit Room(size_t bytes) : memory_(reserve_memory(bytes)), size_(bytes) {}
    ~Room() { release_memory(memory_, size_); }
    Room(const Room&) = delete;
    Room& operator=(const Room&) = delete;

    /// Null: it is full.
    std::byte* take(size_t bytes) {
        bytes = rounded(bytes);
        if (bytes > size_ - used_) {
            was_full_ = true;
            return nullptr;
        }
        std::byte* const taken = memory_ + used_;
        used_ += bytes;
        return taken;
    }
    /// The last one makes way for the next; others stay until all go.
    void give_back(const void* block, size_t bytes) {
        const auto first = static_cast<size_t>(static_cast<const std::byte*>(block) - memory_);
        if (first + rounded(bytes) == used_) used_ = first;
    }
    bool has(const void* block) const {
        const auto at = reinterpret_cast<uintptr_t>(block), from = reinterpret_cast<uintptr_t>(memory_);
        return at >= from && at < from + size_;
    }
    void reset() { used_ = 0; }
    size_t used() const { return used_; }
    /// Some work found no room and went to the system: since the room was made.
    bool was_full() const { return was_full_; }

 private:
    static size_t rounded(size_t bytes) {
        constexpr size_t kLine = 64;
        return (bytes + kLine - 1) / kLine * kLine;
    }
    std::byte* memory_;
    size_t size_, used_ = 0;
    bool was_full_ = false;
};

/// While one lives, lists of this thread stand in the room, which is empty at first. None of them may outlive it, but
/// for those of work that goes on in a later scope, maybe on another thread. What finds no room comes from the system.
class RoomScope {
 public:
    struct GoesOn {};
    explicit RoomScope(Room& room) : RoomScope(room, GoesOn()) { room.reset(); }
    RoomScope(Room& room, GoesOn) : before_(current_) { current_ = &room; }
    ~RoomScope() { current_ = before_; }
    RoomScope(const RoomScope&) = delete;
    RoomScope& operator=(const RoomScope&) = delete;

    static std::byte* take(size_t bytes) { return current_ ? current_->take(bytes) : nullptr; }
    /// False: it is the system's.
    static bool give_back(const void* block, size_t bytes) {
        if (!current_ || !current_->has(block)) return false;
        current_->give_back(block, bytes);
        return true;
    }

 private:
    static inline thread_local Room* current_ = nullptr;
    Room* before_;
};

template <class T>
struct RoomAllocator {
    using value_type = T;
    RoomAllocator() = default;
    template <class U>
    RoomAllocator(const RoomAllocator<U>&) {}
    T* allocate(size_t count) {
        if (std::byte* const taken = RoomScope::take(count * sizeof(T))) return reinterpret_cast<T*>(taken);
        return static_cast<T*>(::operator new(count * sizeof(T)));
    }
    void deallocate(T* block, size_t count) {
        if (!RoomScope::give_back(block, count * sizeof(T))) ::operator delete(block);
    }
    template <class U>
    friend bool operator==(const RoomAllocator&, const RoomAllocator<U>&) {
        return true;
    }
};

/// A vector that stands in the thread's room, if it has one.
template <class T>
using List = std::vector<T, RoomAllocator<T>>;

}  // namespace cullet
