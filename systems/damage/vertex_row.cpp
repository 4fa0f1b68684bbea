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

}  // namespace

void build_row(const ShellView& shell, const PlaneStress& stress, uint32_t vertex, VertexRow& row) {
    row.block_count = row.link_count = 0;
    Ring ring;
    collect_ring(shell, vertex, ring);
    for (uint32_t i = 0; i < ring.count; ++i) add_triangle(shell, stress, ring.element[i], ring.corner[i], row);
    RingHinges hinges;
    collect_hinges(shell, ring, hinges);
    for (uint32_t i = 0; i < hinges.count; ++i) add_hinge(shell, vertex, hinges.hinge[i], row);
}

}  // namespace cullet
