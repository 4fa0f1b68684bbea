// A bounding box tree over items of a mesh: items in 30-bit Morton order, ranges halved, leaves of at most 4. Boxes are
// single precision, rounded outward, so a query may answer too much and never too little.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "engine/math.hpp"

namespace cullet {

/// Coordinates a mesh is worked in: moved to its low corner and scaled by a power of two (exact), so that the diagonal
/// is in [0.5, 1). Tolerances are absolute there.
struct LocalFrame {
    Vec3d origin;      // m
    double scale = 1;  // 1/m
    LocalFrame(Vec3d low, double diagonal) : origin(low) {
        while (scale * diagonal >= 1) scale /= 2;
        while (scale * diagonal < 0.5) scale *= 2;
    }
    Vec3d operator()(Vec3d p) const { return scale * (p - origin); }
};

/// Four lanes so that one comparison does all axes; the fourth stays 0.
struct TreeBox {
    alignas(16) std::array<float, 4> low{1e30f, 1e30f, 1e30f, 0}, high{-1e30f, -1e30f, -1e30f, 0};

    /// Local coordinates stay below 4, where rounding to float moves a number by at most 1.2e-7.
    void grow(Vec3d p) {
        for (int k = 0; k < 3; ++k) {
            const size_t axis = static_cast<size_t>(k);
            low[axis] = std::min(low[axis], static_cast<float>(p[k]) - 2.5e-7f);
            high[axis] = std::max(high[axis], static_cast<float>(p[k]) + 2.5e-7f);
        }
    }
    void grow(const TreeBox& b) {
        for (size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], b.low[k]), high[k] = std::max(high[k], b.high[k]);
    }
    bool overlaps(const TreeBox& b) const {
        const auto all = (load(low) <= load(b.high)) & (load(b.low) <= load(high));
        std::array<uint64_t, 2> lanes;
        std::memcpy(lanes.data(), &all, 16);
        return (lanes[0] & lanes[1]) == ~uint64_t{0};
    }
    /// Square of the distance from p (fourth lane 0).
    float distance_squared(const std::array<float, 4>& p) const {
        const Lanes at = load(p), below = load(low) - at, above = at - load(high), zero = {};
        Lanes outside = below > above ? below : above;
        outside = outside > zero ? outside : zero;
        outside *= outside;
        return (outside[0] + outside[1]) + outside[2];
    }

 private:
    // The compiler's own vector type: highway has no four-lane target for the plain x86-64 this is built for.
    typedef float Lanes __attribute__((vector_size(16)));
    static Lanes load(const std::array<float, 4>& a) {
        Lanes lanes;
        std::memcpy(&lanes, a.data(), 16);
        return lanes;
    }
};

struct BoxTree {
    struct Node {
        TreeBox box;
        uint32_t right = 0;  // 0: a leaf; else the right child, the left one being the next node
        uint32_t items = 0;  // 8 * first + count, places in `order`
        bool is_leaf() const { return right == 0; }
        uint32_t first() const { return items >> 3; }
        uint32_t count() const { return items & 7; }
    };
    std::vector<Node> nodes;
    std::vector<uint32_t> order;  // item at each place
    std::vector<TreeBox> boxes;   // by place

    BoxTree() = default;
    explicit BoxTree(std::span<const TreeBox> item_boxes);

    /// visit(a, b), once for every two items whose boxes overlap; false ends it.
    template <class Visit>
    void for_each_overlap(Visit visit) const;
};

/// Boxes of triangles in local coordinates.
std::vector<TreeBox> triangle_boxes(std::span<const Vec3d> points, std::span<const std::array<uint32_t, 3>> triangles);

template <class Visit>
void BoxTree::for_each_overlap(Visit visit) const {
    struct Pair {
        uint32_t a, b;
    };
    std::vector<Pair> stack;
    if (!nodes.empty()) stack.push_back({0, 0});
    while (!stack.empty()) {
        const auto [a, b] = stack.back();
        stack.pop_back();
        const Node &m = nodes[a], &n = nodes[b];
        if (a == b) {
            if (!m.is_leaf()) {
                stack.push_back({a + 1, m.right});
                stack.push_back({m.right, m.right});
                stack.push_back({a + 1, a + 1});
                continue;
            }
            for (uint32_t i = m.first(); i < m.first() + m.count(); ++i)
                for (uint32_t j = i + 1; j < m.first() + m.count(); ++j)
                    if (boxes[i].overlaps(boxes[j]) && !visit(order[i], order[j])) return;
            continue;
        }
        if (m.is_leaf() && n.is_leaf()) {
            for (uint32_t i = m.first(); i < m.first() + m.count(); ++i) {
                if (!boxes[i].overlaps(n.box)) continue;
                for (uint32_t j = n.first(); j < n.first() + n.count(); ++j)
                    if (boxes[i].overlaps(boxes[j]) && !visit(order[i], order[j])) return;
            }
            continue;
        }
        const bool opens_first = !m.is_leaf() && (n.is_leaf() || a < b);
        const uint32_t opened = opens_first ? a : b, kept = opens_first ? b : a;
        for (const uint32_t child : {opened + 1, nodes[opened].right})
            if (nodes[child].box.overlaps(nodes[kept].box))
                stack.push_back(opens_first ? Pair{child, kept} : Pair{kept, child});
    }
}

}  // namespace cullet
