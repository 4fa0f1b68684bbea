#include "systems/models/lattice/cook/crack_paths.hpp"

#include <algorithm>

namespace cullet {
namespace {

/// Lists of small numbers, one after the other.
void gather(size_t count, const std::vector<std::pair<uint32_t, uint32_t>>& pairs, std::vector<uint32_t>& first,
            std::vector<uint32_t>& list) {
    first.assign(count + 1, 0);
    for (const auto& [owner, value] : pairs) {
        ++first[owner + 1];
        list.push_back(value);
    }
    for (size_t i = 0; i < count; ++i) first[i + 1] += first[i];
}

}  // namespace

CrackPaths find_crack_paths(const Solid& solid) {
    CrackPaths paths;
    std::vector<std::pair<uint32_t, uint32_t>> of_cells, at_edges;
    std::vector<std::array<uint32_t, 3>> ends;  // lower point, upper point, place in `edges`
    for (uint32_t b = 0; b < solid.bonds.size(); ++b) {
        of_cells.push_back({solid.bonds[b].a, b});
        of_cells.push_back({solid.bonds[b].b, b});
        const auto& corners = solid.lattice.fine[solid.bonds[b].tetrahedron];
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t p = corners[(solid.bonds[b].face + 1 + k) % 4],
                           q = corners[(solid.bonds[b].face + 1 + (k + 1) % 3) % 4];
            ends.push_back({std::min(p, q), std::max(p, q), 3 * b + k});
        }
    }
    std::sort(of_cells.begin(), of_cells.end());
    gather(solid.cells.size(), of_cells, paths.first_bond, paths.bonds);
    std::sort(ends.begin(), ends.end());
    paths.edges.resize(solid.bonds.size());
    uint32_t edge = 0;
    for (size_t i = 0; i < ends.size(); ++i) {
        if (i > 0 && (ends[i][0] != ends[i - 1][0] || ends[i][1] != ends[i - 1][1])) ++edge;
        paths.edges[ends[i][2] / 3][ends[i][2] % 3] = edge;
        at_edges.push_back({edge, ends[i][2] / 3});
    }
    gather(ends.empty() ? 0 : edge + 1, at_edges, paths.first_at_edge, paths.bonds_at_edge);
    return paths;
}

}  // namespace cullet
