#include "systems/structures/shell/cut_shell.hpp"

#include <algorithm>
#include <cmath>

#include "systems/structures/shell/cut_edge.hpp"
#include "systems/structures/shell/insert_vertex.hpp"
#include "systems/structures/shell/mesh_quality.hpp"
#include "systems/structures/shell/split_fans.hpp"

namespace cullet {
namespace {

// Of Vertices.copy while a cut is made: how many of the vertex's edges come apart, and whether it was interior before.
constexpr uint32_t kWasInterior = 1u << 31;
constexpr float kFlat = 0.05f;  // sine of the angle under which a surface counts as crossing an edge
// At an edge with a pinned end: how near to it a vertex is put, and the share of C5's limits on the shape that holds. A
// narrow strip along the pins hangs on; beyond these it counts as nothing, and all that is cut off falls.
constexpr float kSnapAtPins = 0.05f, kShapeAtPins = 0.2f;
// Of how far the smaller part reaches: so far from the surface an end of an edge may lie that is taken for it. Doubled,
// masses are off by a tenth where triangles are large; halved, fine meshes get slivers.
constexpr float kMayBeOff = 0.05f;
// Share of C5's limits on the shape where no end is near enough.
constexpr float kShapeElse = 1e-4f;
// Of the mean edge: vertices that are put on the surface lie on it by rounding.
constexpr float kOnSurface = 1e-3f;
// Of an edge: so far beyond the cut a box has to reach to hold that side. One that ends at the cut does not.
constexpr float kBeyond = 0.01f;

/// Of an edge.
struct Crossing {
    float tau = 0;  // share of its length; 0: it does not cross
    float off = 0;  // m, of its nearer end from the surface
};

struct Cutting {
    ShellView shell;
    const CutSurface& surface;
    const PinBoxes& pin_boxes;
    Range pins;
    float layer;       // share of the way through the wall where the surface is looked for
    float may_be_off;  // m, of a vertex that is taken for one on the surface
    CutReport report;
    Touched touched;

    ShellRows& state() const { return shell.state; }
    Vec3 place_of(uint32_t vertex) const { return place_in_wall(shell, vertex, layer); }
    CutSide side_of(uint32_t vertex) const { return surface.side(place_of(vertex)); }

    Vec3 middle_of(uint32_t element) const {
        Vec3 sum;
        for (const uint32_t v : state().elements.corner[shell.element(element)]) sum += place_of(v);
        return (1.0f / 3) * sum;
    }
    bool is_far(uint32_t element) const {
        return surface.is_far_from(
            state().vertices.rest[shell.vertex(state().elements.corner[shell.element(element)][0])]);
    }
    bool is_left(uint32_t element) const { return surface.side(middle_of(element)).distance >= 0; }

    /// One end of edge k is pinned and the other is not.
    bool is_at_pins(uint32_t element, uint32_t k) const {
        const auto& corner = state().elements.corner[shell.element(element)];
        const auto& is_pinned = state().vertices.is_pinned;
        return is_pinned[shell.vertex(corner[k])] != is_pinned[shell.vertex(corner[(k + 1) % 3])];
    }

    /// Where edge k of the element crosses the surface.
    Crossing crossing(uint32_t element, uint32_t k) const {
        const auto& corner = state().elements.corner[shell.element(element)];
        const uint32_t p = corner[k], q = corner[(k + 1) % 3];
        const CutSide a = side_of(p), b = side_of(q);
        if ((a.distance >= 0) == (b.distance >= 0)) return {};
        const float off_a = std::fabs(a.distance), off_b = std::fabs(b.distance), both = off_a + off_b;
        const Vec3 from = place_of(p), to = place_of(q);
        const float edge = length(to - from);
        // An edge that lies in the surface but for a few degrees is opened as it is. Signs also change half way between
        // two arms of a line, far from both: there the distances add up to more than the edge is long.
        if ((both < kFlat * edge && both <= may_be_off) || both > 1.001f * edge) return {};
        const float tau = surface.is_plane() ? off_a / both : surface.crossing(from, to);
        const CutSide at = surface.side(from + tau * (to - from));
        if (!at.is_beside || std::fabs(at.distance) > kOnSurface * edge) return {};
        return {tau, std::min(off_a, off_b)};
    }
};

// Whether a vertex is to be put there.
bool is_wanted(const Cutting& cutting, uint32_t element, uint32_t k, const Crossing& at, bool& is_full) {
    if (!(at.tau > 0)) return false;
    const bool is_at_pins = cutting.is_at_pins(element, k), is_near = at.off <= cutting.may_be_off;
    const float snap = is_at_pins ? kSnapAtPins : is_near ? kSnap : 0;
    if (is_near && (at.tau <= snap || at.tau >= 1 - snap)) return false;
    const float share = is_near ? (is_at_pins ? kShapeAtPins : 1) : kShapeElse;
    return can_insert(cutting.shell, element, k, at.tau, is_full, share);
}

// Elements that an insertion makes stand at the end and are looked at in turn. Half of the spare vertices are for the
// copies that the cut itself needs, one a vertex on it.
void insert_vertices(Cutting& cutting) {
    const ShellView shell = cutting.shell;
    const uint32_t most = (shell.vertices().capacity - shell.vertex_count()) / 2 + shell.vertex_count();
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        if ((cutting.state().elements.flags[shell.element(e)] & kDead) || cutting.is_far(e)) continue;
        for (uint32_t k = 0; k < 3;) {
            const Crossing at = cutting.crossing(e, k);
            bool is_full = false;
            if (shell.vertex_count() < most && is_wanted(cutting, e, k, at, is_full)) {
                insert_vertex(shell, e, k, at.tau, cutting.touched);
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

// Not where the sides change half way between two arms of a line. An edge is as near to the surface as it is long, or
// as what is taken for one on it: beside a jagged line a few short ones lay farther off and held the parts together.
bool comes_apart(const Cutting& cutting, uint32_t element, uint32_t k) {
    const ShellView shell = cutting.shell;
    if (cutting.state().elements.flags[shell.element(element)] & kDead) return false;
    const uint32_t other = cutting.state().elements.neighbour[shell.element(element)][k];
    if (other == kNone || cutting.is_left(element) == cutting.is_left(other)) return false;
    if (cutting.surface.is_plane()) return true;
    const auto& corner = cutting.state().elements.corner[shell.element(element)];
    const Vec3 from = cutting.place_of(corner[k]), to = cutting.place_of(corner[(k + 1) % 3]);
    const CutSide middle = cutting.surface.side(0.5f * (from + to));
    return middle.is_beside && std::fabs(middle.distance) <= std::max(length(to - from), cutting.may_be_off);
}

// Counts the edges of each vertex that come apart. Edge by edge from its lower element, as they are opened.
uint32_t count_cuts(Cutting& cutting) {
    const ShellView shell = cutting.shell;
    Vertices& vertices = cutting.state().vertices;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) vertices.copy[shell.vertex(v)] = 0;
    uint32_t count = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3 && !cutting.is_far(e); ++k) {
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

/// Whether a box reaches beyond the cut to the side that the vertex's elements are on: at an edge that leads there.
bool is_held_at_cut(const Cutting& cutting, uint32_t vertex, const Ring& ring, bool is_left, float on_surface) {
    const ShellView shell = cutting.shell;
    const ShellRows& state = cutting.state();
    const Vec3 from = state.vertices.rest[shell.vertex(vertex)];
    const float own = std::fabs(cutting.side_of(vertex).distance);
    for (uint32_t i = 0; i < ring.count; ++i)
        for (const uint32_t v : state.elements.corner[shell.element(ring.element[i])]) {
            const CutSide side = cutting.side_of(v);
            if (v == vertex || (side.distance >= 0) != is_left || std::fabs(side.distance) <= on_surface) continue;
            const float along = std::min(own / (own + std::fabs(side.distance)) + kBeyond, 1.0f);
            const Vec3 to = state.vertices.rest[shell.vertex(v)];
            if (is_held(cutting.pin_boxes, cutting.pins, from + along * (to - from))) return true;
        }
    return false;
}

/// Vertices that the cut was drawn to, and new ones on it. Others keep what they have.
void pin_along_cut(Cutting& cutting) {
    if (cutting.pins.count == 0) return;
    const ShellView shell = cutting.shell;
    Vertices& vertices = cutting.state().vertices;
    const float on_surface = kOnSurface * shell.shells().mean_edge[shell.row];
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        if (vertices.element[row] == kNone) continue;
        const CutSide own = cutting.side_of(v);
        if (!own.is_beside) continue;
        Ring ring;
        walk_ring(shell, v, ring);
        if (ring.count == 0 || ring.is_cut_short) continue;
        const bool is_left = cutting.is_left(ring.element[0]);
        bool is_on_one_side = true;
        for (uint32_t i = 1; i < ring.count; ++i)
            is_on_one_side = is_on_one_side && cutting.is_left(ring.element[i]) == is_left;
        const bool is_on_surface = std::fabs(own.distance) <= on_surface;
        if (!is_on_surface && (!is_on_one_side || is_left == (own.distance >= 0))) continue;
        // Where the cut ends its last vertex has elements on both sides.
        const bool is_pinned = is_on_one_side ? is_held_at_cut(cutting, v, ring, is_left, on_surface)
                                              : is_held(cutting.pin_boxes, cutting.pins, vertices.rest[row]);
        if (is_pinned == (vertices.is_pinned[row] != 0)) continue;
        vertices.is_pinned[row] = is_pinned;
        weigh_vertex(shell, v);
        ++cutting.report.pins_changed;
    }
}

}  // namespace

CutReport cut_shell(ShellView shell, const CutSurface& surface, const PinBoxes& pin_boxes, Range pins,
                    const CutRepair& repair) {
    const CutReach reach = reach_of(shell, surface);
    Cutting cutting{shell, surface, pin_boxes, pins, reach.layer, kMayBeOff * reach.smaller(), {}, Touched(repair)};
    Shells& shells = shell.shells();
    shells.packs[shell.row].count = shells.blocks[shell.row].count = shells.links[shell.row].count = 0;
    insert_vertices(cutting);
    const bool opens = count_cuts(cutting) > 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (uint32_t k = 0; k < 3 && !cutting.is_far(e); ++k) {
            const uint32_t other = shell.state.elements.neighbour[shell.element(e)][k];
            if (other == kNone || other < e || !comes_apart(cutting, e, k)) continue;
            if (open_edge(cutting, e, k))
                ++cutting.report.cut_edges;
            else
                cutting.report.is_full = true;
        }
    if (opens) mark_cracks(cutting);
    pin_along_cut(cutting);
    if (cutting.report.cut_edges) shell.structures().has_cracks[shell.structure] = 1;
    if (opens || cutting.report.pins_changed > 0) cutting.touched.repair.limit(shell);
    return cutting.report;
}

}  // namespace cullet
