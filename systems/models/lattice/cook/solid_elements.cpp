#include "systems/models/lattice/cook/solid_elements.hpp"

#include <algorithm>

#include "engine/assert.hpp"
#include "systems/cook/disjoint_sets.hpp"

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

// The two rows of solid.moments that a bond joins.
struct RowPair {
    uint32_t a = 0, b = 0;
};

uint32_t row_of(const Solid& solid, uint32_t cell, uint32_t coarse) {
    const auto is_before = [](const CellMoments& row, const std::pair<uint32_t, uint32_t>& wanted) {
        return std::pair(row.cell, row.coarse) < wanted;
    };
    const auto at = std::lower_bound(solid.moments.begin(), solid.moments.end(), std::pair(cell, coarse), is_before);
    const bool is_there = at != solid.moments.end() && at->cell == cell && at->coarse == coarse;
    return is_there ? static_cast<uint32_t>(at - solid.moments.begin()) : kNoNode;
}

// Faces count as seen from their first tetrahedron, bonds from their lower cell: either may be the one in it.
std::vector<RowPair> pair_rows(const Solid& solid) {
    const CoverLattice& lattice = solid.lattice;
    std::vector<RowPair> pairs;
    for (const SolidBond& bond : solid.bonds) {
        const auto& corners = lattice.fine[bond.tetrahedron];
        const Vec3d from = lattice.points[corners[(bond.face + 1) % 4]] - lattice.points[corners[bond.face]];
        const bool is_a_first = dot(bond.normal, from) > 0;
        const uint32_t own = lattice.coarse_of[bond.tetrahedron];
        const uint32_t beyond = lattice.coarse_of[lattice.neighbours[bond.tetrahedron][bond.face]];
        const RowPair pair{row_of(solid, bond.a, is_a_first ? own : beyond),
                           row_of(solid, bond.b, is_a_first ? beyond : own)};
        if (pair.a != kNoNode && pair.b != kNoNode) pairs.push_back(pair);
    }
    // What was merged into one cell hangs together, too.
    for (uint32_t i = 0; i + 1 < solid.moments.size(); ++i)
        for (uint32_t k = i + 1; k < solid.moments.size() && solid.moments[k].cell == solid.moments[i].cell; ++k)
            pairs.push_back({i, k});
    return pairs;
}

// Legs that pass through one coarse tetrahedron move apart: each part that hangs together in it is an element of its
// own, and shares nodes only with those that it hangs together with. (Molino et al. 2004, virtual nodes.)
void number_nodes(const Solid& solid, SolidElements& made) {
    const std::vector<RowPair> pairs = pair_rows(solid);
    DisjointSets copies(solid.moments.size()), nodes(10 * solid.moments.size());
    for (const RowPair& pair : pairs)
        if (solid.moments[pair.a].coarse == solid.moments[pair.b].coarse) copies.unite(pair.a, pair.b);
    for (const RowPair& pair : pairs) {
        const TenNodes& p = solid.lattice.coarse[solid.moments[pair.a].coarse];
        const TenNodes& q = solid.lattice.coarse[solid.moments[pair.b].coarse];
        const uint32_t a = copies.find(pair.a), b = copies.find(pair.b);
        if (a == b) continue;
        for (uint32_t i = 0; i < 10; ++i)
            for (uint32_t k = 0; k < 10; ++k)
                if (p[i] == q[k]) nodes.unite(10 * a + i, 10 * b + k);
    }
    std::vector<std::pair<uint32_t, uint32_t>> order;  // coarse tetrahedron, copy
    for (uint32_t row = 0; row < solid.moments.size(); ++row)
        if (copies.find(row) == row) order.push_back({solid.moments[row].coarse, row});
    std::sort(order.begin(), order.end());
    std::vector<uint32_t> element_of(solid.moments.size(), kNoNode), node_of(10 * solid.moments.size(), kNoNode);
    for (const auto& [coarse, copy] : order) {
        element_of[copy] = static_cast<uint32_t>(made.elements.size());
        SolidElement element;
        for (uint32_t k = 0; k < 10; ++k) {
            uint32_t& node = node_of[nodes.find(10 * copy + k)];
            if (node == kNoNode) {
                node = static_cast<uint32_t>(made.places.size());
                made.places.push_back(solid.lattice.points[solid.lattice.coarse[coarse][k]]);
            }
            element.node[k] = node;
        }
        std::array<Vec3d, 4> p;
        for (uint32_t k = 0; k < 4; ++k) p[k] = made.places[element.node[k]];
        const double six_volumes = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
        CULLET_ASSERT(six_volumes > 0, "coarse tetrahedron %u is turned over", coarse);
        element.volume = six_volumes / 6;
        for (uint32_t k = 0; k < 4; ++k) element.gradient[k] = gradient_of(p, k, six_volumes);
        made.elements.push_back(element);
    }
    made.first_part.assign(solid.cells.size() + 1, 0);
    for (uint32_t row = 0; row < solid.moments.size(); ++row) {
        ++made.first_part[solid.moments[row].cell + 1];
        made.parts.push_back({element_of[copies.find(row)], solid.moments[row].moments});
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
