// Cases 3 and 4: distances of faces, and sub-shells of a square.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sample_game/metal/metal_bench.hpp"
#include "sample_game/metal/truth_metal.hpp"

namespace cullet {
namespace {

/// Three unit right triangles: the second is folded off the first about their longest side, the third off the second
/// about a short one.
Mesh twice_folded(double first, double second) {
    const double half = std::sqrt(0.5);
    const Vec3d middle(0.5, 0.5, 0), out(half, half, 0), up(0, 0, 1);
    double sine, cosine;
    sine_cosine(first, sine, cosine);
    const Vec3d corner = middle + half * (cosine * out + sine * up);
    // About the side from (0, 1, 0) to that corner.
    const Vec3d from(0, 1, 0), to(1, 0, 0), side = normalised(corner - from);
    const Vec3d arm = to - from - dot(to - from, side) * side;
    const Vec3d normal = normalised(cross(side, arm));
    sine_cosine(second, sine, cosine);
    const Vec3d last = from + dot(to - from, side) * side - (cosine * arm + sine * length(arm) * normal);
    Mesh mesh;
    mesh.name = "folded";
    for (const Vec3d p : {Vec3d(0, 0, 0), to, from, corner, last}) mesh.positions.push_back(p.to_float());
    mesh.triangles = {{0, 1, 2}, {3, 2, 1}, {4, 2, 3}};
    return mesh;
}

struct Pair {
    double distance = 0, cosine = 0, way = 0;
};
std::vector<Pair> pairs_of(const Mesh& mesh, FaceDistance kind) {
    const Result<Surface> surface = prepare_surface(mesh);
    std::vector<Pair> pairs;
    if (!surface.ok()) return pairs;
    DualSettings settings;
    settings.distance = kind, settings.link_distance = 0;
    const DualGraph graph = build_dual_graph(*surface, settings);
    for (uint32_t f = 0; f < graph.face_count(); ++f)
        for (const DualEdge& edge : graph.of(f)) {
            if (edge.face < f) continue;
            const FaceShape a = shape_of(*surface, f), b = shape_of(*surface, edge.face);
            std::vector<Vec3d> shared;
            for (const uint32_t v : surface->triangles[f])
                for (const uint32_t w : surface->triangles[edge.face])
                    if (surface->position_ids[v] == surface->position_ids[w]) shared.push_back(surface->positions[v]);
            if (shared.size() != 2) continue;
            const Vec3d middle = 0.5 * (shared[0] + shared[1]);
            pairs.push_back(
                {edge.distance, dot(a.normal, b.normal), length(a.centroid - middle) + length(middle - b.centroid)});
        }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.cosine > b.cosine; });
    return pairs;
}

}  // namespace

std::vector<Verdict> metal_face_distance() {
    constexpr double kPi = std::numbers::pi;
    const Mesh mesh = twice_folded(0.5 * kPi, 0.9999 * kPi);
    const std::vector<Pair> paper = pairs_of(mesh, FaceDistance::Paper),
                            ours = pairs_of(mesh, FaceDistance::Normalised);
    if (paper.size() != 2 || ours.size() != 2)
        return {{"pairs of faces", static_cast<double>(std::min(paper.size(), ours.size())), 2, 2}};
    const double mean_angle = 0.5 * (2 - ours[0].cosine - ours[1].cosine), mean_way = 0.5 * (ours[0].way + ours[1].way);
    const auto angle_of = [&](const Pair& p) { return 2 * (p.distance - 0.5 * p.way / mean_way) * mean_angle; };
    return {{"as published, folded by 90 degrees: over (1 + way) / 2", paper[0].distance / (0.5 + 0.5 * paper[0].way),
             0.9999, 1.0001},
            {"as published, folded flat: what its angle counts for", 2 * paper[1].distance - paper[1].way, 0, 1e-4},
            {"ours, folded by 90 degrees: its angle over the mean", angle_of(ours[0]), 0.999, 1.001},
            {"ours, folded flat: twice that", angle_of(ours[1]), 1.999, 2.001}};
}

// Of a square that is the same in both halves, both ways: the sum is four times that of a quarter with its middle as
// the representative, but for the faces at the borders, which are as near to two.
std::vector<Verdict> metal_square() {
    const auto sums_of = [](uint32_t edge, double size, uint32_t cells, double& least, double& most) {
        const Result<Surface> surface = prepare_surface(metal_sheet(size, size, edge, edge));
        SubShellSettings settings;
        settings.count = cells, settings.representatives = Representatives::Exact;
        const Segmentation made = find_sub_shells(*surface, build_dual_graph(*surface), settings);
        std::vector<uint32_t> sizes(made.count());
        for (const uint16_t cell : made.cell_of) ++sizes[cell];
        least = *std::min_element(sizes.begin(), sizes.end()), most = *std::max_element(sizes.begin(), sizes.end());
        return made;
    };
    double least = 0, most = 0, ignored = 0;
    const Segmentation four = sums_of(32, 1, 4, least, most), quarter = sums_of(16, 0.5, 1, ignored, ignored);
    double rise = 0;
    for (size_t k = 1; k < four.sums.size(); ++k) rise = std::max(rise, four.sums[k] / four.sums[k - 1] - 1);
    return {{"sub-shells", static_cast<double>(four.count()), 4, 4},
            {"the smallest over a quarter", least / 512, 0.9, 1},
            {"the largest over a quarter", most / 512, 1, 1.1},
            {"sum of distances over four times that of a quarter", four.sums.back() / (4 * quarter.sums.back()), 0.97,
             1.03},
            {"the most that the sum rises in a round, of it", rise, 0, 1e-12}};
}

}  // namespace cullet
