#include "systems/models/lattice/cook/breakable_solid.hpp"

#include <algorithm>
#include <utility>

#include "engine/random.hpp"

namespace cullet {
namespace {

constexpr uint32_t kNoPart = 0xffffffffu;

void number_parts(const Solid& solid, BreakableSolid& body) {
    body.part.assign(solid.cells.size(), kNoPart);
    std::vector<uint32_t> open;
    for (uint32_t start = 0; start < solid.cells.size(); ++start) {
        if (body.part[start] != kNoPart) continue;
        body.part[start] = body.part_count;
        open.push_back(start);
        while (!open.empty()) {
            const uint32_t c = open.back();
            open.pop_back();
            for (const uint32_t b : body.paths.of_cell(c)) {
                const uint32_t other = solid.bonds[b].a == c ? solid.bonds[b].b : solid.bonds[b].a;
                if (body.part[other] != kNoPart) continue;
                body.part[other] = body.part_count;
                open.push_back(other);
            }
        }
        ++body.part_count;
    }
}

}  // namespace

BreakableSolid make_breakable(Solid solid) {
    BreakableSolid body;
    body.elements = make_elements(solid);
    body.paths = find_crack_paths(solid);
    body.field = make_crack_field(solid);
    number_parts(solid, body);
    body.strength.assign(solid.cells.size(), 1.0f);
    body.solid = std::move(solid);
    return body;
}

void give_normals(BreakableSolid& body, const ClosedMesh& mesh) {
    body.patch_normals.clear();
    for (const SurfacePatch& patch : body.solid.patches) {
        const Triangle& t = mesh.triangles[patch.triangle];
        const Vec3d p = mesh.positions[t[0]];
        body.patch_normals.push_back(normalised(cross(mesh.positions[t[1]] - p, mesh.positions[t[2]] - p)));
    }
}

void scatter_strength(BreakableSolid& body, double modulus, uint64_t seed) {
    const Random random{seed};
    const double mean = body.solid.volume / static_cast<double>(body.solid.cells.size());
    std::vector<double> drawn(body.strength.size());
    double sum = 0;
    for (size_t c = 0; c < drawn.size(); ++c) {
        const double chance = -logarithm(1 - random.uniform(c));
        drawn[c] = chance > 0 ? exponential(logarithm(mean / body.solid.cells[c].volume * chance) / modulus) : 0;
        sum += drawn[c];
    }
    constexpr double kLeast = 0.05;
    for (size_t c = 0; c < drawn.size(); ++c)
        body.strength[c] = static_cast<float>(std::max(kLeast, drawn[c] * static_cast<double>(drawn.size()) / sum));
}

}  // namespace cullet
