#include "engine/arena.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "engine/events.hpp"

namespace cullet {
namespace {

TEST(Arena, WhatItGivesIsAlignedApartAndForgottenAtOnce) {
    struct alignas(64) Wide {
        float lane[16];
    };
    Arena arena(4096);
    const auto bytes = arena.take<char>(3);
    const auto doubles = arena.take<double>(5);
    const auto wide = arena.take<Wide>(2);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(doubles.data()) % alignof(double), 0u);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(wide.data()) % 64, 0u);
    EXPECT_GE(reinterpret_cast<char*>(doubles.data()), bytes.data() + 3);
    EXPECT_GE(reinterpret_cast<double*>(wide.data()), doubles.data() + 5);
    arena.reset();
    EXPECT_EQ(arena.take<char>(3).data(), bytes.data());
}

TEST(Arena, ItGivesItsLastByteAndNotOneMore) {
    Arena arena(1024);
    EXPECT_EQ(arena.take<uint32_t>(256).size(), 256u);
    EXPECT_TRUE(arena.take<char>(1).empty());
    EXPECT_EQ(arena.most(), 1024u);
    arena.reset();
    EXPECT_EQ(arena.most(), 1024u);
    EXPECT_EQ(arena.take<char>(1024).size(), 1024u);
}

TEST(Arena, ARefusalLeavesTheRestToSmallerOnes) {
    Arena arena(100);
    EXPECT_TRUE(arena.take<char>(101).empty());
    EXPECT_EQ(arena.take<char>(100).size(), 100u);
}

TEST(Arena, ACountWhoseBytesWrapIsRefused) {
    Arena arena(1000);
    EXPECT_TRUE(arena.take<uint64_t>(std::numeric_limits<size_t>::max() / 4).empty());
    EXPECT_TRUE(arena.take<uint64_t>((size_t{1} << 61) + 1).empty());
    arena.take<char>(999);
    EXPECT_TRUE(arena.take<uint64_t>(1).empty()) << "aligned past its end";
    EXPECT_TRUE(arena.take<uint64_t>(std::numeric_limits<size_t>::max()).empty());
}

TEST(Arena, OneOfNoBytesGivesNothing) {
    Arena arena(0);
    EXPECT_TRUE(arena.take<char>(1).empty());
    EXPECT_TRUE(arena.take<char>(0).empty());
}

struct Heard {
    uint32_t who;
};

TEST(Events, TheyStandInTheOrderOfTheirComing) {
    Events<Heard> events(10);
    for (uint32_t n = 0; n < 5; ++n) EXPECT_TRUE(events.push({n * n}));
    uint32_t n = 0;
    for (const Heard& heard : events) {
        EXPECT_EQ(heard.who, n * n);
        ++n;
    }
    EXPECT_EQ(n, 5u);
    EXPECT_EQ(events.all().size(), 5u);
}

TEST(Events, AFullQueueCountsWhatItLoses) {
    Events<Heard> events(3);
    for (uint32_t n = 0; n < 8; ++n) EXPECT_EQ(events.push({n}), n < 3);
    EXPECT_EQ(events.size(), 3u);
    EXPECT_EQ(events.dropped(), 5u);
    EXPECT_EQ(events.all()[2].who, 2u);
    events.clear();
    EXPECT_EQ(events.size(), 0u);
    EXPECT_EQ(events.dropped(), 5u) << "counted since the queue was made";
    EXPECT_TRUE(events.push({9}));
}

TEST(Events, AQueueWithoutRoomLosesAll) {
    Events<Heard> events(0);
    EXPECT_FALSE(events.push({1}));
    EXPECT_TRUE(events.all().empty());
}

}  // namespace
}  // namespace cullet
