#include "systems/cook/crossings.hpp"

#include <algorithm>

#include "systems/hulls/box_tree.hpp"
#include "systems/hulls/triangle_test.hpp"

namespace cullet {
namespace {

// Strangers' walls of stones have one crossing a triangle, a hundred looks. Beyond these a soup takes hours.
constexpr uint64_t kLooksATriangle = 2000, kCrossingsATriangle = 100, kMostAnyway = 100'000;

void sort_unique(std::vector<std::array<uint32_t, 2>>& pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace

Result<std::vector<std::array<uint32_t, 2>>> find_crossings(const Surface& surface) {
    const LocalFrame frame(surface.low, surface.diagonal);
    std::vector<Vec3d> points;
    points.reserve(surface.positions.size());
    for (const Vec3d p : surface.positions) points.push_back(frame(p));
    const BoxTree tree(triangle_boxes(points, surface.triangles));

    std::vector<Corner3> corners(surface.triangles.size());
    for (size_t t = 0; t < corners.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            corners[t].point[k] = points[surface.triangles[t][k]];
            corners[t].id[k] = surface.position_ids[surface.triangles[t][k]];
        }
    std::vector<std::array<uint32_t, 2>> crossings;
    const uint64_t most_looks = kLooksATriangle * corners.size() + kMostAnyway;
    const uint64_t most_crossings = kCrossingsATriangle * corners.size() + kMostAnyway;
    uint64_t looks = 0;
    tree.for_each_overlap([&](uint32_t a, uint32_t b) {
        AxisHint hint{1, 1};  // the normal: a smooth surface bends away from the plane of a triangle
        if (are_touching(corners[a], corners[b], hint)) crossings.push_back({std::min(a, b), std::max(a, b)});
        return ++looks <= most_looks && crossings.size() <= most_crossings;
    });
    if (looks > most_looks || crossings.size() > most_crossings)
        return Error{"more than " + std::to_string(crossings.size() - 1) + " pairs of its " +
                     std::to_string(corners.size()) +
                     " triangles cut or touch each other. Remove the copies, or give the surface without its inside."};
    sort_unique(crossings);
    return crossings;
}

std::vector<std::array<uint32_t, 2>> find_independent(const Surface& surface) {
    std::vector<std::array<uint32_t, 2>> pairs;
    const auto add = [&](uint32_t c, uint32_t d) {
        if (c == d) return;
        pairs.push_back({c, d});
        pairs.push_back({d, c});
    };
    for (const auto& [a, b] : surface.crossings) add(surface.component_of[a], surface.component_of[b]);

    // Vertices at one position are neighbours in number; each belongs to one component.
    std::vector<uint32_t> component_of_vertex(surface.positions.size());
    for (size_t t = 0; t < surface.triangles.size(); ++t)
        for (const uint32_t v : surface.triangles[t]) component_of_vertex[v] = surface.component_of[t];
    for (uint32_t v = 0; v < surface.positions.size(); ++v)
        for (uint32_t w = v; w-- > 0 && surface.position_ids[w] == surface.position_ids[v];)
            add(component_of_vertex[v], component_of_vertex[w]);
    sort_unique(pairs);
    return pairs;
}

}  // namespace cullet
