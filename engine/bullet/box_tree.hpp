// A tree of boxes, for everything that asks what is near: leaves stand wide about what they hold, so that what hardly
// moves costs nothing.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/assert.hpp"
#include "engine/bullet/hull.hpp"

namespace cullet::bullet {

/// Nodes are reserved once. Kept in balance by rotations (Adelson-Velsky and Landis 1962), so that a walk needs little
/// room; which leaf hangs where depends on the past, so answers come in no order to rely on.
class BoxTree {
 public:
    static constexpr uint32_t kNone = 0xffffffffu;

    explicit BoxTree(uint32_t leaf_limit) { nodes_.reserve(2 * static_cast<size_t>(leaf_limit)); }
    /// Returns the leaf's number, good until it is removed.
    uint32_t add(const Box& box, uint32_t item);
    void remove(uint32_t leaf);
    const Box& box(uint32_t leaf) const { return nodes_[leaf].box; }
    void shift(Vec3 by) {
        for (Node& node : nodes_) node.box = {node.box.low + by, node.box.high + by};
    }
    /// Calls found(item) for all leaves that meet the box.
    template <class Found>
    void visit(const Box& box, Found found) const {
        if (root_ == kNone) return;
        uint32_t open[kMostOpen], count = 0;
        open[count++] = root_;
        while (count > 0) {
            const Node& node = nodes_[open[--count]];
            if (!overlap(node.box, box, 0)) continue;
            if (node.height == 0) {
                found(node.item);
                continue;
            }
            CULLET_ASSERT(count + 2 <= kMostOpen, "a tree of boxes is %u high", nodes_[root_].height);
            open[count++] = node.child[0];
            open[count++] = node.child[1];
        }
    }

 private:
    static constexpr uint32_t kMostOpen = 64;  // a tree in balance of 2^32 leaves is 46 high
    struct Node {
        Box box;
        uint32_t parent = kNone;
        uint32_t child[2] = {kNone, kNone};  // of a free node the first is the next free one
        uint32_t height = 0;                 // 0: a leaf
        uint32_t item = 0;
    };
    uint32_t take();
    void give(uint32_t node);
    uint32_t place_for(const Box& box) const;
    void renew(uint32_t node);
    void renew_upwards(uint32_t node);
    uint32_t balance(uint32_t node);
    void replace_child(uint32_t parent, uint32_t old_child, uint32_t new_child);

    std::vector<Node> nodes_;
    uint32_t root_ = kNone, free_ = kNone;
};

}  // namespace cullet::bullet
