// Scratch memory of one frame: taken in order, forgotten all at once. Serial systems only; each chunk of a parallel one
// gets its share before the pass.
#pragma once
#include <cstddef>
#include <span>

#include "engine/assert.hpp"
#include "engine/memory.hpp"

namespace cullet {

class Arena {
 public:
    explicit Arena(size_t bytes) : memory_(reserve_memory(bytes)), size_(bytes) {}
    ~Arena() { release_memory(memory_, size_); }
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    /// `count` values, not initialised; an empty span when the arena is full.
    template <class T>
    std::span<T> take(size_t count) {
        static_assert(alignof(T) <= 64, "reserved memory is aligned to 64");
        const size_t first = (used_ + alignof(T) - 1) / alignof(T) * alignof(T);
        if (first > size_ || count > (size_ - first) / sizeof(T)) return {};
        used_ = first + count * sizeof(T);
        most_ = used_ > most_ ? used_ : most_;
        return {reinterpret_cast<T*>(memory_ + first), count};
    }
    void reset() { used_ = 0; }
    size_t most() const { return most_; }

 private:
    std::byte* memory_;
    size_t size_, used_ = 0, most_ = 0;
};

}  // namespace cullet
