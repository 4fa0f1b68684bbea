#include "engine/packed_bytes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace cullet {
namespace {

constexpr uint64_t kPlenty = 1ull << 30;

/// Bytes in which nothing repeats.
std::vector<uint8_t> noise(size_t count, uint64_t seed = 1) {
    std::vector<uint8_t> bytes(count);
    for (uint8_t& byte : bytes) {
        seed = seed * 6364136223846793005ull + 1442695040888963407ull;
        byte = static_cast<uint8_t>(seed >> 56);
    }
    return bytes;
}

TEST(PackedBytes, WhatIsPackedComesBackByteForByte) {
    for (const size_t count : {0u, 1u, 3u, 1000u, 1u << 20, (5u << 20) + 7}) {
        const std::vector<uint8_t> bytes = noise(count);
        const std::vector<uint8_t> packed = pack(bytes);
        EXPECT_TRUE(is_packed(packed));
        const auto back = unpack(packed, "a.csnap", kPlenty);
        ASSERT_TRUE(back.ok()) << back.error();
        EXPECT_EQ(*back, bytes) << count;
    }
}

TEST(PackedBytes, WhatRepeatsAfterManyMegabytesIsKeptOnce) {
    const std::vector<uint8_t> once = noise(20u << 20);
    std::vector<uint8_t> thrice = once;
    for (int k = 0; k < 2; ++k) thrice.insert(thrice.end(), once.begin(), once.end());
    EXPECT_LT(pack(thrice).size(), once.size() + once.size() / 50);
}

TEST(PackedBytes, DamagedOnesAreRefusedWithASentence) {
    const std::vector<uint8_t> content = noise(3000), good = pack(content);
    uint32_t refused = 0;
    for (size_t at = 4; at < good.size(); at += 7) {
        std::vector<uint8_t> bad = good;
        bad[at] ^= 0x10;
        const auto result = unpack(bad, "a.csnap", kPlenty);
        if (result.ok()) {  // a bit that means nothing
            EXPECT_EQ(*result, content) << at;
            continue;
        }
        ++refused;
        EXPECT_EQ(result.error().rfind("a.csnap: ", 0), 0u) << result.error();
    }
    EXPECT_GT(refused, 400u);
    for (size_t size = 4; size < good.size(); size += 11)
        EXPECT_FALSE(unpack(std::span(good).first(size), "a.csnap", kPlenty).ok()) << size;
    std::vector<uint8_t> longer = good;
    longer.push_back(0);
    EXPECT_FALSE(unpack(longer, "a.csnap", kPlenty).ok());
}

TEST(PackedBytes, WhatGrowsTooLargeIsRefused) {
    const std::vector<uint8_t> packed = pack(std::vector<uint8_t>(100u << 20, 0));
    EXPECT_LT(packed.size(), 20'000u);
    EXPECT_TRUE(unpack(packed, "a.csnap", 100u << 20).ok());
    const auto result = unpack(packed, "a.csnap", (100u << 20) - 1);
    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.error().find("holds more than 104857599 bytes"), std::string::npos) << result.error();
}

TEST(PackedBytes, OtherFilesAreNotTakenForPackedOnes) {
    EXPECT_FALSE(is_packed({}));
    EXPECT_FALSE(is_packed(noise(64)));
}

}  // namespace
}  // namespace cullet
