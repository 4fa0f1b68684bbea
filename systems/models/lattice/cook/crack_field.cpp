#include "systems/models/lattice/cook/crack_field.hpp"

#include <algorithm>

namespace cullet {

CrackField make_crack_field(const Solid& solid) {
    CrackField field;
    std::vector<uint32_t> node_of(solid.lattice.points.size(), 0xffffffffu), nodes;
    std::vector<Vec3d> places;
    for (const SolidCell& cell : solid.cells)
        for (const uint32_t p : solid.lattice.fine[cell.tetrahedron]) {
            if (node_of[p] == 0xffffffffu)
                node_of[p] = static_cast<uint32_t>(places.size()), places.push_back(solid.lattice.points[p]);
            nodes.push_back(node_of[p]);
        }
    field.plan = plan_elimination(graph_of(static_cast<uint32_t>(places.size()), nodes, 4), places, 1);
    for (size_t c = 0; c < solid.cells.size(); ++c) {
        CrackFieldCell& made = field.cells.emplace_back();
        std::array<Vec3d, 4> p;
        for (uint32_t k = 0; k < 4; ++k) {
            made.rank[k] = field.plan.rank[nodes[4 * c + k]];
            p[k] = places[nodes[4 * c + k]];
        }
        const double six_volumes = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
        for (uint32_t k = 0; k < 4; ++k) {
            const Vec3d &a = p[(k + 1) % 4], &b = p[(k + 2) % 4], &d = p[(k + 3) % 4];
            made.gradient[k] = (k % 2 == 0 ? -1 : 1) / six_volumes * cross(b - a, d - a);
            made.centroid[k] = dot(made.gradient[k], solid.cells[c].centroid - a);
        }
        for (uint32_t i = 0, at = 0; i < 4; ++i)
            for (uint32_t k = 0; k <= i; ++k)
                made.entries[at++] =
                    field.plan.entry(std::max(made.rank[i], made.rank[k]), std::min(made.rank[i], made.rank[k]));
    }
    return field;
}

}  // namespace cullet
