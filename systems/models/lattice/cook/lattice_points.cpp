#include "systems/models/lattice/cook/lattice_points.hpp"

#include <algorithm>

namespace cullet {
namespace {
constexpr uint32_t kNobody = 0xffffffffu;
}

LatticePoints find_lattice_points(const CoverLattice& lattice) {
    LatticePoints points;
    const size_t count = lattice.points.size();
    points.first.assign(count + 1, 0);
    for (const auto& corners : lattice.fine)
        for (const uint32_t p : corners) ++points.first[p + 1];
    for (size_t p = 0; p < count; ++p) points.first[p + 1] += points.first[p];
    points.tetrahedra.resize(4 * lattice.fine.size());
    points.shortest.assign(count, 1e30f);
    points.is_rim.assign(count, 0);
    std::vector<uint32_t> at(points.first.begin(), points.first.end() - 1);
    for (uint32_t t = 0; t < lattice.fine.size(); ++t) {
        const auto& corners = lattice.fine[t];
        for (size_t k = 0; k < 4; ++k) {
            points.tetrahedra[at[corners[k]]++] = t;
            for (size_t j = 0; j < 4; ++j) {
                if (j == k) continue;
                float& shortest = points.shortest[corners[k]];
                shortest = std::min(
                    shortest, static_cast<float>(length(lattice.points[corners[j]] - lattice.points[corners[k]])));
                if (lattice.neighbours[t][j] == kNobody) points.is_rim[corners[k]] = 1;
            }
        }
    }
    return points;
}

double volume_of(const CoverLattice& lattice, std::span<const Vec3d> places, uint32_t tetrahedron) {
    const auto& c = lattice.fine[tetrahedron];
    const Vec3d origin = places[c[0]];
    return dot(cross(places[c[1]] - origin, places[c[2]] - origin), places[c[3]] - origin) / 6;
}

}  // namespace cullet
