// What happened, in order. A queue of fixed room in memory of its own, which serial systems write.
#pragma once
#include <cstdint>
#include <span>
#include <type_traits>

#include "engine/memory.hpp"

namespace cullet {

template <class E>
class Events {
    static_assert(std::is_trivially_copyable_v<E>, "events are plain data");

 public:
    using Value = E;
    explicit Events(uint32_t limit) : memory_(reserve_memory(size_t{limit} * sizeof(E))), limit_(limit) {}
    ~Events() { release_memory(memory_, size_t{limit_} * sizeof(E)); }
    Events(const Events&) = delete;
    Events& operator=(const Events&) = delete;

    /// False when the queue is full: the event is counted in dropped() and lost.
    bool push(const E& event) {
        if (size_ == limit_) {
            ++dropped_;
            return false;
        }
        data()[size_++] = event;
        return true;
    }
    void clear() { size_ = 0; }
    std::span<const E> all() const { return {reinterpret_cast<const E*>(memory_), size_}; }
    std::span<E> all() { return {data(), size_}; }
    uint32_t size() const { return size_; }
    uint64_t dropped() const { return dropped_; }
    auto begin() const { return all().begin(); }
    auto end() const { return all().end(); }

 private:
    E* data() { return reinterpret_cast<E*>(memory_); }
    std::byte* memory_;
    uint32_t limit_, size_ = 0;
    uint64_t dropped_ = 0;
};

/// A queue, as a list of them names it.
template <class E>
struct QueueOf {
    uint32_t limit;
};

/// Several queues, one of each kind of event.
template <class... E>
class Queues : Events<E>... {
 public:
    explicit Queues(QueueOf<E>... queue) : Events<E>(queue.limit)... {}
    template <class T>
    static constexpr bool has() {
        return (... || std::is_same_v<T, E>);
    }
    template <class T>
    Events<T>& of() {
        return *this;
    }
    template <class T>
    const Events<T>& of() const {
        return *this;
    }
    template <class F>
    void for_each(F&& f) {
        (f(of<E>()), ...);
    }
};

}  // namespace cullet
