#include "engine/scratch.hpp"

#include <bit>

namespace cullet {

std::byte* ScratchMemory::take() {
    for (size_t word = 0; word < taken_.size(); ++word) {
        uint64_t taken = taken_[word].load(std::memory_order_relaxed);
        while (~taken) {
            const auto bit = static_cast<size_t>(std::countr_one(taken));
            if (taken_[word].compare_exchange_weak(taken, taken | uint64_t{1} << bit, std::memory_order_acquire,
                                                   std::memory_order_relaxed))
                return memory_ + (kBits * word + bit) * kBlockBytes;
        }
    }
    // Who waited would hold what others wait for: functions take their second block with the first one in hand.
    return reserve_memory(kBlockBytes);
}

void ScratchMemory::give_back(std::byte* block) {
    const auto from_start = reinterpret_cast<uintptr_t>(block) - reinterpret_cast<uintptr_t>(memory_);
    if (from_start >= kBlocks * kBlockBytes) return release_memory(block, kBlockBytes);
    const size_t at = from_start / kBlockBytes;
    taken_[at / kBits].fetch_and(~(uint64_t{1} << at % kBits), std::memory_order_release);
}

}  // namespace cullet
