// Boxes over boxes, eight by eight, in Morton order: one fixed shape for any number of items, built anew in a few
// nanoseconds an item and without asking for memory.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/math.hpp"

namespace cullet {

/// Axis-aligned; empty until something is included.
struct AxisBox {
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    void include(Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    void include(const AxisBox& e) {
        low = {std::min(low.x, e.low.x), std::min(low.y, e.low.y), std::min(low.z, e.low.z)};
        high = {std::max(high.x, e.high.x), std::max(high.y, e.high.y), std::max(high.z, e.high.z)};
    }
};

class BoxLevels {
 public:
    void reserve(size_t items);
    /// Over the items named; `extents` is looked up by their numbers. Equal codes keep the order of the list.
    void build(std::span<const uint32_t> items, std::span<const AxisBox> extents);
    /// The box of everything.
    AxisBox whole() const { return levels_.empty() ? AxisBox{} : levels_.back(); }

    /// visit(item) for items below boxes that are no farther than `limit()`, which may fall while it runs; nearer boxes
    /// first. `far(extent)` is how far a box is, at least: the same unit, infinite for never. The items' own boxes are
    /// left to the visitor.
    template <class Far, class Limit, class Visit>
    void visit(Far&& far, Limit&& limit, Visit&& visit) const;

 private:
    static constexpr uint32_t kFan = 8, kMostLevels = 10;
    std::vector<uint32_t> order_, sorted_, codes_;
    std::vector<AxisBox> levels_;  // of 8 items each, then of 8 of those, ..., the last one of all
    uint32_t first_[kMostLevels + 1] = {}, level_count_ = 0;
};

template <class Far, class Limit, class Visit>
void BoxLevels::visit(Far&& far, Limit&& limit, Visit&& visit_item) const {
    struct Node {
        uint32_t level, place;
        double far;
    };
    Node stack[kFan * kMostLevels];
    uint32_t height = 0;
    if (level_count_ > 0) stack[height++] = {level_count_ - 1, 0, far(levels_.back())};
    while (height > 0) {
        const Node node = stack[--height];
        if (!(node.far <= limit())) continue;
        const uint32_t below =
            node.level == 0 ? static_cast<uint32_t>(order_.size()) : first_[node.level] - first_[node.level - 1];
        const uint32_t from = kFan * node.place, to = std::min(from + kFan, below), base = height;
        if (node.level == 0) {
            for (uint32_t k = from; k < to; ++k) visit_item(order_[k]);
            continue;
        }
        for (uint32_t k = from; k < to; ++k) {
            const Node child{node.level - 1, k, far(levels_[first_[node.level - 1] + k])};
            if (!(child.far <= limit())) continue;
            uint32_t at = height++;  // the nearest on top
            for (; at > base && stack[at - 1].far < child.far; --at) stack[at] = stack[at - 1];
            stack[at] = child;
        }
    }
}

}  // namespace cullet
