#include "systems/models/metal_shell/tear/metal_repair.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr float kLeastStiffness = 0.05f, kMostStiffness = 3;  // as cooking clamps cotangents

float mix(float p, float q, float tau) {
    return p + tau * (q - p);
}
Vec3 mix(Vec3 p, Vec3 q, float tau) {
    return p + tau * (q - p);
}

/// The corner of an element that is this vertex, or 3.
uint32_t corner_at(const ShellView& shell, uint32_t element, uint32_t vertex) {
    const auto& corner = shell.state.elements.corner[shell.element(element)];
    return static_cast<uint32_t>(std::find(corner.begin(), corner.end(), vertex) - corner.begin());
}

// A new vertex has the row of one end of its edge until the other end is known.
void begin_vertex(const MetalView& metal, uint32_t vertex, uint32_t end) {
    MetalVertices& v = metal.vertices();
    metal.shells().vertices[metal.row].count = vertex + 1;
    const uint32_t row = metal.vertex(vertex);
    v.copy_rows(v, metal.vertex(end), row, 1);
    v.spring_count[row] = 0;
    v.queued[row] = end;
    v.is_queued[row] = 1;
}

void finish_vertex(const MetalView& metal, uint32_t vertex, uint32_t end) {
    MetalVertices& v = metal.vertices();
    const auto rest = [&](uint32_t of) { return metal.shell.state.vertices.rest[metal.shell.vertex(of)]; };
    const uint32_t w = metal.vertex(vertex), begin = v.queued[w], p = metal.vertex(begin), q = metal.vertex(end);
    const float whole = length(rest(end) - rest(begin));
    const float tau = whole > 0 ? std::min(1.0f, length(rest(vertex) - rest(begin)) / whole) : 0;
    for (Column<Vec3>* column : {&v.original, &v.before, &v.start, &v.place})
        column->set(w, mix((*column)[p], (*column)[q], tau));
    v.pin_distance[w] = mix(v.pin_distance[p], v.pin_distance[q], tau);
    v.field[w] = mix(v.field[p], v.field[q], tau);
    if (tau > 0.5f) v.cell[w] = v.cell[q], v.weight[w] = v.weight[q];
    v.is_queued[w] = 0;
}

// Of the elements that an inserted vertex makes, the one at the first end of its edge comes first, then the one at the
// second; the other two follow where the edge has two sides.
void follow_element(const CutRepair& repair, ShellView shell, uint32_t element) {
    const MetalView metal({shell.state, static_cast<const MetalRepair&>(repair).metal}, shell.structure);
    const uint32_t vertex = shell.vertex_count() - 1, k = corner_at(shell, element, vertex);
    if (k > 2) return;
    const auto& corner = metal.corners(element);
    if (vertex >= metal.vertex_count()) begin_vertex(metal, vertex, corner[(k + 2) % 3]);
    Range& elements = metal.shells().elements[metal.row];
    if (element < elements.count) return;
    // It was cut off the element that ends where the new vertex begins.
    const uint32_t from = shell.state.elements.neighbour[shell.element(element)][(k + 2) % 3];
    auto& cell = metal.metal.metal_elements.cell;
    elements.count = element + 1;
    cell[elements.first + element] = cell[elements.first + from];
    if (metal.vertices().is_queued[metal.vertex(vertex)]) finish_vertex(metal, vertex, corner[(k + 1) % 3]);
}

struct Edges {
    uint32_t count = 0;
    uint32_t other[2 * kMostRing];
    double stiffness[2 * kMostRing];

    void add(uint32_t vertex, double weight) {
        uint32_t at = 0;
        while (at < count && other[at] != vertex) ++at;
        if (at == 2 * kMostRing) return;
        if (at == count) other[count] = vertex, stiffness[count++] = 0;
        stiffness[at] += weight;
    }
};

// Half of the cotangent of the angle at c.
double half_cotangent(const MetalView& metal, uint32_t a, uint32_t b, uint32_t c) {
    const auto& original = metal.vertices().original;
    const Vec3d apex(original[metal.vertex(c)]);
    const Vec3d p = Vec3d(original[metal.vertex(a)]) - apex, q = Vec3d(original[metal.vertex(b)]) - apex;
    const double across = length(cross(p, q));
    return across > 0 ? 0.5 * dot(p, q) / across : 0;
}

// Behind those that there are; ties stay as they were.
void lay_springs(const MetalView& metal, uint32_t vertex) {
    const ShellView& shell = metal.shell;
    MetalVertices& own = metal.vertices();
    MetalSprings& springs = metal.springs();
    Range& range = metal.shells().springs[metal.row];
    Ring ring;
    collect_ring(shell, vertex, ring);
    Edges edges;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const auto& corner = metal.corners(ring.element[i]);
        const uint32_t k = corner_at(shell, ring.element[i], vertex);
        if (k > 2) continue;
        const uint32_t next = corner[(k + 1) % 3], last = corner[(k + 2) % 3];
        edges.add(next, half_cotangent(metal, vertex, next, last));
        edges.add(last, half_cotangent(metal, last, vertex, next));
    }
    const uint32_t row = metal.vertex(vertex), old = range.first + own.first_spring[row];
    const uint32_t begin = range.count;
    const auto has_room = [&] { return range.count < range.capacity; };
    for (uint32_t i = 0; i < edges.count && has_room(); ++i) {
        const uint32_t to = range.first + range.count++;
        springs.other[to] = edges.other[i];
        springs.length[to] = length(own.original[metal.vertex(edges.other[i])] - own.original[row]);
        springs.stiffness[to] = std::clamp(static_cast<float>(edges.stiffness[i]), kLeastStiffness, kMostStiffness);
        springs.is_tie[to] = 0;
    }
    for (uint32_t k = old; k < old + own.spring_count[row] && has_room(); ++k)
        if (springs.is_tie[k]) springs.copy_rows(springs, k, range.first + range.count++, 1);
    own.first_spring[row] = begin;
    own.spring_count[row] = static_cast<uint16_t>(range.count - begin);
}

}  // namespace

MetalRepair::MetalRepair(const MetalView& of)
    : CutRepair{follow_element, [](ShellView, uint32_t) { return 0u; },
                []([[maybe_unused]] const Structures& structures, Row<Structures>) { return true; },
                [](ShellView, uint32_t, uint32_t, uint32_t) {}, [](ShellView) {}},
      metal(of.metal) {}

// Cuts mark what they open, so that few have to be looked through.
void follow_copies(const MetalView& metal) {
    const ShellView& shell = metal.shell;
    const auto& vertices = shell.state.vertices;
    const uint32_t first = metal.vertex_count(), count = shell.vertex_count();
    metal.shells().vertices[metal.row].count = count;
    MetalVertices& own = metal.vertices();
    for (uint32_t c = first; c < count; ++c) own.queued[metal.vertex(c)] = kNone;
    for (uint32_t v = 0; v < first; ++v) {
        if (vertices.crack[shell.vertex(v)] == static_cast<uint8_t>(CrackState::None)) continue;
        const Vec3 place = vertices.rest[shell.vertex(v)];
        for (uint32_t c = first; c < count; ++c)
            if (own.queued[metal.vertex(c)] == kNone && vertices.rest[shell.vertex(c)] == place)
                own.copy_rows(own, metal.vertex(v), metal.vertex(c), 1), own.queued[metal.vertex(c)] = v;
    }
    for (uint32_t c = first; c < count; ++c) {
        CULLET_ASSERT(own.queued[metal.vertex(c)] != kNone, "vertex %u is a copy of none", c);
        if (own.queued[metal.vertex(c)] == kNone) own.copy_rows(own, metal.vertex(0), metal.vertex(c), 1);
    }
}

RowsBefore rows_of(const MetalView& metal) {
    return {metal.shell.vertex_count(), metal.shell.element_count()};
}

void lay_springs_anew(const MetalView& metal, RowsBefore before) {
    const ShellView& shell = metal.shell;
    MetalVertices& own = metal.vertices();
    const auto& crack = shell.state.vertices.crack;
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        own.is_queued[metal.vertex(v)] =
            v >= before.vertices || crack[shell.vertex(v)] != static_cast<uint8_t>(CrackState::None);
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        const auto& corner = metal.corners(e);
        const bool is_touched = e >= before.elements || corner[0] >= before.vertices || corner[1] >= before.vertices ||
                                corner[2] >= before.vertices;
        for (const uint32_t v : corner)
            if (is_touched && own.is_queued[metal.vertex(v)] == 0) own.is_queued[metal.vertex(v)] = 1;
    }
    for (uint32_t v = 0; v < metal.vertex_count(); ++v)
        if (own.is_queued[metal.vertex(v)]) lay_springs(metal, v);
}

}  // namespace cullet
