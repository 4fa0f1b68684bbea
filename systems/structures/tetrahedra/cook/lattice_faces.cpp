#include "systems/structures/tetrahedra/cook/lattice_faces.hpp"

#include <algorithm>

#include "engine/table.hpp"
#include "systems/structures/tetrahedra/cook/cover_lattice.hpp"

namespace cullet {

LatticeFaces number_faces(const CoverLattice& lattice) {
    LatticeFaces made;
    made.of.assign(lattice.fine.size(), {kNone, kNone, kNone, kNone});
    made.faces.reserve(2 * lattice.fine.size() + lattice.fine.size() / 4);
    struct Way {
        uint32_t other, edge;
    };
    std::vector<std::vector<Way>> ways(lattice.points.size());
    const auto edge_between = [&](uint32_t a, uint32_t b) {
        const uint32_t low = std::min(a, b), high = std::max(a, b);
        for (const Way& way : ways[low])
            if (way.other == high) return way.edge;
        ways[low].push_back({high, static_cast<uint32_t>(made.edges.size())});
        made.edges.push_back({low, high});
        return ways[low].back().edge;
    };
    for (uint32_t t = 0; t < lattice.fine.size(); ++t)
        for (uint32_t k = 0; k < 4; ++k) {
            if (made.of[t][k] != kNone) continue;
            LatticeFace face;
            face.tetrahedron = {t, lattice.neighbours[t][k]};
            face.place = k;
            for (uint32_t i = 0; i < 3; ++i) face.corner[i] = lattice.fine[t][kFaceCorners[k][i]];
            for (uint32_t i = 0; i < 3; ++i) {
                const uint32_t a = face.corner[i], b = face.corner[(i + 1) % 3];
                face.edge[i] = edge_between(a, b);
                face.is_forward[i] = a < b;
            }
            const auto number = static_cast<uint32_t>(made.faces.size());
            made.of[t][k] = number;
            if (const uint32_t beside = face.tetrahedron[1]; beside != kNone)
                for (uint32_t i = 0; i < 4; ++i)
                    if (lattice.neighbours[beside][i] == t) made.of[beside][i] = number;
            made.faces.push_back(face);
        }
    return made;
}

}  // namespace cullet
