#include "engine/scratch.hpp"

#include <bit>
#include <thread>

namespace cullet {

std::byte* ScratchMemory::take() {
    for (;;) {
        for (size_t word = 0; word < taken_.size(); ++word) {
            uint64_t taken = taken_[word].load(std::memory_order_relaxed);
            while (~taken) {
                const auto bit = static_cast<size_t>(std::countr_one(taken));
                if (taken_[word].compare_exchange_weak(taken, taken | uint64_t{1} << bit, std::memory_order_acquire,
                                                       std::memory_order_relaxed))
                    return memory_ + (kBits * word + bit) * kBlockBytes;
            }
        }
        std::this_thread::yield();
    }
}

void ScratchMemory::give_back(std::byte* block) {
    const auto at = static_cast<size_t>(block - memory_) / kBlockBytes;
    taken_[at / kBits].fetch_and(~(uint64_t{1} << at % kBits), std::memory_order_release);
}

}  // namespace cullet
