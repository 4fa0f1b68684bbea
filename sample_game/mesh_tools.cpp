#include "sample_game/mesh_tools.hpp"

#include <algorithm>
#include <cmath>

namespace cullet {

Mesh to_mesh(const MeshDraft& surface, const std::string& name) {
    Mesh mesh;
    mesh.name = name;
    mesh.triangles = surface.triangles;
    for (const Vec3d p : surface.points) mesh.positions.push_back(p.to_float());
    return mesh;
}

double usable_edge(double edge, double size) {
    return std::isfinite(edge) ? std::clamp(edge, size / 1000, size) : size / 40;
}

double jitter(uint64_t seed, uint64_t row, uint64_t number, uint64_t channel) {
    // The finaliser of splitmix64 (public domain, S. Vigna), folded over the four words.
    uint64_t x = 0;
    for (const uint64_t word : {seed, row, number, channel}) {
        x = (x ^ word) + 0x9e3779b97f4a7c15ull;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
        x ^= x >> 31;
    }
    return static_cast<double>(x >> 11) / 4503599627370496.0 - 1;  // 53 bits / 2^52 - 1
}

void stitch_rows(MeshDraft& surface, const std::vector<uint32_t>& a, const std::vector<uint32_t>& b, bool is_closed) {
    const auto squared = [&surface](uint32_t p, uint32_t q) {
        const Vec3d d = surface.points[p] - surface.points[q];
        return dot(d, d);
    };
    size_t start = 0;  // the point of b that a[0] is joined to
    if (is_closed)
        for (size_t j = 1; j < b.size(); ++j)
            if (squared(a[0], b[j]) < squared(a[0], b[start])) start = j;
    const size_t steps_a = is_closed ? a.size() : a.size() - 1, steps_b = is_closed ? b.size() : b.size() - 1;
    const auto at_a = [&a](size_t i) { return a[i % a.size()]; };
    const auto at_b = [&b, start](size_t j) { return b[(start + j) % b.size()]; };
    size_t i = 0, j = 0;
    while (i < steps_a || j < steps_b) {
        const bool takes_a =
            j == steps_b || (i < steps_a && squared(at_a(i + 1), at_b(j)) <= squared(at_a(i), at_b(j + 1)));
        if (takes_a) {
            surface.triangles.push_back({at_a(i), at_b(j), at_a(i + 1)});
            ++i;
        } else {
            surface.triangles.push_back({at_a(i), at_b(j), at_b(j + 1)});
            ++j;
        }
    }
}

}  // namespace cullet
