// Ranges of rows in a table whose bodies come and go: first fit by lowest row, neighbours merged when freed. What it
// hands out depends on the order of calls alone. Allocates only when it is made.
// With room for twice as many holes as ranges are ever out, no row is ever lost: holes number at most one more.
#pragma once
#include <cstdint>
#include <vector>

namespace cullet {

struct ByteWriter;
class ByteReader;

class RangePool {
 public:
    /// Rows [0, limit); at most `range_limit` holes. Ranges start at multiples of `alignment`, a power of two.
    RangePool(uint32_t limit, uint32_t alignment, uint32_t range_limit = 1u << 14);

    /// First row of a range of at least `count` rows, or kNone when no hole is large enough. count 0 gives row 0.
    uint32_t take(uint32_t count);
    void give_back(uint32_t first, uint32_t count);
    /// `count` as take() rounds it: the rows that the range really has.
    uint32_t rounded(uint32_t count) const { return (count + alignment_ - 1) & ~(alignment_ - 1); }
    /// One past the highest row in use now.
    uint32_t end() const;
    uint64_t hash(uint64_t seed) const;
    void save(ByteWriter& out) const;
    /// In place of what it holds: holes that rise, lie apart, start where ranges may and end within the limit.
    void load(ByteReader& in);
    /// Whether rows [first, first + count) are handed out, all of them.
    bool is_taken(uint32_t first, uint32_t count) const;

 private:
    struct Hole {
        uint32_t first, count;
    };
    uint32_t limit_, alignment_, range_limit_;
    std::vector<Hole> holes_;  // by first row
};

}  // namespace cullet
