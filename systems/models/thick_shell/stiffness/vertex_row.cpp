#include <bit>

#include "systems/models/thick_shell/stiffness/element_bending.hpp"
#include "systems/models/thick_shell/stiffness/stiffness_slots.hpp"

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
    // Three values of own times three of the other's, by rows: nine in a row are two at a time.
    double own[9], others[9];
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) own[3 * r + c] = gi[r];
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
                for (int c = 0; c < 3; ++c) others[3 * r + c] = gj[c];
            for (int m = 0; m < 9; ++m) k[m] -= stiffness * (own[m] * others[m]);
        }
    }
}

/// The coupled bending of `element`'s hinges, seen from one vertex i that they hold: K_ij = -sum_kl g_k(i) H_kl
/// g_l(j)^T. Pairs of neighbours go to blocks; of all others one end is held by one hinge m alone, so that the pair has
/// rank one, g_m (sum_l H_ml g_l)^T, and goes to a link.
void add_bending(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, uint32_t element, VertexRow& row) {
    const BendingTerms terms(shell, stress, element);
    const BendingVertices held(shell, element);
    const ShellRows& state = shell.state;
    const uint32_t own = held.index_of(vertex);
    if (own == held.count) return;
    const auto gradient = [&](uint32_t k, uint32_t i) {
        Vec3d sum;
        if (terms.hinge[k] == kNone) return sum;
        const uint32_t h = shell.hinge(terms.hinge[k]);
        for (uint32_t s = 0; s < 4; ++s) {
            const float* g = &state.hinges.gradient[h][3 * s];
            if (state.hinges.vertex[h][s] == held.vertex[i]) sum += Vec3d(g[0], g[1], g[2]);
        }
        return sum;
    };
    // Of vertex i, for an angle of hinge l.
    const auto push = [&](uint32_t l, uint32_t i) {
        Vec3d sum;
        for (uint32_t k = 0; k < 3; ++k) sum += terms.h[k][l] * gradient(k, i);
        return sum;
    };
    const Vec3d own_push[3] = {push(0, own), push(1, own), push(2, own)};
    for (uint32_t j = 0; j < held.count; ++j) {
        if (j == own) continue;
        if (held.are_neighbours(own, j)) {
            double* const block = row.block(held.vertex[j]);
            for (uint32_t l = 0; l < 3; ++l) {
                const Vec3d g = gradient(l, j);
                for (int r = 0; r < 3; ++r)
                    for (int c = 0; c < 3; ++c) block[3 * r + c] -= own_push[l][r] * g[c];
            }
            continue;
        }
        if (row.link_count == kMostLinks) continue;
        // Both ends of the pair choose the same one, and so get each other's transpose.
        const uint32_t low = std::min(own, j), single = held.is_held_once(low) ? low : std::max(own, j);
        const uint32_t m = static_cast<uint32_t>(std::countr_zero(held.edges[single]));
        const Vec3d to = own == single ? gradient(m, own) : own_push[m];
        const Vec3d from = own == single ? push(m, j) : gradient(m, j);
        VertexRow::Link& link = row.link[row.link_count++];
        link.neighbour = held.vertex[j];
        for (int k = 0; k < 3; ++k) {
            link.row[k] = static_cast<float>(-to[k]);
            link.column[k] = static_cast<float>(from[k]);
        }
    }
}

}  // namespace

void build_row(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, VertexRow& row) {
    row.block_count = row.link_count = 0;
    Ring ring;
    collect_ring(shell, vertex, ring);
    for (uint32_t i = 0; i < ring.count; ++i) add_triangle(shell, stress, ring.element[i], ring.corner[i], row);
    if (stress.has_grain) {
        HingeElements elements;
        collect_hinge_elements(shell, ring, elements);
        for (uint32_t i = 0; i < elements.count; ++i) add_bending(shell, stress, vertex, elements.element[i], row);
        return;
    }
    RingHinges hinges;
    collect_hinges(shell, ring, hinges);
    for (uint32_t i = 0; i < hinges.count; ++i) add_hinge(shell, vertex, hinges.hinge[i], row);
}

}  // namespace cullet
