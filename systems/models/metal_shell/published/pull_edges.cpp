#include "systems/models/metal_shell/published/pull_edges.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr double kOverRelaxed = 1.2;
constexpr double kShortest = 1e-9;  // m: it has no direction

double yielding(const MetalView& metal, uint32_t v, double moved_share) {
    const uint32_t row = metal.vertex(v);
    const double area = double{metal.vertices().area[row]};
    if (metal.is_pinned(v) || !(area > 0)) return 0;
    return (metal.vertices().field[row] > 0 ? moved_share : 1) / area;
}

uint32_t most_neighbours(const MetalView& metal) {
    uint32_t most = 1;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        uint32_t own = 0;
        metal.for_each_spring(v, [&](uint32_t, uint32_t spring) { own += !metal.springs().is_tie[spring]; });
        most = std::max(most, own);
    }
    return most;
}

}  // namespace

void sum_areas(const MetalView& metal) {
    MetalVertices& vertices = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) vertices.area[metal.vertex(v)] = 0;
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        if (metal.is_dead(e)) continue;
        const auto& c = metal.corners(e);
        const Vec3 p = vertices.original[metal.vertex(c[0])];
        const float third =
            length(cross(vertices.original[metal.vertex(c[1])] - p, vertices.original[metal.vertex(c[2])] - p)) / 6;
        for (const uint32_t v : c) vertices.area[metal.vertex(v)] += third;
    }
}

void pull_edges(const MetalView& metal, double moved_share) {
    MetalVertices& vertices = metal.vertices();
    const double step = kOverRelaxed / most_neighbours(metal);
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        const double own = yielding(metal, v, moved_share);
        const Vec3d place(vertices.place[row]), start(vertices.start[row]);
        Vec3d sum;
        metal.for_each_spring(v, [&](uint32_t other, uint32_t spring) {
            if (metal.springs().is_tie[spring]) return;
            const uint32_t at = metal.vertex(other);
            const double both = own + yielding(metal, other, moved_share);
            const Vec3d way = Vec3d(vertices.place[at]) - place;
            const double now = length(way);
            if (!(now > kShortest) || !(both > 0)) return;
            sum += ((now - length(Vec3d(vertices.start[at]) - start)) / (now * both)) * way;
        });
        vertices.next.set(row, (place + (step * own) * sum).to_float());
    }
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        vertices.place.set(metal.vertex(v), vertices.next[metal.vertex(v)]);
}

Vec3d cut_short(Vec3d fixed, Vec3d fixed_before, Vec3d moved, Vec3d moved_before, double most_stretch) {
    const Vec3d before = moved_before - fixed_before;
    if (!(length(moved - fixed) > (1 + most_stretch) * length(before))) return moved;
    return fixed + (1 + most_stretch) * before;
}

// Edge by edge in the order of the vertices: what is published says nothing of one end that several edges want
// elsewhere.
void cut_long_edges(const MetalView& metal, double most_stretch) {
    MetalVertices& vertices = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        metal.for_each_spring(v, [&](uint32_t other, uint32_t spring) {
            if (other < v || metal.springs().is_tie[spring]) return;
            const uint32_t at = metal.vertex(other);
            const Vec3d a(vertices.place[row]), b(vertices.place[at]), p(vertices.start[row]), q(vertices.start[at]);
            const bool is_first = length(a - p) > length(b - q);
            if (metal.is_pinned(is_first ? v : other)) return;
            if (is_first)
                vertices.place.set(row, cut_short(b, q, a, p, most_stretch).to_float());
            else
                vertices.place.set(at, cut_short(a, p, b, q, most_stretch).to_float());
        });
    }
}

}  // namespace cullet
