#include "systems/damage/cut_shell.hpp"

#include "systems/damage/assemble.hpp"
#include "systems/damage/crack_rules.hpp"
#include "systems/damage/cut_edge.hpp"
#include "systems/damage/heading.hpp"
#include "systems/damage/insert_vertex.hpp"
#include "systems/damage/split_fans.hpp"

namespace cullet {
namespace {

// Of Vertices.copy while a cut is made: how many of the vertex's edges come apart, and whether it was interior before.
constexpr uint32_t kWasInterior = 1u << 31;
constexpr float kFlat = 0.05f;  // sine of the angle under which a surface counts as crossing an edge

struct Cutting {
    ShellView shell;
    const CutSurface& surface;
    CutReport report;
    Touched touched;

    State& state() const { return shell.state; }
    CutSide side_of(uint32_t vertex) const { return surface.side(middle_of_wall(shell, vertex)); }

    Vec3 middle_of(uint32_t element) const {
        Vec3 sum;
        for (const uint32_t v : state().elements.corner[shell.element(element)]) sum += middle_of_wall(shell, v);
        return (1.0f / 3) * sum;
    }
    bool is_left(uint32_t element) const { return surface.side(middle_of(element)).distance >= 0; }

    /// Where edge k of the element crosses the surface, as a share of its length, or 0. Signs also change half way
    /// between two arms of a line, far from both: there the distances add up to more than the edge is long.
    float crossing(uint32_t element, uint32_t k) const {
        const auto& corner = state().elements.corner[shell.element(element)];
        const uint32_t p = corner[k], q = corner[(k + 1) % 3];
        const CutSide a = side_of(p), b = side_of(q);
        if ((a.distance >= 0) == (b.distance >= 0)) return 0;
        const float both = std::fabs(a.distance) + std::fabs(b.distance);
        const Vec3 from = middle_of_wall(shell, p), to = middle_of_wall(shell, q);
        const float edge = length(to - from);
        // An edge that lies in the surface but for a few degrees is opened as it is.
        if (both < kFlat * edge || both > 1.001f * edge) return 0;
        const float tau = std::fabs(a.distance) / both;
        return surface.side(from + tau * (to - from)).is_beside ? tau : 0;
    }
};

// Elements that an insertion makes stand at the end and are looked at in turn. Half of the spare vertices are for the
// copies that the cut itself needs, one a vertex on it.
void insert_vertices(Cutting& cutting) {
    const ShellView shell = cutting.shell;
    const uint32_t most = (shell.vertices().capacity - shell.vertex_count()) / 2 + shell.vertex_count();
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        if (cutting.state().elements.flags[shell.element(e)] & kDead) continue;
        for (uint32_t k = 0; k < 3;) {
            const float tau = cutting.crossing(e, k);
            bool is_full = false;
            if (tau > kSnap && tau < 1 - kSnap && shell.vertex_count() < most &&
                can_insert(shell, e, k, tau, is_full)) {
                insert_vertex(shell, e, k, tau, cutting.touched);
                cutting.touched.clear();
                ++cutting.report.inserted;
                k = 0;  // its corners are others now
                continue;
            }
            cutting.report.is_full |= is_full;
            ++k;
        }
    }
}

bool comes_apart(const Cutting& cutting, uint32_t element, uint32_t k) {
    const ShellView shell = cutting.shell;
    if (cutting.state().elements.flags[shell.element(element)] & kDead) return false;
    const uint32_t other = cutting.state().elements.neighbour[shell.element(element)][k];
    if (other == kNone || cutting.is_left(element) == cutting.is_left(other)) return false;
    if (cutting.surface.is_plane()) return true;
    const auto& corner = cutting.state().elements.corner[shell.element(element)];
    const Vec3 from = middle_of_wall(shell, corner[k]), to = middle_of_wall(shell, corner[(k + 1) % 3]);
    const CutSide middle = cutting.surface.side(0.5f * (from + to));
    return middle.is_beside && std::fabs(middle.distance) <= length(to - from);
}

// Counts the edges of each vertex that come apart. Edge by edge from its lower element, as they are opened.
uint32_t count_cuts(Cutting& cutting) {
    const ShellView shell = cutting.shell;
    Vertices& vertices = cutting.state().vertices;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) vertices.copy[shell.vertex(v)] = 0;
    uint32_t count = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t other = cutting.state().elements.neighbour[shell.element(e)][k];
            if (other == kNone || other < e || !comes_apart(cutting, e, k)) continue;
            ++count;
            const auto& corner = cutting.state().elements.corner[shell.element(e)];
            for (const uint32_t v : {corner[k], corner[(k + 1) % 3]}) {
                uint32_t& cuts = vertices.copy[shell.vertex(v)];
                if (cuts == 0) {
                    Ring ring;
                    walk_ring(shell, v, ring);
                    if (ring.is_closed) cuts = kWasInterior;
                }
                ++cuts;
            }
        }
    return count;
}

// Opens one edge; either end that falls into fans by it gets its copies at once, so that every ring can be walked
// again. False: no room.
bool open_edge(Cutting& cutting, uint32_t element, uint32_t k) {
    const ShellView shell = cutting.shell;
    if (shell.vertex_count() + 2 > shell.vertices().capacity) return false;
    const auto corner = cutting.state().elements.corner[shell.element(element)];
    const uint32_t p = corner[k], q = corner[(k + 1) % 3];
    Ring of_p, of_q;
    walk_ring(shell, p, of_p);
    walk_ring(shell, q, of_q);
    cut_edge(shell, element, k);
    if (count_fans(shell, of_p) > 1) split_fans(shell, p, of_p, cutting.touched);
    if (count_fans(shell, of_q) > 1) split_fans(shell, q, of_q, cutting.touched);
    cutting.touched.clear();
    return true;
}

// An interior vertex with one edge open is where the cut ends: a tip that goes on straight.
void mark_cracks(Cutting& cutting) {
    const ShellView shell = cutting.shell;
    Vertices& vertices = cutting.state().vertices;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v), cuts = vertices.copy[row];
        if (vertices.element[row] == kNone || cuts == 0) continue;
        vertices.crack_start[row] = kNone;
        vertices.crack[row] = static_cast<uint8_t>(CrackState::Cracked);
        if (cuts != (kWasInterior | 1u)) continue;
        Ring ring;
        walk_ring(shell, v, ring);
        if (ring.count == 0 || ring.is_closed) continue;
        const auto& corner = cutting.state().elements.corner[shell.element(ring.element[0])];
        const Vec3 from = vertices.rest[shell.vertex(corner[(ring.corner[0] + 1) % 3])];
        vertices.crack[row] = static_cast<uint8_t>(CrackState::Tip);
        vertices.heading.set(row, into_plane(vertices.rest[row] - from, ring_normal(shell, ring)));
    }
}

}  // namespace

CutReport cut_shell(ShellView shell, const CutSurface& surface) {
    Cutting cutting{shell, surface, {}, {}};
    Shells& shells = shell.shells();
    shells.packs[shell.row].count = shells.blocks[shell.row].count = shells.links[shell.row].count = 0;
    insert_vertices(cutting);
    if (count_cuts(cutting) == 0) return cutting.report;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t other = shell.state.elements.neighbour[shell.element(e)][k];
            if (other == kNone || other < e || !comes_apart(cutting, e, k)) continue;
            if (open_edge(cutting, e, k))
                ++cutting.report.cut_edges;
            else
                cutting.report.is_full = true;
        }
    mark_cracks(cutting);
    if (cutting.report.cut_edges) shells.has_cracks[shell.row] = 1;
    limit_all_stiffness(shell);
    return cutting.report;
}

}  // namespace cullet
