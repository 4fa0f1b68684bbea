#include "engine/bullet/box_tree.hpp"

#include <algorithm>

namespace cullet::bullet {
namespace {

Box joined(const Box& a, const Box& b) {
    Box out = a;
    include(out, b.low);
    include(out, b.high);
    return out;
}

// Half of the surface: how likely a stray box meets this one.
float surface(const Box& box) {
    const Vec3 size = box.high - box.low;
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

}  // namespace

uint32_t BoxTree::take() {
    if (free_ == kNone) {
        nodes_.emplace_back();
        return static_cast<uint32_t>(nodes_.size() - 1);
    }
    const uint32_t node = free_;
    free_ = nodes_[node].child[0];
    nodes_[node] = {};
    return node;
}

void BoxTree::give(uint32_t node) {
    nodes_[node].child[0] = free_;
    free_ = node;
}

// Down to where the surfaces of all boxes grow least.
uint32_t BoxTree::place_for(const Box& box) const {
    uint32_t at = root_;
    while (nodes_[at].height > 0) {
        const Node& node = nodes_[at];
        const float both = surface(joined(node.box, box));
        const float grown_above = 2 * (both - surface(node.box));  // whatever child takes it
        const auto cost_below = [&](uint32_t child) {
            const Node& below = nodes_[child];
            const float grows = surface(joined(below.box, box));
            return grown_above + (below.height == 0 ? grows : grows - surface(below.box));
        };
        const float first = cost_below(node.child[0]), second = cost_below(node.child[1]);
        if (2 * both < first && 2 * both < second) break;  // a new parent for both
        at = node.child[first <= second ? 0 : 1];
    }
    return at;
}

uint32_t BoxTree::add(const Box& box, uint32_t item) {
    const uint32_t leaf = take();
    nodes_[leaf].box = box;
    nodes_[leaf].item = item;
    if (root_ == kNone) {
        root_ = leaf;
        return leaf;
    }
    const uint32_t beside = place_for(box), above = nodes_[beside].parent, pair = take();
    nodes_[pair].parent = above;
    nodes_[pair].child[0] = beside;
    nodes_[pair].child[1] = leaf;
    replace_child(above, beside, pair);
    nodes_[beside].parent = nodes_[leaf].parent = pair;
    renew_upwards(pair);
    return leaf;
}

void BoxTree::remove(uint32_t leaf) {
    const uint32_t pair = nodes_[leaf].parent;
    give(leaf);
    if (pair == kNone) {
        root_ = kNone;
        return;
    }
    const uint32_t above = nodes_[pair].parent;
    const uint32_t beside = nodes_[pair].child[nodes_[pair].child[0] == leaf ? 1 : 0];
    nodes_[beside].parent = above;
    replace_child(above, pair, beside);
    give(pair);
    renew_upwards(above);
}

void BoxTree::replace_child(uint32_t parent, uint32_t old_child, uint32_t new_child) {
    if (parent == kNone)
        root_ = new_child;
    else
        nodes_[parent].child[nodes_[parent].child[0] == old_child ? 0 : 1] = new_child;
}

void BoxTree::renew(uint32_t node) {
    Node& n = nodes_[node];
    const Node &one = nodes_[n.child[0]], &two = nodes_[n.child[1]];
    n.box = joined(one.box, two.box);
    n.height = 1 + std::max(one.height, two.height);
}

void BoxTree::renew_upwards(uint32_t node) {
    while (node != kNone) {
        renew(node);
        node = nodes_[balance(node)].parent;
    }
}

// Where one child is higher than the other by two, it takes the node's place and gives it its own lower child.
// Returns what stands there now.
uint32_t BoxTree::balance(uint32_t node) {
    Node& n = nodes_[node];
    const uint32_t heights[2] = {nodes_[n.child[0]].height, nodes_[n.child[1]].height};
    const int high = heights[1] > heights[0] ? 1 : 0;
    if (heights[high] - heights[1 - high] < 2) return node;
    const uint32_t risen = n.child[high];
    Node& r = nodes_[risen];
    const int higher = nodes_[r.child[1]].height > nodes_[r.child[0]].height ? 1 : 0;
    const uint32_t given = r.child[1 - higher];
    replace_child(n.parent, node, risen);
    r.parent = n.parent;
    r.child[1 - higher] = node;
    n.parent = risen;
    n.child[high] = given;
    nodes_[given].parent = node;
    renew(node);
    renew(risen);
    return risen;
}

}  // namespace cullet::bullet
