#include "engine/table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

namespace cullet {
namespace {

struct Pebbles : Table<Pebbles> {
    using Table::Table;
    static constexpr const char* kName = "pebbles";
    Column<Vec3> velocity{*this, "velocity", "m/s"};
    Column<double> mass{*this, "mass", "kg"};
    Column<uint8_t> kind{*this, "kind"};
    Column<uint16_t> colour{*this, "colour"};
    Column<uint32_t> count{*this, "count"};
    Column<uint64_t> born{*this, "born"};
    Column<Row<Pebbles>> next{*this, "next"};
    Column<Quat> turn{*this, "turn"};
    Column<Vec3d> centre{*this, "centre", "m"};
    Column<Sym3d> inertia{*this, "inertia", "kg m2"};
    Column<std::array<float, 5>> weight{*this, "weight"};
    Column<float, Buffers::Two> heat{*this, "heat", "K"};
    Column<float> guess{*this, "guess", "1", Keep::Scratch};
};

struct Blob {
    unsigned char byte[40];
};
struct Blobs : Table<Blobs> {
    using Table::Table;
    static constexpr const char* kName = "blobs";
    Column<Blob> blob{*this, "blob"};
};

// Made by nobody before the test that makes it on two threads at once.
struct Latecomers : Table<Latecomers> {
    using Table::Table;
    static constexpr const char* kName = "latecomers";
    Column<float> a{*this, "a"};
    Column<Vec3> b{*this, "b"};
    Column<double> c{*this, "c"};
};

void fill(Pebbles& p, uint32_t rows) {
    p.append(rows);
    for (uint32_t r = 0; r < rows; ++r) {
        const auto f = static_cast<float>(r);
        p.velocity.set(r, {f, 2 * f, 3 * f});
        p.mass[r] = 0.5 * r;
        p.kind[r] = static_cast<uint8_t>(r);
        p.next[r] = Row<Pebbles>(r + 1);
        p.heat.set(r, f, 0);
        p.heat.set(r, -f, 1);
    }
}

TEST(Table, NewRowsAreZeroAndCounted) {
    Pebbles p(100);
    EXPECT_EQ(p.size(), 0u);
    EXPECT_EQ(p.append(3), 0u);
    EXPECT_EQ(p.append(2), 3u);
    EXPECT_EQ(p.size(), 5u);
    for (uint32_t r = 0; r < 5; ++r) {
        EXPECT_EQ(p.velocity[r], (Vec3{0, 0, 0}));
        EXPECT_EQ(p.mass[r], 0.0);
        EXPECT_EQ(p.next[r].index, 0u);
    }
}

TEST(Table, RowsForgottenAndAppendedAgainAreZero) {
    Pebbles p(10);
    fill(p, 10);
    p.truncate(4);
    EXPECT_EQ(p.append(6), 4u);
    for (uint32_t r = 4; r < 10; ++r) EXPECT_EQ(p.velocity[r], (Vec3{0, 0, 0}));
    EXPECT_EQ(p.velocity[3], (Vec3{3, 6, 9}));
}

TEST(Table, AFullTableRefusesAndStaysAsItWas) {
    Pebbles p(10);
    EXPECT_EQ(p.append(8), 0u);
    EXPECT_EQ(p.append(3), kNone);
    EXPECT_EQ(p.append(0xffffffffu), kNone);
    EXPECT_EQ(p.size(), 8u);
    EXPECT_EQ(p.append(2), 8u);
    EXPECT_EQ(p.append(0), 10u);
    EXPECT_EQ(p.append(1), kNone);
}

TEST(Table, ATableOfNoRowsIsHarmless) {
    Pebbles a(0), b(0);
    EXPECT_EQ(a.append(1), kNone);
    EXPECT_EQ(a.hash(1), b.hash(1));
    EXPECT_EQ(a.first_difference(b), "");
    EXPECT_EQ(a.validate(), "");
}

TEST(Table, ARowNeverMovesWhenTheTableGrows) {
    Pebbles p(1u << 20);
    p.append(1);
    const float* place = p.velocity.lane(1);
    p.append(1u << 18);
    EXPECT_EQ(p.velocity.lane(1), place);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(place) % 64, 0u);
}

TEST(Table, CopiedRowsAreTheSameInEveryColumnOnBothSides) {
    Pebbles from(50), to(20);
    fill(from, 50);
    from.weight[31] = {1, 2, 3, 4, 5};
    from.guess[31] = 7;
    to.append(10);
    to.copy_rows(from, 30, 4, 6);
    for (uint32_t r = 0; r < 6; ++r) EXPECT_EQ(to.describe_row(4 + r).substr(10), from.describe_row(30 + r).substr(11));
    EXPECT_EQ(to.heat.get(5, 1), -31.0f);
    EXPECT_EQ(to.guess[5], 7.0f);
    EXPECT_EQ(to.velocity[3], (Vec3{}));
    EXPECT_EQ(to.velocity[10 - 1], (Vec3{35, 70, 105}));
}

TEST(Table, RowsMayBeCopiedOntoRowsThatOverlap) {
    Pebbles p(20);
    fill(p, 20);
    p.copy_rows(p, 0, 3, 10);
    for (uint32_t r = 0; r < 10; ++r) EXPECT_EQ(p.mass[3 + r], 0.5 * r);
}

TEST(Table, ClearedRowsAreZeroAndTheirNeighboursAreNot) {
    Pebbles p(20);
    fill(p, 20);
    p.clear_rows(5, 3);
    EXPECT_EQ(p.mass[4], 2.0);
    for (uint32_t r = 5; r < 8; ++r) EXPECT_EQ(p.mass[r], 0.0);
    EXPECT_EQ(p.mass[8], 4.0);
}

TEST(Table, StagedTablesSwapRowsLimitsAndMemory) {
    Pebbles live(10), staged(1000);
    fill(live, 3);
    fill(staged, 500);
    const float* place = staged.velocity.lane(2);
    live.swap(staged);
    EXPECT_EQ(live.size(), 500u);
    EXPECT_EQ(live.limit(), 1000u);
    EXPECT_EQ(live.velocity.lane(2), place);
    EXPECT_EQ(live.velocity[499], (Vec3{499, 998, 1497}));
    EXPECT_EQ(live.append(500), 500u);
    live.velocity.set(999, {1, 2, 3});
    EXPECT_EQ(staged.size(), 3u);
    EXPECT_EQ(staged.append(8), kNone);
}  // and both go without freeing what is the other's

TEST(Table, ItsHashFeelsEveryStateColumnAndNoScratch) {
    Pebbles p(8), q(8);
    fill(p, 8);
    fill(q, 8);
    const uint64_t hash = p.hash(7);
    EXPECT_EQ(q.hash(7), hash);
    EXPECT_NE(q.hash(8), hash);
    // Any byte of any array of any State column, found through the list of columns.
    uint32_t felt = 0;
    for (const ColumnInfo& c : p.columns()) {
        for (int a = 0; a < c.lanes * c.sides; ++a)
            for (uint32_t byte = 0; byte < c.row_bytes; ++byte) {
                auto* memory = reinterpret_cast<ColumnMemory*>(reinterpret_cast<std::byte*>(&p) + c.offset)->array[a];
                std::byte& changed = memory[5 * c.row_bytes + byte];
                changed ^= std::byte{1};
                EXPECT_EQ(p.hash(7) == hash, c.keep == Keep::Scratch) << c.name << " array " << a << " byte " << byte;
                EXPECT_EQ(p.first_difference(q).empty(), c.keep == Keep::Scratch) << c.name;
                changed ^= std::byte{1};
                ++felt;
            }
    }
    EXPECT_EQ(felt, p.bytes_a_row());
    EXPECT_EQ(p.hash(7), hash);
    p.truncate(7);
    EXPECT_NE(p.hash(7), hash);
}

TEST(Table, MinusZeroIsAnotherState) {
    Pebbles p(2), q(2);
    p.append(1), q.append(1);
    p.mass[0] = -0.0;
    EXPECT_NE(p.hash(0), q.hash(0));
    EXPECT_EQ(p.first_difference(q), "pebbles.mass[0]: -0 here, 0 there");
}

TEST(Table, ValidationNamesThePlaceOfAValueThatIsNotFinite) {
    Pebbles p(1000);
    fill(p, 900);
    EXPECT_EQ(p.validate(), "");
    p.velocity.set(812, {1, std::numeric_limits<float>::quiet_NaN(), 1});
    EXPECT_EQ(p.validate(), "pebbles.velocity[812].y is nan, not a finite number");
    p.velocity.set(812, {1, 1, -std::numeric_limits<float>::infinity()});
    EXPECT_EQ(p.validate(), "pebbles.velocity[812].z is -inf, not a finite number");
    p.velocity.set(812, {});
    p.weight[3][4] = std::numeric_limits<float>::infinity();
    EXPECT_EQ(p.validate(), "pebbles.weight[3] is 0 0 0 0 inf, not a finite number");
    p.weight[3][4] = 0;
    p.centre.set(1, {0, 0, std::numeric_limits<double>::quiet_NaN()});
    EXPECT_EQ(p.validate(), "pebbles.centre[1].z is nan, not a finite number");
    p.centre.set(1, {});
    p.velocity.set(899, {1, std::numeric_limits<float>::infinity(), 1});
    EXPECT_EQ(p.validate(), "pebbles.velocity[899].y is inf, not a finite number");
    p.velocity.set(899, {std::numeric_limits<float>::max(), -std::numeric_limits<float>::denorm_min(), 1});
    EXPECT_EQ(p.validate(), "");
    p.centre.set(1, {0, 0, std::numeric_limits<double>::quiet_NaN()});
    p.truncate(1);
    EXPECT_EQ(p.validate(), "");
}

TEST(Table, TheFirstDifferenceIsOneSentence) {
    Pebbles p(1000), q(1000);
    fill(p, 900), fill(q, 900);
    EXPECT_EQ(p.first_difference(q), "");
    p.velocity.set(812, {812, 1.5f, 2436});
    q.velocity.set(812, {812, 1.25f, 2436});
    EXPECT_EQ(p.first_difference(q), "pebbles.velocity[812].y: 1.5 here, 1.25 there");
    q.velocity.set(812, {812, 1.5f, 2436});
    q.heat.set(7, 3, 1);
    EXPECT_EQ(p.first_difference(q), "pebbles.heat[7]: -7 here, 3 there");
    p.heat.set(7, 3, 1);
    q.turn[2].y = 0.5f;
    EXPECT_EQ(p.first_difference(q), "pebbles.turn[2]: 0 0 0 0 here, 0 0.5 0 0 there");
    q.append(1);
    EXPECT_EQ(p.first_difference(q), "pebbles: 900 rows here, 901 there");
}

TEST(Table, PlainBytesThatDifferFarInsideAreShownWhereTheyDiffer) {
    Blobs p(2), q(2);
    p.append(2), q.append(2);
    p.blob[1].byte[38] = 0xab;
    EXPECT_EQ(p.first_difference(q), "blobs.blob[1]: byte 38 ab00 here, byte 38 0000 there");
}

TEST(Table, ARowPrintsItsColumnsWithTheirUnits) {
    Pebbles p(2);
    fill(p, 2);
    const std::string text = p.describe_row(1);
    EXPECT_EQ(text.find("pebbles[1] velocity=1,2,3 m/s mass=0.5 kg kind=1 colour=0"), 0u) << text;
}

TEST(Table, TwoThreadsMayMakeTheFirstTwoTablesOfATypeAtOnce) {
    std::atomic<int> ready{0};
    size_t columns[2] = {};
    bool are_right[2] = {};
    const auto make = [&](int t) {
        ++ready;
        while (ready < 2) {
        }
        Latecomers table(100);
        columns[t] = table.columns().size();
        table.append(100);
        table.b.set(99, {1, 2, 3});
        table.c[99] = 4;
        are_right[t] = table.describe_row(99) == "latecomers[99] a=0 b=1,2,3 c=4";
    };
    std::thread other(make, 1);
    make(0);
    other.join();
    for (int t = 0; t < 2; ++t) {
        EXPECT_EQ(columns[t], 3u);
        EXPECT_TRUE(are_right[t]);
    }
}

TEST(Table, MemoryOfAHostThatDoesNotZeroItStillGivesZeroRows) {
    HostAllocator host;
    static int blocks = 0;
    host.allocate = [](void*, size_t size, size_t alignment) {
        void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
        std::memset(memory, 0xcd, size);
        ++blocks;
        return memory;
    };
    host.release = [](void*, void* memory, size_t) {
        std::free(memory);
        --blocks;
    };
    {
        std::unique_ptr<Pebbles> theirs;
        {
            const MemoryScope scope(host);
            theirs = std::make_unique<Pebbles>(10u);
        }
        EXPECT_GT(blocks, 0);
        theirs->append(10);
        Pebbles ours(10);
        ours.append(10);
        EXPECT_EQ(theirs->first_difference(ours), "");
        EXPECT_EQ(theirs->hash(3), ours.hash(3));
        theirs->swap(ours);
    }
    EXPECT_EQ(blocks, 0);
}

}  // namespace
}  // namespace cullet
