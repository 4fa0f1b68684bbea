#include "systems/hulls/box_tree.hpp"

#include "systems/hulls/morton.hpp"

namespace cullet {
namespace {

std::vector<uint32_t> morton_codes(std::span<const TreeBox> boxes) {
    TreeBox all;
    for (const TreeBox& b : boxes) all.grow(b);
    std::array<float, 3> per_length{};
    for (size_t k = 0; k < 3; ++k) per_length[k] = 1023.0f / std::max(all.high[k] - all.low[k], 1e-20f);
    std::vector<uint32_t> codes;
    codes.reserve(boxes.size());
    for (const TreeBox& b : boxes) {
        uint32_t code = 0;
        for (size_t k = 0; k < 3; ++k) {
            const float at = (0.5f * (b.low[k] + b.high[k]) - all.low[k]) * per_length[k];
            code |= spread_bits(static_cast<uint32_t>(std::clamp(at, 0.0f, 1023.0f))) << k;
        }
        codes.push_back(code);
    }
    return codes;
}

std::vector<uint32_t> sorted_by_code(const std::vector<uint32_t>& codes) {
    std::vector<uint32_t> order(codes.size()), sorted(codes.size());
    for (uint32_t k = 0; k < order.size(); ++k) order[k] = k;
    sort_by_code(codes, order, sorted);
    return order;
}

}  // namespace

BoxTree::BoxTree(std::span<const TreeBox> item_boxes) {
    if (item_boxes.empty()) return;
    order = sorted_by_code(morton_codes(item_boxes));
    boxes.reserve(order.size());
    for (const uint32_t item : order) boxes.push_back(item_boxes[item]);

    struct Stretch {
        uint32_t first, last, parent;  // parent: whose right child this is, or none
    };
    constexpr uint32_t kNobody = 0xffffffffu;
    nodes.reserve(order.size());
    std::vector<Stretch> stack{{0, static_cast<uint32_t>(order.size()), kNobody}};
    while (!stack.empty()) {
        const Stretch r = stack.back();
        stack.pop_back();
        const uint32_t at = static_cast<uint32_t>(nodes.size());
        if (r.parent != kNobody) nodes[r.parent].right = at;
        nodes.push_back({{}, 0, 8 * r.first + std::min(r.last - r.first, 7u)});
        if (r.last - r.first <= 4) continue;
        const uint32_t middle = r.first + (r.last - r.first) / 2;
        stack.push_back({middle, r.last, at});
        stack.push_back({r.first, middle, kNobody});
    }
    for (size_t n = nodes.size(); n-- > 0;) {
        Node& node = nodes[n];
        if (node.is_leaf()) {
            for (uint32_t k = node.first(); k < node.first() + node.count(); ++k) node.box.grow(boxes[k]);
        } else {
            node.box = nodes[n + 1].box;
            node.box.grow(nodes[node.right].box);
        }
    }
}

std::vector<TreeBox> triangle_boxes(std::span<const Vec3d> points, std::span<const std::array<uint32_t, 3>> triangles) {
    std::vector<TreeBox> boxes(triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t)
        for (const uint32_t v : triangles[t]) boxes[t].grow(points[v]);
    return boxes;
}

}  // namespace cullet
