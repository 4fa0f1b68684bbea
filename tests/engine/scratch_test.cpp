// Blocks of working memory, for any number of threads at once.
#include "engine/scratch.hpp"

#include <gtest/gtest.h>

#include <barrier>
#include <cstring>
#include <set>
#include <thread>
#include <vector>

namespace cullet {
namespace {

constexpr int kNested = 3;  // blocks that one thread holds at once

/// All threads hold one block before any takes its second one, and so on: the worst order that there is.
std::set<std::byte*> take_in_turns(ScratchMemory& memory, int threads) {
    std::vector<std::byte*> blocks(static_cast<size_t>(kNested * threads));
    std::barrier all(threads);
    std::vector<std::thread> workers;
    for (int worker = 0; worker < threads; ++worker)
        workers.emplace_back([&, worker] {
            for (int depth = 0; depth < kNested; ++depth) {
                std::byte*& block = blocks[static_cast<size_t>(kNested * worker + depth)];
                block = memory.take();
                std::memset(block, worker, ScratchMemory::kBlockBytes);
                all.arrive_and_wait();
            }
            for (int depth = kNested - 1; depth >= 0; --depth) {
                std::byte* const block = blocks[static_cast<size_t>(kNested * worker + depth)];
                for (const size_t at : {size_t{0}, ScratchMemory::kBlockBytes - 1})
                    EXPECT_EQ(static_cast<int>(block[at]), worker);
                memory.give_back(block);
            }
        });
    for (std::thread& worker : workers) worker.join();
    return {blocks.begin(), blocks.end()};
}

TEST(Scratch, HundredThreadsWithThreeBlocksEachDoNotWaitForEachOther) {
    ScratchMemory memory;
    for (const int threads : {8, 64, 100}) {
        const std::set<std::byte*> blocks = take_in_turns(memory, threads);
        EXPECT_EQ(blocks.size(), static_cast<size_t>(kNested * threads));
        for (const std::byte* block : blocks) EXPECT_EQ(reinterpret_cast<uintptr_t>(block) % 64, 0u);
    }
}

TEST(Scratch, WhatIsGivenBackIsTakenAgain) {
    ScratchMemory memory;
    std::byte* const first = memory.take();
    memory.give_back(first);
    EXPECT_EQ(memory.take(), first);
    memory.give_back(first);
}

}  // namespace
}  // namespace cullet
