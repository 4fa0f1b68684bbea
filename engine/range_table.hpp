// A table whose rows its owners take in ranges, and give back.
#pragma once
#include "engine/range_pool.hpp"
#include "engine/table.hpp"

namespace cullet {

/// Rows [first, first + count) of a table, with room for `capacity`.
struct Range {
    uint32_t first = 0, count = 0, capacity = 0;
};
template <>
struct ColumnType<Range> : ColumnLayout<Range, Scalar::U32, 3> {};

/// Ranges begin at multiples of `kAlignment`. `owners`: rows of the table that holds the ranges; each has one range, or
/// two while it is moved.
template <class Self, uint32_t kAlignment = 1>
struct RangeTable : Table<Self> {
    explicit RangeTable(uint32_t limit = AnyTable::kDefaultLimit, uint32_t owners = 1u << 12)
        : Table<Self>(limit), pool(limit, kAlignment, 2 * owners + 1) {}

    /// Room for `count` rows, all of them to spare. False: there is none. What new rows hold is the caller's affair.
    bool take(uint32_t count, Range& range) {
        range = {};
        if (count == 0) return true;
        const uint32_t first = pool.take(count);
        if (first == kNone) return false;
        this->reach(pool.end());
        range = {first, 0, count};
        return true;
    }
    void give_back(const Range& range) { pool.give_back(range.first, range.capacity); }
    /// Clears what is to spare of a range, and the rows up to the end of what the pool gave.
    void clear_spare(const Range& range) {
        const uint32_t end = pool.rounded(range.capacity);
        if (range.count < end) this->clear_rows(range.first + range.count, end - range.count);
    }

    RangePool pool;  // which rows are taken
};
template <class T>
inline constexpr bool kIsRanged = requires(T table) {
    table.pool;
};

}  // namespace cullet
