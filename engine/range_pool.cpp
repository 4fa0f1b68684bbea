#include "engine/range_pool.hpp"

#include <algorithm>

#include "engine/assert.hpp"
#include "engine/byte_stream.hpp"
#include "engine/hash.hpp"
#include "engine/table.hpp"

namespace cullet {

RangePool::RangePool(uint32_t limit, uint32_t alignment, uint32_t range_limit)
    : limit_(limit & ~(alignment - 1)), alignment_(alignment), range_limit_(range_limit ? range_limit : 1) {
    holes_.reserve(range_limit_);
    if (limit_) holes_.push_back({0, limit_});
}

uint32_t RangePool::take(uint32_t count) {
    if (count == 0) return 0;
    if (count > limit_) return kNone;  // also: rounding up would wrap
    count = rounded(count);
    for (size_t h = 0; h < holes_.size(); ++h) {
        if (holes_[h].count < count) continue;
        const uint32_t first = holes_[h].first;
        holes_[h].first += count;
        holes_[h].count -= count;
        if (holes_[h].count == 0) holes_.erase(holes_.begin() + static_cast<std::ptrdiff_t>(h));
        return first;
    }
    return kNone;
}

void RangePool::give_back(uint32_t first, uint32_t count) {
    if (count == 0) return;
    count = rounded(count);
    auto after =
        std::lower_bound(holes_.begin(), holes_.end(), first, [](const Hole& h, uint32_t f) { return h.first < f; });
    CULLET_ASSERT(count <= limit_ && first <= limit_ - count && first % alignment_ == 0,
                  "range %u + %u was never taken: the table has %u rows", first, count, limit_);
    CULLET_ASSERT((after == holes_.end() || first + count <= after->first) &&
                      (after == holes_.begin() || (after - 1)->first + (after - 1)->count <= first),
                  "range %u + %u given back twice", first, count);
    const bool joins_after = after != holes_.end() && first + count == after->first;
    const bool joins_before = after != holes_.begin() && (after - 1)->first + (after - 1)->count == first;
    if (joins_before && joins_after) {
        (after - 1)->count += count + after->count;
        holes_.erase(after);
    } else if (joins_before) {
        (after - 1)->count += count;
    } else if (joins_after) {
        after->first = first;
        after->count += count;
    } else {
        if (holes_.size() == range_limit_) return;  // the rows are lost until the world ends, nothing else
        holes_.insert(after, {first, count});
    }
}

uint32_t RangePool::end() const {
    if (!holes_.empty() && holes_.back().first + holes_.back().count == limit_) return holes_.back().first;
    return limit_;
}

uint64_t RangePool::hash(uint64_t seed) const {
    return hash_bytes(holes_.data(), holes_.size() * sizeof(Hole), seed);
}

void RangePool::save(ByteWriter& out) const {
    out.number(static_cast<uint32_t>(holes_.size()));
    for (const Hole& hole : holes_) out.number(hole.first), out.number(hole.count);
}

void RangePool::load(ByteReader& in) {
    const uint32_t count = in.count("a number of free ranges", 8, range_limit_);
    holes_.clear();
    uint32_t end = 0;
    for (uint32_t k = 0; k < count && in.is_sound(); ++k) {
        const auto first = in.number<uint32_t>("a free range"), rows = in.number<uint32_t>("a free range");
        const bool is_apart = k == 0 || first > end;
        in.expect(is_apart && rows > 0 && first <= limit_ && rows <= limit_ - first && first % alignment_ == 0 &&
                      rows % alignment_ == 0,
                  "the free range " + std::to_string(first) + " + " + std::to_string(rows) + " of " +
                      std::to_string(limit_) + " rows");
        end = first + rows;
        if (in.is_sound()) holes_.push_back({first, rows});
    }
}

bool RangePool::is_taken(uint32_t first, uint32_t count) const {
    if (count == 0) return true;
    if (first > limit_ || rounded(count) > limit_ - first) return false;
    const auto after =
        std::lower_bound(holes_.begin(), holes_.end(), first, [](const Hole& h, uint32_t f) { return h.first < f; });
    return (after == holes_.end() || first + rounded(count) <= after->first) &&
           (after == holes_.begin() || (after - 1)->first + (after - 1)->count <= first);
}

}  // namespace cullet
