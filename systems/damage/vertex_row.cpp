#include "systems/damage/element_bending.hpp"
#include "systems/damage/stiffness_slots.hpp"

namespace cullet {
namespace {

void add_triangle(const ShellView& shell, const PlaneStress& stress, uint32_t element, int i, VertexRow& row) {
    const uint32_t e = shell.element(element);
    const TriangleTerms terms(shell.state.triangle_springs, e, stress);
    for (int step = 1; step < 3; ++step) {
        const int j = (i + step) % 3;
        terms.add_block(i, j, shell.state.triangle_springs.scale[e],
                        row.block(shell.state.elements.corner[e][static_cast<size_t>(j)]));
    }
}

/// Pairs of the edge's ends and of an end with a corner opposite are neighbours; the two corners opposite are a link.
void add_hinge(const ShellView& shell, uint32_t vertex, uint32_t hinge, VertexRow& row) {
    const Hinges& hinges = shell.state.hinges;
    const uint32_t h = shell.hinge(hinge);
    const auto& v = hinges.vertex[h];
    const auto& g = hinges.gradient[h];
    const double stiffness = double{hinges.stiffness[h]} * hinges.scale[h];
    uint32_t i = 0;
    while (i < 4 && v[i] != vertex) ++i;
    if (i == 4) return;
    const float* gi = &g[3 * i];
    for (uint32_t j = 0; j < 4; ++j) {
        if (j == i) continue;
        const float* gj = &g[3 * j];
        if (i + j == 5) {  // 2 and 3
            if (row.link_count == kMostRing) continue;
            VertexRow::Link& link = row.link[row.link_count++];
            link.neighbour = v[j];
            for (int k = 0; k < 3; ++k) link.row[k] = static_cast<float>(-stiffness * gi[k]), link.column[k] = gj[k];
        } else {
            double* k = row.block(v[j]);
            for (int r = 0; r < 3; ++r)
                for (int c = 0; c < 3; ++c) k[3 * r + c] -= stiffness * (double{gi[r]} * gj[c]);
        }
    }
}

/// The coupled bending of `element`'s hinges, seen from one vertex that they hold. Pairs of neighbours go to blocks,
/// the others are rank one and go to links: a vertex opposite an edge is held by one hinge alone.
void add_bending(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, uint32_t element, VertexRow& row) {
    const BendingTerms terms(shell, stress, element);
    const State& state = shell.state;
    const auto& corner = state.elements.corner[shell.element(element)];
    const auto gradient = [&](uint32_t k, uint32_t v) {
        const uint32_t h = shell.hinge(terms.hinge[k]);
        for (size_t i = 0; i < 4; ++i)
            if (state.hinges.vertex[h][i] == v) {
                const float* g = &state.hinges.gradient[h][3 * i];
                return Vec3d(g[0], g[1], g[2]);
            }
        return Vec3d();
    };
    // The six vertices: corners, then the ones across each edge.
    uint32_t held[6] = {corner[0], corner[1], corner[2], kNone, kNone, kNone};
    for (uint32_t k = 0; k < 3; ++k) {
        if (terms.hinge[k] == kNone) continue;
        for (const uint32_t v : state.hinges.vertex[shell.hinge(terms.hinge[k])])
            if (v != corner[0] && v != corner[1] && v != corner[2]) held[3 + k] = v;
    }
    uint32_t own = 0;
    while (own < 6 && held[own] != vertex) ++own;
    if (own == 6) return;
    Vec3d push[3];  // of the vertex, for an angle of each hinge
    for (uint32_t l = 0; l < 3; ++l)
        for (uint32_t k = 0; k < 3; ++k)
            if (terms.hinge[k] != kNone && terms.hinge[l] != kNone) push[l] += terms.h[k][l] * gradient(k, vertex);
    for (uint32_t j = 0; j < 6; ++j) {
        if (j == own || held[j] == kNone) continue;
        const uint32_t out = own >= 3 ? own : j, in = own >= 3 ? j : own;  // `out` is the one across an edge, if any is
        const bool is_neighbour = in < 3 && (out < 3 || in == out - 3 || in == (out - 3 + 1) % 3);
        if (is_neighbour) {
            double* const block = row.block(held[j]);
            for (uint32_t l = 0; l < 3; ++l) {
                if (terms.hinge[l] == kNone) continue;
                const Vec3d g = gradient(l, held[j]);
                for (int r = 0; r < 3; ++r)
                    for (int c = 0; c < 3; ++c) block[3 * r + c] -= push[l][r] * g[c];
            }
            continue;
        }
        if (row.link_count == kMostLinks) continue;
        VertexRow::Link& link = row.link[row.link_count++];
        link.neighbour = held[j];
        Vec3d to, from;
        if (own >= 3) {
            to = gradient(own - 3, vertex);
            for (uint32_t l = 0; l < 3; ++l)
                if (terms.hinge[l] != kNone) from += terms.h[own - 3][l] * gradient(l, held[j]);
        } else {
            to = push[j - 3];
            from = gradient(j - 3, held[j]);
        }
        for (int k = 0; k < 3; ++k) {
            link.row[k] = static_cast<float>(-to[k]);
            link.column[k] = static_cast<float>(from[k]);
        }
    }
}

/// Of all triangles that have a hinge at the vertex: its ring's, and those across from it.
void add_all_bending(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, const Ring& ring,
                     VertexRow& row) {
    for (uint32_t i = 0; i < ring.count; ++i) add_bending(shell, stress, vertex, ring.element[i], row);
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t e = shell.element(ring.element[i]), k = (ring.corner[i] + 1u) % 3;
        const uint32_t across = shell.state.elements.neighbour[e][k];
        if (across != kNone && shell.state.elements.hinge[e][k] != kNone)
            add_bending(shell, stress, vertex, across, row);
    }
}

}  // namespace

void build_row(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, VertexRow& row) {
    row.block_count = row.link_count = 0;
    Ring ring;
    collect_ring(shell, vertex, ring);
    for (uint32_t i = 0; i < ring.count; ++i) add_triangle(shell, stress, ring.element[i], ring.corner[i], row);
    if (stress.has_grain) return add_all_bending(shell, stress, vertex, ring, row);
    RingHinges hinges;
    collect_hinges(shell, ring, hinges);
    for (uint32_t i = 0; i < hinges.count; ++i) add_hinge(shell, vertex, hinges.hinge[i], row);
}

}  // namespace cullet
