#include "systems/structures/shell/ring.hpp"

#include <algorithm>

namespace cullet {

namespace {

template <class View>
uint8_t corner_in(const View& shell, uint32_t element, uint32_t vertex) {
    const auto& corner = shell.state.elements.corner[shell.element(element)];
    for (uint8_t k = 0; k < 3; ++k)
        if (corner[k] == vertex) return k;
    return 3;
}

/// Appends elements from `at` on, over the edge (corner + turn) % 3 of each, until a border, `end`, or one too many.
/// Returns where it stopped.
template <class View>
uint32_t walk(const View& shell, uint32_t vertex, uint32_t at, uint32_t end, uint32_t turn, Ring& ring) {
    while (at != kNone) {
        const uint8_t corner = corner_in(shell, at, vertex);
        CULLET_ASSERT(corner < 3, "vertex %u is no corner of element %u, reached over a neighbour link", vertex, at);
        ring.is_cut_short = ring.count == kMostRing || corner == 3;
        if (ring.is_cut_short) return kNone;
        ring.element[ring.count] = at;
        ring.corner[ring.count++] = corner;
        at = shell.state.elements.neighbour[shell.element(at)][(corner + turn) % 3];
        if (at == end) break;
    }
    return at;
}

/// All elements, from Vertices.element counter-clockwise to the border, then from it clockwise to the other. Returns
/// how many the first part has; all of a closed ring.
template <class View>
uint32_t gather(const View& shell, uint32_t vertex, Ring& ring) {
    ring.count = 0;
    ring.is_closed = ring.is_cut_short = false;
    const uint32_t begin = shell.state.vertices.element[shell.vertex(vertex)];
    if (begin == kNone) return 0;
    ring.is_closed = walk(shell, vertex, begin, begin, 2, ring) == begin;
    const uint32_t forward = ring.count;
    if (!ring.is_closed && !ring.is_cut_short)
        walk(shell, vertex, shell.state.elements.neighbour[shell.element(begin)][ring.corner[0]], begin, 0, ring);
    if (ring.is_cut_short) ring.count = 0;
    return ring.is_cut_short ? 0 : forward;
}

void rotate(Ring& ring, uint32_t first) {
    std::rotate(ring.element, ring.element + first, ring.element + ring.count);
    std::rotate(ring.corner, ring.corner + first, ring.corner + ring.count);
}

template <class View>
void walk_all(const View& shell, uint32_t vertex, Ring& ring) {
    const uint32_t forward = gather(shell, vertex, ring);
    if (ring.is_closed) {
        rotate(ring, static_cast<uint32_t>(std::min_element(ring.element, ring.element + ring.count) - ring.element));
    } else if (forward < ring.count) {
        std::reverse(ring.element + forward, ring.element + ring.count);
        std::reverse(ring.corner + forward, ring.corner + ring.count);
        rotate(ring, forward);
    }
}

}  // namespace

uint8_t corner_of(const ShellView& shell, uint32_t element, uint32_t vertex) {
    return corner_in(shell, element, vertex);
}

void walk_ring(const ShellView& shell, uint32_t vertex, Ring& ring) {
    walk_all(shell, vertex, ring);
}

void walk_ring(const RingView& shell, uint32_t vertex, Ring& ring) {
    walk_all(shell, vertex, ring);
}

void collect_ring(const ShellView& shell, uint32_t vertex, Ring& ring) {
    gather(shell, vertex, ring);
    for (uint32_t i = 1; i < ring.count; ++i) {
        const uint32_t element = ring.element[i];
        const uint8_t corner = ring.corner[i];
        uint32_t j = i;
        for (; j > 0 && ring.element[j - 1] > element; --j)
            ring.element[j] = ring.element[j - 1], ring.corner[j] = ring.corner[j - 1];
        ring.element[j] = element, ring.corner[j] = corner;
    }
}

void collect_hinges(const ShellView& shell, const Ring& ring, RingHinges& hinges) {
    hinges.count = 0;
    // Inserted in order: a ring has about twelve, and a sort of all that repeat takes twice as long.
    for (uint32_t i = 0; i < ring.count; ++i)
        for (const uint32_t hinge : shell.state.elements.hinge[shell.element(ring.element[i])]) {
            if (hinge == kNone) continue;
            uint32_t at = hinges.count;
            while (at > 0 && hinges.hinge[at - 1] > hinge) --at;
            if (at > 0 && hinges.hinge[at - 1] == hinge) continue;
            for (uint32_t j = hinges.count++; j > at; --j) hinges.hinge[j] = hinges.hinge[j - 1];
            hinges.hinge[at] = hinge;
        }
}

void collect_hinge_elements(const ShellView& shell, const Ring& ring, HingeElements& elements) {
    elements.count = 0;
    const auto add = [&](uint32_t element) {
        uint32_t at = elements.count;
        while (at > 0 && elements.element[at - 1] > element) --at;
        if (at > 0 && elements.element[at - 1] == element) return;
        for (uint32_t j = elements.count++; j > at; --j) elements.element[j] = elements.element[j - 1];
        elements.element[at] = element;
    };
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t row = shell.element(ring.element[i]), opposite = (ring.corner[i] + 1u) % 3;
        add(ring.element[i]);
        if (shell.state.elements.hinge[row][opposite] != kNone) add(shell.state.elements.neighbour[row][opposite]);
    }
}

Vec3 ring_normal(ShellView shell, const Ring& ring) {
    Vec3 sum;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const auto& corner = shell.state.elements.corner[shell.element(ring.element[i])];
        const auto rest = [&](int k) { return shell.state.vertices.rest[shell.vertex(corner[k])]; };
        sum += cross(rest(1) - rest(0), rest(2) - rest(0));
    }
    return normalised(sum);
}

void weigh_vertex(ShellView shell, uint32_t vertex) {
    Ring ring;
    walk_ring(shell, vertex, ring);
    if (ring.is_cut_short) return;  // such a vertex is never split, and no element at it is
    double sum = 0;
    for (uint32_t i = 0; i < ring.count; ++i) sum += shell.state.elements.mass[shell.element(ring.element[i])];
    Vertices& vertices = shell.state.vertices;
    const uint32_t row = shell.vertex(vertex);
    const double mass = sum / 3;
    vertices.mass[row] = mass;
    const bool is_free = mass > 0 && !vertices.is_pinned[row];
    vertices.inverse_mass[row] = is_free ? static_cast<float>(1 / mass) : 0.0f;
}

Vec3 into_plane(Vec3 direction, Vec3 normal) {
    return normalised(direction - dot(direction, normal) * normal);
}

}  // namespace cullet
