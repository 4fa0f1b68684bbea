#include "engine/range_pool.hpp"

#include <gtest/gtest.h>

#include "engine/random.hpp"
#include "engine/table.hpp"

namespace cullet {
namespace {

// One bool a row; the first run of free rows that is long enough, from the lowest aligned row on.
struct Bitmap {
    Bitmap(uint32_t limit, uint32_t alignment) : is_taken(limit / alignment * alignment), alignment_(alignment) {}
    uint32_t blocks(uint32_t count) const { return (count + alignment_ - 1) / alignment_ * alignment_; }
    uint32_t take(uint32_t count) {
        count = blocks(count);
        for (uint32_t first = 0; first + count <= is_taken.size(); first += alignment_) {
            uint32_t free = 0;
            while (free < count && !is_taken[first + free]) ++free;
            if (free < count) continue;
            for (uint32_t r = 0; r < count; ++r) is_taken[first + r] = true;
            return first;
        }
        return kNone;
    }
    void give_back(uint32_t first, uint32_t count) {
        for (uint32_t r = 0; r < blocks(count); ++r) is_taken[first + r] = false;
    }
    uint32_t end() const {
        auto last = static_cast<uint32_t>(is_taken.size());
        while (last > 0 && !is_taken[last - 1]) --last;
        return last;
    }
    std::vector<bool> is_taken;
    uint32_t alignment_;
};

struct Taken {
    uint32_t first, count;
};

// Calls number 0 .. calls - 1 of a sequence that the seed fixes; `check` sees the pool after each.
template <class Check>
void call_at_random(RangePool& pool, uint64_t seed, uint32_t calls, uint32_t most, Check check) {
    const Random random{seed};
    std::vector<Taken> taken;
    for (uint32_t n = 0; n < calls; ++n) {
        // Takes more often than it gives for a while, then the other way round, so that it is full and empty at times.
        const bool takes = taken.empty() || random.uniform(n, 0) < (n / 500 % 2 ? 0.35 : 0.65);
        if (takes) {
            const uint32_t count = 1 + static_cast<uint32_t>(random.bits(n, 1) % most);
            const uint32_t first = pool.take(count);
            check(true, Taken{first, count});
            if (first != kNone) taken.push_back({first, count});
        } else {
            const size_t which = random.bits(n, 2) % taken.size();
            const Taken range = taken[which];
            taken[which] = taken.back();
            taken.pop_back();
            pool.give_back(range.first, range.count);
            check(false, range);
        }
    }
}

class RangePoolTwin : public testing::TestWithParam<uint32_t> {};

TEST_P(RangePoolTwin, TenThousandRandomCallsGiveWhatABitmapGives) {
    const uint32_t alignment = GetParam();
    constexpr uint32_t kLimit = 3001;  // not a multiple of any alignment but 1
    RangePool pool(kLimit, alignment);
    Bitmap twin(kLimit, alignment);
    uint32_t refused = 0, worst = 0;
    call_at_random(pool, alignment, 10000, 150, [&](bool takes, Taken range) {
        if (takes) {
            ASSERT_EQ(range.first, twin.take(range.count));
            refused += range.first == kNone;
            if (range.first != kNone) {
                ASSERT_EQ(range.first % alignment, 0u);
            }
        } else {
            twin.give_back(range.first, range.count);
        }
        ASSERT_EQ(pool.end(), twin.end());
        worst = std::max(worst, pool.end());
    });
    EXPECT_GT(refused, 50u) << "the pool was never full: the test is too easy";
    EXPECT_GT(worst, kLimit - 200);
}
INSTANTIATE_TEST_SUITE_P(Alignments, RangePoolTwin, testing::Values(1, 8, 16, 64));

TEST(RangePool, TheSameCallsGiveTheSameRangesAndTheSameHash) {
    RangePool a(5000, 8), b(5000, 8);
    std::vector<uint64_t> hashes;
    call_at_random(a, 5, 3000, 90, [&](bool, Taken range) { hashes.push_back(a.hash(range.first)); });
    size_t n = 0;
    call_at_random(b, 5, 3000, 90, [&](bool, Taken range) { ASSERT_EQ(b.hash(range.first), hashes[n++]); });
}

TEST(RangePool, WhenEverythingWasGivenBackItIsAsNew) {
    RangePool pool(1000, 16);
    const uint64_t hash = pool.hash(0);
    std::vector<Taken> taken;
    for (uint32_t count = 1; pool.end() < 900; ++count) taken.push_back({pool.take(count), count});
    for (size_t n = 0; n < taken.size(); n += 2) pool.give_back(taken[n].first, taken[n].count);
    for (size_t n = 1; n < taken.size(); n += 2) pool.give_back(taken[n].first, taken[n].count);
    EXPECT_EQ(pool.hash(0), hash);
    EXPECT_EQ(pool.end(), 0u);
    EXPECT_EQ(pool.take(992), 0u);
}

TEST(RangePool, NoRowsNeedNoRange) {
    RangePool pool(16, 8);
    EXPECT_EQ(pool.take(16), 0u);
    EXPECT_EQ(pool.take(0), 0u);
    pool.give_back(0, 0);
    EXPECT_EQ(pool.take(1), kNone);
}

TEST(RangePool, APoolOfNoRowsRefuses) {
    RangePool pool(7, 8);
    EXPECT_EQ(pool.end(), 0u);
    EXPECT_EQ(pool.take(1), kNone);
}

TEST(RangePool, ACountThatWouldWrapWhenRoundedIsRefused) {
    RangePool pool(1000, 64);
    EXPECT_EQ(pool.take(0xffffffffu), kNone);
    EXPECT_EQ(pool.take(0xfffffff0u), kNone);
    EXPECT_EQ(pool.end(), 0u);
}

TEST(RangePool, ACopyOfAPoolGoesOnAsThePoolDoes) {
    RangePool pool(1000, 1);
    for (uint32_t r = 0; r < 500; ++r) pool.take(1);
    RangePool copy = pool;
    for (uint32_t r = 0; r < 500; r += 2) pool.give_back(r, 1), copy.give_back(r, 1);
    EXPECT_EQ(copy.hash(0), pool.hash(0));
    EXPECT_EQ(copy.take(1), 0u);
}

TEST(RangePool, WithoutRoomForAnotherHoleRowsAreLostAndNothingElse) {
    RangePool pool(100, 1, 2);
    for (uint32_t r = 0; r < 10; ++r) pool.take(1);
    pool.give_back(1, 1);
    pool.give_back(3, 1);  // no room for this hole
    EXPECT_EQ(pool.take(1), 1u);
    EXPECT_EQ(pool.take(1), 10u);
    EXPECT_EQ(pool.end(), 11u);
}

}  // namespace
}  // namespace cullet
