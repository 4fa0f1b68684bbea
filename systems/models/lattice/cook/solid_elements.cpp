#include "systems/models/lattice/cook/solid_elements.hpp"

#include <algorithm>

#include "engine/assert.hpp"

namespace cullet {
namespace {

constexpr uint32_t kNoNode = 0xffffffffu;
constexpr size_t kSurfaceProbes = 4;

// Gradient of the barycentric coordinate of corner k.
Vec3d gradient_of(const std::array<Vec3d, 4>& p, uint32_t k, double six_volumes) {
    const Vec3d &a = p[(k + 1) % 4], &b = p[(k + 2) % 4], &c = p[(k + 3) % 4];
    const double sign = k % 2 == 0 ? -1 : 1;
    return sign / six_volumes * cross(b - a, c - a);
}

Barycentric barycentric(const SolidElements& solid, const SolidElement& element, Vec3d place) {
    Barycentric at{};
    for (uint32_t k = 0; k < 4; ++k) {
        const Vec3d from = solid.places[element.node[(k + 1) % 4]];
        at[k] = dot(element.gradient[k], place - from);
    }
    return at;
}

// Of the elements that the cell has parts in, the one that the place lies in, or least outside of.
ElementPlace place_in(const SolidElements& solid, uint32_t cell, Vec3d place) {
    ElementPlace best;
    double inside = -1e300;
    for (uint32_t i = solid.first_part[cell]; i < solid.first_part[cell + 1]; ++i) {
        const uint32_t e = solid.parts[i].element;
        const Barycentric at = barycentric(solid, solid.elements[e], place);
        const double least = *std::min_element(at.begin(), at.end());
        if (least > inside) inside = least, best = {e, at};
    }
    return best;
}

void number_nodes(const Solid& solid, SolidElements& made) {
    std::vector<uint32_t> element_of(solid.lattice.coarse.size(), kNoNode),
        node_of(solid.lattice.points.size(), kNoNode);
    for (const CellMoments& row : solid.moments) element_of[row.coarse] = 0;
    for (uint32_t c = 0; c < element_of.size(); ++c) {
        if (element_of[c] == kNoNode) continue;
        element_of[c] = static_cast<uint32_t>(made.elements.size());
        SolidElement element;
        for (uint32_t k = 0; k < 10; ++k) {
            uint32_t& node = node_of[solid.lattice.coarse[c][k]];
            if (node == kNoNode) {
                node = static_cast<uint32_t>(made.places.size());
                made.places.push_back(solid.lattice.points[solid.lattice.coarse[c][k]]);
            }
            element.node[k] = node;
        }
        std::array<Vec3d, 4> p;
        for (uint32_t k = 0; k < 4; ++k) p[k] = made.places[element.node[k]];
        const double six_volumes = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
        CULLET_ASSERT(six_volumes > 0, "coarse tetrahedron %u is turned over", c);
        element.volume = six_volumes / 6;
        for (uint32_t k = 0; k < 4; ++k) element.gradient[k] = gradient_of(p, k, six_volumes);
        made.elements.push_back(element);
    }
    made.first_part.assign(solid.cells.size() + 1, 0);
    for (const CellMoments& row : solid.moments) {
        ++made.first_part[row.cell + 1];
        made.parts.push_back({element_of[row.coarse], row.moments});
    }
    for (size_t c = 0; c < solid.cells.size(); ++c) made.first_part[c + 1] += made.first_part[c];
}

void place_probes(const Solid& solid, SolidElements& made) {
    std::vector<std::vector<uint32_t>> surface(solid.cells.size());
    for (uint32_t i = 0; i < solid.patches.size(); ++i) {
        surface[solid.patches[i].cell].push_back(i);
        made.patches.push_back(place_in(made, solid.patches[i].cell, solid.patches[i].centroid));
    }
    made.first_probe.push_back(0);
    for (uint32_t c = 0; c < solid.cells.size(); ++c) {
        made.probes.push_back(place_in(made, c, solid.cells[c].centroid));
        const auto is_larger = [&](uint32_t a, uint32_t b) {
            const double p = solid.patches[a].area, q = solid.patches[b].area;
            return p != q ? p > q : a < b;
        };
        std::sort(surface[c].begin(), surface[c].end(), is_larger);
        for (size_t i = 0; i < std::min(kSurfaceProbes, surface[c].size()); ++i)
            made.probes.push_back(made.patches[surface[c][i]]);
        made.first_probe.push_back(static_cast<uint32_t>(made.probes.size()));
    }
}

}  // namespace

double volume_of(const Moments& moments) {
    double sum = 0;
    for (uint32_t i = 0; i < 4; ++i)
        for (uint32_t k = 0; k < 4; ++k) sum += moments[kMomentPlace[i][k]];
    return sum;
}

Vec3d centroid_of(const Moments& moments, const SolidElements& solid, const SolidElement& element) {
    Vec3d sum;
    double volume = 0;
    for (uint32_t i = 0; i < 4; ++i) {
        double share = 0;
        for (uint32_t k = 0; k < 4; ++k) share += moments[kMomentPlace[i][k]];
        sum += share * solid.places[element.node[i]];
        volume += share;
    }
    return 1 / volume * sum;
}

std::array<double, 10> shape_integrals(const Moments& moments) {
    std::array<double, 10> integral{};
    for (uint32_t i = 0; i < 4; ++i) {
        double share = 0;
        for (uint32_t k = 0; k < 4; ++k) share += moments[kMomentPlace[i][k]];
        integral[i] = 2 * moments[kMomentPlace[i][i]] - share;
    }
    for (uint32_t m = 0; m < 6; ++m) integral[4 + m] = 4 * moments[kMomentPlace[kMiddleEnds[m][0]][kMiddleEnds[m][1]]];
    return integral;
}

std::array<double, 10> shapes_at(const Barycentric& at) {
    std::array<double, 10> shape{};
    for (uint32_t i = 0; i < 4; ++i) shape[i] = at[i] * (2 * at[i] - 1);
    for (uint32_t m = 0; m < 6; ++m) shape[4 + m] = 4 * at[kMiddleEnds[m][0]] * at[kMiddleEnds[m][1]];
    return shape;
}

SolidElements make_elements(const Solid& solid) {
    SolidElements made;
    number_nodes(solid, made);
    place_probes(solid, made);
    std::vector<uint32_t> nodes;
    for (const SolidElement& element : made.elements)
        nodes.insert(nodes.end(), element.node.begin(), element.node.end());
    made.plan = plan_elimination(graph_of(static_cast<uint32_t>(made.places.size()), nodes, 10), made.places, 3);
    for (const SolidElement& element : made.elements) {
        auto& entries = made.entries.emplace_back();
        for (uint32_t i = 0; i < 10; ++i)
            for (uint32_t k = 0; k <= i; ++k) {
                const uint32_t p = made.plan.rank[element.node[i]], q = made.plan.rank[element.node[k]];
                entries[pair_of(i, k)] = made.plan.entry(std::max(p, q), std::min(p, q));
            }
    }
    return made;
}

}  // namespace cullet
