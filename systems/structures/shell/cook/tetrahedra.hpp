// The three tetrahedra of a prism element, cut so that neighbours agree on every side quad: on side (a, b) the diagonal
// starts at the outer corner with the smaller vertex id.
#pragma once
#include <array>
#include <cstdint>

#include "engine/math.hpp"

namespace cullet {

/// With the vertices sorted, p < q < r, and primes inside: {p, q, r, r'}, {p, q, q', r'}, {p, p', q', r'}. Each holds
/// both ends of one vertex (r, q, p in this order), so depth 0 there makes just that one flat.
struct PrismTetrahedra {
    std::array<double, 3> volume;     // m3, positive when the prism is the right way round
    std::array<uint8_t, 3> flattens;  // corner (0 to 2) of the element whose depth 0 makes this one flat
    double total() const { return (volume[0] + volume[1]) + volume[2]; }
};

/// outer is counter-clockwise seen from outside, inner[k] lies inward of outer[k], ids are the vertex ids.
inline PrismTetrahedra prism_tetrahedra(const std::array<Vec3d, 3>& outer, const std::array<Vec3d, 3>& inner,
                                        const std::array<uint32_t, 3>& ids) {
    std::array<uint8_t, 3> at{0, 1, 2};
    double parity = 1.0 / 6.0;
    const auto order = [&](size_t a, size_t b) {
        if (ids[at[a]] < ids[at[b]]) return;
        const uint8_t kept = at[a];
        at[a] = at[b], at[b] = kept;
        parity = -parity;
    };
    order(0, 1), order(1, 2), order(0, 1);
    const Vec3d p = outer[at[0]], q = outer[at[1]] - p, r = outer[at[2]] - p;
    const Vec3d pi = inner[at[0]] - p, qi = inner[at[1]] - p, ri = inner[at[2]] - p;
    return {{-parity * dot(ri, cross(q, r)), parity * dot(q, cross(qi, ri)), -parity * dot(pi, cross(qi, ri))},
            {at[2], at[1], at[0]}};
}

/// The two triangles of the rim quad under border edge a -> b, in outer (false) and inner (true) corners, facing out of
/// the shell.
struct RimCorner {
    uint32_t vertex;
    bool is_inner;
};
inline std::array<std::array<RimCorner, 3>, 2> rim_triangles(uint32_t a, uint32_t b) {
    if (a < b) return {{{{{b, false}, {a, false}, {b, true}}}, {{{a, false}, {a, true}, {b, true}}}}};
    return {{{{{b, false}, {a, false}, {a, true}}}, {{{b, false}, {a, true}, {b, true}}}}};
}

}  // namespace cullet
