#include "systems/hulls/box_levels.hpp"

#include "systems/hulls/morton.hpp"

namespace cullet {
namespace {

constexpr uint32_t kCells = 1024;  // an axis

uint32_t cell_of(float at, float low, float high) {
    const float share = kCells * ((at - low) / (high - low));
    return share > 0 ? static_cast<uint32_t>(std::min(share, kCells - 1.0f)) : 0;  // 0 for what is no number
}

Vec3 middle(const AxisBox& e) {
    return 0.5f * (e.low + e.high);
}

}  // namespace

void BoxLevels::reserve(size_t items) {
    order_.reserve(items);
    sorted_.reserve(items);
    codes_.reserve(items);
    levels_.reserve(items / 7 + 2 * kMostLevels);
}

void BoxLevels::build(std::span<const uint32_t> items, std::span<const AxisBox> extents) {
    AxisBox all;
    for (const uint32_t item : items) all.include(middle(extents[item]));
    order_.assign(items.begin(), items.end());
    codes_.resize(items.size());
    sorted_.resize(items.size());
    // Codes by place.
    for (size_t k = 0; k < items.size(); ++k) {
        const Vec3 at = middle(extents[items[k]]);
        codes_[k] = spread_bits(cell_of(at.x, all.low.x, all.high.x)) |
                    spread_bits(cell_of(at.y, all.low.y, all.high.y)) << 1 |
                    spread_bits(cell_of(at.z, all.low.z, all.high.z)) << 2;
        order_[k] = static_cast<uint32_t>(k);
    }
    sort_by_code(codes_, order_, sorted_);
    for (uint32_t& place : order_) place = items[place];

    levels_.clear();
    level_count_ = 0;
    for (uint32_t below = static_cast<uint32_t>(items.size()), from = 0; below > 0;) {
        const uint32_t first = static_cast<uint32_t>(levels_.size()), count = (below + kFan - 1) / kFan;
        first_[level_count_] = first;
        for (uint32_t k = 0; k < count; ++k) {
            AxisBox box;
            for (uint32_t i = kFan * k; i < std::min(kFan * (k + 1), below); ++i)
                box.include(level_count_ == 0 ? extents[order_[i]] : levels_[from + i]);
            levels_.push_back(box);
        }
        ++level_count_;
        from = first;
        below = count > 1 ? count : 0;
    }
}

}  // namespace cullet
