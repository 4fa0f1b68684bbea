#include "systems/view/draw_shell.hpp"

#include <numeric>

#include "systems/fragments/prism.hpp"

namespace cullet {
namespace {

/// One corner of the solid: a vertex on its outer or inner side. Both are one point where the depth is 0.
struct Point {
    uint32_t vertex;
    bool is_inner;
    friend bool operator==(const Point&, const Point&) = default;
};

struct Writer {
    ShellView shell;
    uint32_t first_vertex, first_index;  // table rows
    uint32_t vertex = 0;                 // next, relative
    DrawnMaterials materials = {};
    uint32_t index[kMostRuns] = {};  // next of each run, relative
    uint32_t* numbers = nullptr;     // set: only the numbers of the corners' points are written, here
};

DrawnMaterials materials_of(const ShellView& shell) {
    DrawnMaterials found;
    const Elements& elements = shell.state.elements;
    for (uint32_t e = shell.element(0); e < shell.element(shell.element_count()); ++e) {
        if (elements.flags[e] & kDead) continue;
        const uint16_t id = elements.drawn_material[e];
        uint32_t at = 0;
        while (at < found.count && found.id[at] < id) ++at;
        if (at == kMostDrawnMaterials || (at < found.count && found.id[at] == id)) continue;
        if (found.count < kMostDrawnMaterials) ++found.count;
        for (uint32_t i = found.count - 1; i > at; --i) found.id[i] = found.id[i - 1];
        found.id[at] = id;
    }
    return found;
}

uint32_t run_of(const DrawnMaterials& materials, SurfaceKind kind, uint16_t id) {
    uint32_t at = 0;
    while (at + 1 < materials.count && materials.id[at] < id) ++at;
    return static_cast<uint32_t>(kind) * kMostDrawnMaterials + at;
}

bool is_live(const ShellView& shell, uint32_t element) {
    return (shell.state.elements.flags[shell.element(element)] & kDead) == 0;
}

Point point(const ShellView& shell, uint32_t vertex, bool is_inner) {
    return {vertex, is_inner && shell.state.vertices.depth[shell.vertex(vertex)] > 0};
}

Vec3 place(const ShellView& shell, Point p) {
    const uint32_t row = shell.vertex(p.vertex);
    const Vertices& vertices = shell.state.vertices;
    return p.is_inner ? inner_twin(shell.state, row).to_float() : vertices.rest[row];
}

/// The two triangles of the wall below edge k of the element, seen from outside of the solid.
struct SideQuad {
    Point triangle[2][3];
    bool is_drawn[2];
};

SideQuad side_quad(const ShellView& shell, uint32_t element, int k) {
    const auto corner = shell.state.elements.corner[shell.element(element)];
    const uint32_t a = corner[k], b = corner[(k + 1) % 3];
    const Point ao = point(shell, a, false), bo = point(shell, b, false), ai = point(shell, a, true),
                bi = point(shell, b, true);
    SideQuad quad;
    if (a < b)
        quad = {{{bo, ao, bi}, {ao, ai, bi}}, {}};
    else
        quad = {{{bo, ao, ai}, {bo, ai, bi}}, {}};
    for (int t = 0; t < 2; ++t) {
        const Point* p = quad.triangle[t];
        quad.is_drawn[t] = !(p[0] == p[1] || p[1] == p[2] || p[2] == p[0]);
    }
    return quad;
}

/// Of the wall below edge k: rims are drawn with the inner surface.
SurfaceKind kind_of(const ShellView& shell, uint32_t element, int k) {
    const auto edge = static_cast<EdgeKind>(shell.state.elements.edge_kind[shell.element(element)][k]);
    return edge == EdgeKind::Crack ? SurfaceKind::Crack : SurfaceKind::Inner;
}

uint32_t write_vertex(Writer& w, Point at, Vec3 position, Vec3 normal, float u, float v) {
    if (w.numbers) {
        w.numbers[w.vertex] = 2 * at.vertex + at.is_inner;
        return w.vertex++;
    }
    ViewVertices& table = w.shell.state.view_vertices;
    const uint32_t row = w.first_vertex + w.vertex;
    table.vertex[row] = {position, normal, {u, v}};
    return w.vertex++;
}

void write_index(Writer& w, uint32_t run, uint32_t vertex) {
    if (w.numbers) return;
    w.shell.state.view_indices.index[w.first_index + w.index[run]++] = vertex;
}

void write_faces(Writer& w, uint32_t e) {
    const ShellView& shell = w.shell;
    const Elements& elements = shell.state.elements;
    const uint32_t row = shell.element(e);
    const auto corner = elements.corner[row];
    const auto& normal = elements.normal[row];
    Vec3 inner[3];
    for (int k = 0; k < 3; ++k) inner[k] = place(shell, point(shell, corner[k], true));
    const Vec3 flat = normalised(cross(inner[2] - inner[0], inner[1] - inner[0]));
    uint32_t outer_vertex[3], inner_vertex[3];
    for (int k = 0; k < 3; ++k) {
        const Vec3 n{normal[3 * k], normal[3 * k + 1], normal[3 * k + 2]};
        const Vec2 uv{elements.uv[row][2 * k], elements.uv[row][2 * k + 1]};
        const Point outer = point(shell, corner[k], false);
        outer_vertex[k] = write_vertex(w, outer, place(shell, outer), n, uv.x, uv.y);
        const bool runs_along = dot(-n, flat) > 0.8f || dot(flat, flat) < 0.5f;  // no area, no normal
        inner_vertex[k] = write_vertex(w, point(shell, corner[k], true), inner[k], runs_along ? -n : flat, uv.x, uv.y);
    }
    const uint32_t outer = run_of(w.materials, SurfaceKind::Outer, elements.drawn_material[row]);
    const uint32_t below = run_of(w.materials, SurfaceKind::Inner, elements.drawn_material[row]);
    for (int k : {0, 1, 2}) write_index(w, outer, outer_vertex[k]);
    for (int k : {0, 2, 1}) write_index(w, below, inner_vertex[k]);
}

/// Writes side quad k of the element, `along` metres from the start of its border; returns the edge's length.
float write_side(Writer& w, uint32_t e, int k, float along) {
    const SideQuad quad = side_quad(w.shell, e, k);
    const auto corner = w.shell.state.elements.corner[w.shell.element(e)];
    const float edge = length(place(w.shell, {corner[(k + 1) % 3], false}) - place(w.shell, {corner[k], false}));
    const uint16_t material = w.shell.state.elements.drawn_material[w.shell.element(e)];
    const uint32_t run = run_of(w.materials, kind_of(w.shell, e, k), material);
    for (int t = 0; t < 2; ++t) {
        if (!quad.is_drawn[t]) continue;
        Vec3 p[3];
        for (int i = 0; i < 3; ++i) p[i] = place(w.shell, quad.triangle[t][i]);
        const Vec3 normal = normalised(cross(p[1] - p[0], p[2] - p[0]));
        for (int i = 0; i < 3; ++i) {
            const Point at = quad.triangle[t][i];
            const float u = along + (at.vertex == corner[k] ? 0.0f : edge);
            const float v = at.is_inner ? w.shell.state.vertices.depth[w.shell.vertex(at.vertex)] : 0.0f;
            write_index(w, run, write_vertex(w, at, p[i], normal, u, v));
        }
    }
    return edge;
}

/// The free edge that follows edge k of the element along its border: round the end corner through links.
void step_along_border(const ShellView& shell, uint32_t& e, int& k) {
    const Elements& elements = shell.state.elements;
    k = (k + 1) % 3;
    while (elements.neighbour[shell.element(e)][k] != kNone) {
        const uint32_t from = elements.corner[shell.element(e)][k];
        e = elements.neighbour[shell.element(e)][k];
        const auto corner = elements.corner[shell.element(e)];
        k = corner[0] == from ? 0 : corner[1] == from ? 1 : 2;
    }
}

/// One border loop from this free edge on. It meets only edges not yet written: a vertex has one fan, so the next free
/// edge is a one-to-one map.
void write_border(Writer& w, uint32_t e, int k) {
    Elements& elements = w.shell.state.elements;
    float along = 0;
    while (!(elements.drawn_edges[w.shell.element(e)] & (1 << k))) {
        uint8_t& marks = elements.drawn_edges[w.shell.element(e)];
        marks = static_cast<uint8_t>(marks | (1 << k));
        along += write_side(w, e, k, along);
        step_along_border(w.shell, e, k);
    }
}

}  // namespace

uint32_t DrawnCount::index_count() const {
    return std::accumulate(indices.begin(), indices.end(), 0u);
}

DrawnCount count_drawn(ShellView shell) {
    DrawnCount count;
    count.materials = materials_of(shell);
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        if (!is_live(shell, e)) continue;
        count.vertices += 6;
        const uint16_t material = shell.state.elements.drawn_material[shell.element(e)];
        count.indices[run_of(count.materials, SurfaceKind::Outer, material)] += 3;
        count.indices[run_of(count.materials, SurfaceKind::Inner, material)] += 3;
        for (int k = 0; k < 3; ++k) {
            if (shell.state.elements.neighbour[shell.element(e)][k] != kNone) continue;
            const SideQuad quad = side_quad(shell, e, k);
            for (bool is_drawn : quad.is_drawn) {
                count.vertices += is_drawn ? 3 : 0;
                count.indices[run_of(count.materials, kind_of(shell, e, k), material)] += is_drawn ? 3 : 0;
            }
        }
    }
    return count;
}

namespace {

void write_shell(Writer& w) {
    const ShellView& shell = w.shell;
    Elements& elements = shell.state.elements;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        elements.drawn_edges[shell.element(e)] = 0;
        if (is_live(shell, e)) write_faces(w, e);
    }
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        for (int k = 0; k < 3; ++k)
            if (is_live(shell, e) && elements.neighbour[shell.element(e)][k] == kNone) write_border(w, e, k);
}

}  // namespace

DrawnCount draw_shell(ShellView shell, Range& view_vertices, Range& view_indices) {
    const DrawnCount count = count_drawn(shell);
    CULLET_ASSERT(count.vertices <= view_vertices.capacity && count.index_count() <= view_indices.capacity,
                  "%u view vertices and %u indices do not fit their ranges", count.vertices, count.index_count());
    Writer w{shell, view_vertices.first, view_indices.first};
    w.materials = count.materials;
    std::exclusive_scan(count.indices.begin(), count.indices.end(), w.index, 0u);
    write_shell(w);
    view_vertices.count = count.vertices;
    view_indices.count = count.index_count();
    return count;
}

void number_drawn(ShellView shell, std::span<uint32_t> numbers) {
    Writer w{shell, 0, 0};
    w.numbers = numbers.data();
    w.materials = materials_of(shell);
    write_shell(w);
}

void draw_body(State& state, Row<Bodies> body) {
    Bodies& bodies = state.bodies;
    const DrawnCount drawn =
        draw_shell(ShellView(state, bodies.shell[body]), bodies.view_vertices[body], bodies.view_indices[body]);
    bodies.run_indices[body] = drawn.indices;
    bodies.drawn_materials[body] = drawn.materials.id;
    ++bodies.view_stamp[body];
}

}  // namespace cullet
