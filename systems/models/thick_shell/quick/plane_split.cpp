#include "systems/models/thick_shell/quick/plane_split.hpp"

#include <algorithm>

#include "systems/models/thick_shell/hidden/crack_rules.hpp"
#include "systems/structures/shell/cut_edge.hpp"
#include "systems/structures/shell/insert_vertex.hpp"

namespace cullet {
namespace {

/// Of a crossed edge's length near its ends where the crack takes the end.
constexpr float kPlaneSnap = 0.2f;
/// Least angle, as its squared sine and cosine: 15 degrees; least share of the area.
constexpr float kLeastSine = 0.258819f, kLeastShare = 0.05f;
constexpr float kOnPlane = 1e-6f;  // of the mean edge

struct RingMeasure {
    float height[kMostRing];  // of the centroid above the plane
    float area[kMostRing];
};

RingMeasure measure(ShellView shell, Vec3 place, const Ring& ring, Vec3 normal) {
    RingMeasure m;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const auto& corner = shell.state.elements.corner[shell.element(ring.element[i])];
        const auto rest = [&](int k) { return shell.state.vertices.rest[shell.vertex(corner[k])] - place; };
        const Vec3 a = rest(0), b = rest(1), c = rest(2);
        m.height[i] = dot(normal, (1.0f / 3) * (a + b + c));
        m.area[i] = 0.5f * length(cross(b - a, c - a));
    }
    return m;
}

/// Area that a cut of the ring into [from, to) and the rest puts on the wrong side, the run being above or below.
double wrong_area(const Ring& ring, const RingMeasure& m, const RingSides& sides, uint32_t from, uint32_t to,
                  bool is_run_above) {
    double sum = 0;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const bool is_in = i >= from && i < to;
        if (sides.is_above[i] != (is_in == is_run_above)) sum += m.area[i];
    }
    return sum;
}

// More than two runs: the ring is not convex, or lies almost in the plane. Cycle: every pair of cuts; chain: every
// single one. Ties go to the first.
void mend(const Ring& ring, const RingMeasure& m, RingSides& sides) {
    double least = 1e30;
    uint32_t best_from = 0, best_to = 0;
    bool is_best_above = true;
    for (uint32_t from = 0; from < ring.count; ++from)
        for (uint32_t to = from + 1; to <= ring.count; ++to) {
            if (to - from == ring.count) continue;       // one side would be empty
            if (!ring.is_closed && from != 0) continue;  // a chain's run starts at its start
            for (const bool is_above : {true, false}) {
                const double wrong = wrong_area(ring, m, sides, from, to, is_above);
                if (!(wrong < least)) continue;
                least = wrong, best_from = from, best_to = to, is_best_above = is_above;
            }
        }
    for (uint32_t i = 0; i < ring.count; ++i) sides.is_above[i] = (i >= best_from && i < best_to) == is_best_above;
    sides.was_mended = true;
}

uint32_t count_changes(const Ring& ring, const RingSides& sides) {
    uint32_t changes = 0;
    for (uint32_t i = 0; i + 1 < ring.count; ++i) changes += sides.is_above[i] != sides.is_above[i + 1];
    return changes + (ring.is_closed && sides.is_above[ring.count - 1] != sides.is_above[0]);
}

/// Smallest angle above 15 degrees: its sine is twice the area over the product of two sides; the smallest angle lies
/// between the two longest.
bool is_well_shaped(Vec3 a, Vec3 b, Vec3 c, float whole) {
    const float area = 0.5f * length(cross(b - a, c - a));
    float side[3] = {length(b - a), length(c - b), length(a - c)};
    std::sort(side, side + 3);
    return area >= kLeastShare * whole && 2 * area >= kLeastSine * side[1] * side[2];
}

bool has_place_in_ring(ShellView shell, uint32_t vertex) {
    Ring ring;
    walk_ring(shell, vertex, ring);
    return !ring.is_cut_short && ring.count < kMostRing;
}

/// Both halves of one triangle whose edge k gets a vertex at `place`.
bool halves_well(ShellView shell, uint32_t element, uint32_t k, Vec3 place) {
    const auto& corner = shell.state.elements.corner[shell.element(element)];
    const auto rest = [&](uint32_t i) { return shell.state.vertices.rest[shell.vertex(corner[(k + i) % 3])]; };
    // Of the triangle as cooked: those that were halved before must not be halved without end.
    const float l = shell.shells().mean_edge[shell.row], cooked = kEquilateralArea * l * l;
    const float whole = std::max(cooked, 0.5f * length(cross(rest(1) - rest(0), rest(2) - rest(0))));
    return is_well_shaped(rest(0), place, rest(2), whole) && is_well_shaped(place, rest(1), rest(2), whole) &&
           has_place_in_ring(shell, corner[(k + 2) % 3]);
}

bool may_insert(ShellView shell, uint32_t element, uint32_t k, float tau) {
    const Elements& elements = shell.state.elements;
    const uint32_t row = shell.element(element), other = elements.neighbour[row][k];
    if (elements.edge_kind[row][k] == static_cast<uint8_t>(EdgeKind::Crack)) return false;
    const uint32_t p = elements.corner[row][k], q = elements.corner[row][(k + 1) % 3];
    const Vec3 from = shell.state.vertices.rest[shell.vertex(p)], to = shell.state.vertices.rest[shell.vertex(q)];
    const Vec3 place = from + tau * (to - from);
    if (!halves_well(shell, element, k, place)) return false;
    if (other == kNone) return true;
    const uint32_t j = edge_between(shell, other, q, p);
    const bool is_back_to_back =
        elements.corner[shell.element(other)][(j + 2) % 3] == elements.corner[row][(k + 2) % 3];
    return !is_back_to_back && halves_well(shell, other, j, place);
}

}  // namespace

RingSides choose_sides(ShellView shell, uint32_t vertex, const Ring& ring, Vec3 normal) {
    RingSides sides;
    const RingMeasure m = measure(shell, shell.state.vertices.rest[shell.vertex(vertex)], ring, normal);
    const float least = kOnPlane * shell.shells().mean_edge[shell.row];
    for (uint32_t i = 0; i < ring.count; ++i) {
        float height = m.height[i];
        if (std::fabs(height) < least) {
            const bool has_before = ring.is_closed || i > 0, has_next = ring.is_closed || i + 1 < ring.count;
            const uint32_t before = (i + ring.count - 1) % ring.count, next = (i + 1) % ring.count;
            if (has_next) height = m.height[next];
            if (has_before && (!has_next || m.area[before] > m.area[next])) height = m.height[before];
            if (std::fabs(height) < least) height = 1;
        }
        sides.is_above[i] = height > 0;
    }
    const uint32_t wanted = ring.is_closed ? 2 : 1;
    const uint32_t changes = count_changes(ring, sides);
    if (changes > wanted) mend(ring, m, sides);
    sides.is_split = count_changes(ring, sides) == wanted;
    return sides;
}

// Counter-clockwise, element i begins with the edge that it shares with element i - 1.
Ends ends_between(ShellView shell, const Ring& ring, const RingSides& sides) {
    Ends ends;
    for (uint32_t i = ring.is_closed ? 0 : 1; i < ring.count; ++i) {
        const uint32_t before = (i + ring.count - 1) % ring.count;
        if (sides.is_above[before] == sides.is_above[i]) continue;
        ends.add(shell.state.elements.corner[shell.element(ring.element[i])][(ring.corner[i] + 1u) % 3]);
    }
    return ends;
}

PlaneCrossing find_plane_crossing(ShellView shell, uint32_t vertex, Vec3 normal) {
    PlaneCrossing found;
    uint32_t least_low = kNone, least_high = kNone;
    Ring ring;
    walk_ring(shell, vertex, ring);
    const Vertices& vertices = shell.state.vertices;
    const Vec3 place = vertices.rest[shell.vertex(vertex)];
    const bool has_room = shell.vertex_count() + kInsertVertices <= shell.vertices().capacity &&
                          shell.element_count() + kInsertElements <= shell.elements().capacity &&
                          shell.hinge_count() + kInsertHinges <= shell.hinges().capacity;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t element = ring.element[i], k = (ring.corner[i] + 1u) % 3;
        const auto& corner = shell.state.elements.corner[shell.element(element)];
        const uint32_t p = corner[k], q = corner[(k + 1) % 3], low = std::min(p, q), high = std::max(p, q);
        if (low > least_low || (low == least_low && high >= least_high)) continue;
        const auto height = [&](uint32_t v) { return dot(normal, vertices.rest[shell.vertex(v)] - place); };
        const float above = height(p), below = height(q);
        if ((above >= 0) == (below >= 0)) continue;
        const float tau = above / (above - below);
        if (!(tau > kPlaneSnap && tau < 1 - kPlaneSnap) || !may_insert(shell, element, k, tau)) continue;
        if (!has_room) {
            found.is_full = true;
            continue;
        }
        found.element = element, found.edge = k, found.tau = tau;
        least_low = low, least_high = high;
    }
    return found;
}

}  // namespace cullet
