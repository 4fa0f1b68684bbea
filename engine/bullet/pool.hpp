// Rows of one type that keep their address, with a free list. Memory comes in chunks and never goes back; the first
// chunk is made when the pool is, so that a world of the expected size asks for nothing later.
#pragma once
#include <atomic>
#include <cstddef>
#include <memory>
#include <new>
#include <thread>
#include <vector>

namespace cullet::bullet {

/// T needs no destructor and no alignment beyond operator new's, and has a member `T* next`, which the pool uses while
/// a row is free.
template <class T>
class Pool {
 public:
    explicit Pool(size_t chunk_rows) : chunk_rows_(chunk_rows) {
        chunks_.reserve(64);
        grow();
    }
    T* take() {
        if (!free_ && used_ == chunk_rows_) grow();
        T* row = free_;
        if (row)
            free_ = row->next;
        else
            row = new (chunks_.back().get() + used_++ * sizeof(T)) T;
        row->next = nullptr;
        return row;
    }
    void give(T* row) {
        row->next = free_;
        free_ = row;
    }

 private:
    void grow() {
        // Not filled: pages that no row needs are never touched.
        chunks_.push_back(std::unique_ptr<std::byte[]>(new std::byte[chunk_rows_ * sizeof(T)]));
        used_ = 0;
    }
    size_t chunk_rows_, used_ = 0;
    T* free_ = nullptr;
    std::vector<std::unique_ptr<std::byte[]>> chunks_;
};

/// The same for several threads at once. Which row one of them gets is a matter of chance.
template <class T>
class SharedPool {
 public:
    explicit SharedPool(size_t chunk_rows) : rows_(chunk_rows) {}
    T* take() {
        const Turn turn(is_busy_);
        return rows_.take();
    }
    void give(T* row) {
        const Turn turn(is_busy_);
        rows_.give(row);
    }

 private:
    struct Turn {
        explicit Turn(std::atomic_flag& busy) : is_busy(busy) {
            while (is_busy.test_and_set(std::memory_order_acquire)) std::this_thread::yield();
        }
        ~Turn() { is_busy.clear(std::memory_order_release); }
        std::atomic_flag& is_busy;
    };
    Pool<T> rows_;
    std::atomic_flag is_busy_;
};

}  // namespace cullet::bullet
