#include "engine/import/gltf/nodes.hpp"

#include <cmath>
#include <string>

namespace cullet::gltf {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFFu;
constexpr double kLastRow = 1e-3;  // how far a matrix may be from one that only turns, scales and moves

Affine own_place(const Part& node) {
    if (const auto matrix = node.find("matrix")) return affine_of(matrix->numbers(16).data(), matrix->place());
    double rotation[4] = {0, 0, 0, 1};
    Vec3d translation, scale{1, 1, 1};
    if (const auto part = node.find("translation")) {
        const auto t = part->numbers(3);
        translation = {t[0], t[1], t[2]};
    }
    if (const auto part = node.find("rotation")) {
        const auto r = part->numbers(4);
        for (size_t i = 0; i < 4; ++i) rotation[i] = r[i];
    }
    if (const auto part = node.find("scale")) {
        const auto s = part->numbers(3);
        scale = {s[0], s[1], s[2]};
    }
    return placed_by(translation, rotation, scale, node);
}

struct Tree {
    std::vector<std::vector<uint32_t>> children;
    std::vector<uint32_t> parents;
};

std::string title(uint64_t node) {
    return "nodes[" + std::to_string(node) + "]";
}

Tree read_tree(const Document& document, size_t count) {
    Tree tree{std::vector<std::vector<uint32_t>>(count), std::vector<uint32_t>(count, kNone)};
    for (uint32_t n = 0; n < count; ++n) {
        const auto children = document.root().need("nodes").item(n).find("children");
        if (!children) continue;
        for (size_t i = 0; i < children->size(); ++i) {
            document.named("nodes", children->item(i));
            const auto child = static_cast<uint32_t>(children->item(i).whole(count));
            if (tree.parents[child] != kNone)
                throw Refusal(title(child) + " is a child of " + title(tree.parents[child]) + " and again of " +
                              title(n));
            tree.parents[child] = n;
            tree.children[n].push_back(child);
        }
    }
    return tree;
}

/// Calls visit(node) for the roots given and all below them, parents first.
template <class Visit>
void walk(const Tree& tree, const std::vector<uint32_t>& roots, const Visit& visit) {
    std::vector<uint32_t> stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
        const uint32_t node = stack.back();
        stack.pop_back();
        visit(node);
        const auto& children = tree.children[node];
        stack.insert(stack.end(), children.rbegin(), children.rend());
    }
}

/// Those of the scene that is shown by default; without a scene, all that have no parent.
std::vector<uint32_t> shown_roots(const Document& document, const Tree& tree, const std::vector<uint32_t>& all_roots) {
    const size_t scenes = document.count("scenes");
    if (scenes == 0) return all_roots;
    const auto chosen = document.root().find("scene");
    const Part scene = chosen ? document.named("scenes", *chosen) : document.root().need("scenes").item(0);
    std::vector<uint32_t> roots;
    const auto nodes = scene.find("nodes");
    std::vector<bool> is_root(tree.parents.size());
    for (size_t i = 0; nodes && i < nodes->size(); ++i) {
        document.named("nodes", nodes->item(i));
        const auto root = static_cast<uint32_t>(nodes->item(i).whole(tree.parents.size()));
        if (tree.parents[root] != kNone)
            nodes->item(i).refuse("names " + title(root) + ", which is a child of " + title(tree.parents[root]));
        if (is_root[root]) nodes->item(i).refuse("names " + title(root) + " a second time");
        is_root[root] = true;
        roots.push_back(root);
    }
    return roots;
}

}  // namespace

Affine affine_of(const double* m, const std::string& place) {
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(m[i])) throw Refusal(place + " is a matrix with an entry that is no number");
    if (std::fabs(m[3]) > kLastRow || std::fabs(m[7]) > kLastRow || std::fabs(m[11]) > kLastRow ||
        std::fabs(m[15] - 1) > kLastRow)
        throw Refusal(place + " is a matrix whose last row is not 0 0 0 1");
    Affine affine;
    affine.row[0] = {m[0], m[4], m[8]};
    affine.row[1] = {m[1], m[5], m[9]};
    affine.row[2] = {m[2], m[6], m[10]};
    affine.move = {m[12], m[13], m[14]};
    return affine;
}

Affine placed_by(Vec3d translation, const double* rotation, Vec3d scale, const Part& asker) {
    const double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
    const double squared = x * x + y * y + z * z + w * w;
    if (!(squared > 0) || !std::isfinite(squared)) asker.refuse("has a rotation of no length");
    const double s = 2 / squared;
    Affine affine;
    affine.row[0] = {(1 - s * (y * y + z * z)) * scale.x, s * (x * y - z * w) * scale.y, s * (x * z + y * w) * scale.z};
    affine.row[1] = {s * (x * y + z * w) * scale.x, (1 - s * (x * x + z * z)) * scale.y, s * (y * z - x * w) * scale.z};
    affine.row[2] = {s * (x * z - y * w) * scale.x, s * (y * z + x * w) * scale.y, (1 - s * (x * x + y * y)) * scale.z};
    affine.move = translation;
    return affine;
}

Nodes read_nodes(const Document& document) {
    const size_t count = document.count("nodes");
    const Tree tree = read_tree(document, count);
    std::vector<uint32_t> roots;
    for (uint32_t n = 0; n < count; ++n)
        if (tree.parents[n] == kNone) roots.push_back(n);
    Nodes nodes;
    nodes.places.resize(count);
    std::vector<bool> is_placed(count);
    walk(tree, roots, [&](uint32_t n) {
        const Affine own = own_place(document.root().need("nodes").item(n));
        nodes.places[n] = tree.parents[n] == kNone ? own : chained(nodes.places[tree.parents[n]], own);
        is_placed[n] = true;
    });
    for (uint32_t n = 0; n < count; ++n)
        if (!is_placed[n]) throw Refusal(title(n) + " is its own ancestor, or below one that is");
    walk(tree, shown_roots(document, tree, roots), [&nodes](uint32_t n) { nodes.shown.push_back(n); });
    return nodes;
}

}  // namespace cullet::gltf
