#include "systems/structures/shell/draw_shell.hpp"

#include <algorithm>
#include <numeric>

#include "systems/structures/shell/drawn_triangles.hpp"

namespace cullet {
namespace {

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

bool is_live(const ShellView& shell, uint32_t element) {
    return (shell.state.elements.flags[shell.element(element)] & kDead) == 0;
}

/// Of a mesh that is written from the start.
struct Writer {
    const ShellView& shell;
    const DrawnMaterials& materials;
    ViewVertex* vertex;
    uint32_t* source;
    uint32_t next[kMostRuns];  // triangle of each run

    uint32_t place(uint32_t e, uint32_t which) { return place(e, which, drawn_run(shell, materials, e, which)); }
    uint32_t place(uint32_t e, uint32_t which, uint32_t run) {
        const uint32_t triangle = next[run]++;
        std::fill_n(source + 3 * triangle, 3, source_of(e, which));
        shell.state.elements.drawn[shell.element(e)][which] = triangle;
        return triangle;
    }
};

/// One border loop from this free edge on. It meets only edges not yet written.
void write_border(Writer& w, uint32_t e, uint32_t k) {
    Elements& elements = w.shell.state.elements;
    float along = 0;
    while (!(elements.drawn_edges[w.shell.element(e)] & (1 << k))) {
        uint8_t& marks = elements.drawn_edges[w.shell.element(e)];
        marks = static_cast<uint8_t>(marks | (1 << k));
        for (const uint32_t half : {0u, 1u}) {
            const uint32_t which = wall_triangle(k, half);
            if (is_drawn(w.shell, e, which)) write_wall(w.shell, e, which, along, w.vertex + 3 * w.place(e, which));
        }
        along += drawn_length(w.shell, e, k);
        step_along_border(w.shell, e, k);
    }
}

void write_shell(Writer& w) {
    const ShellView& shell = w.shell;
    Elements& elements = shell.state.elements;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        elements.drawn_edges[shell.element(e)] = 0;
        elements.drawn[shell.element(e)].fill(kNone);
        if (!is_live(shell, e)) continue;
        const uint32_t run = drawn_run(shell, w.materials, e, kOuterFace);
        const uint32_t outer = w.place(e, kOuterFace, run), inner = w.place(e, kInnerFace, run + kMostDrawnMaterials);
        write_faces(shell, e, w.vertex + 3 * outer, w.vertex + 3 * inner);
    }
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const auto& neighbour = elements.neighbour[shell.element(e)];
        if (neighbour[0] != kNone && neighbour[1] != kNone && neighbour[2] != kNone) continue;
        for (uint32_t k = 0; k < 3; ++k)
            if (is_live(shell, e) && neighbour[k] == kNone) write_border(w, e, k);
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
        const uint32_t run = drawn_run(shell, count.materials, e, kOuterFace);
        count.indices[run] += 3;
        count.indices[run + kMostDrawnMaterials] += 3;
        const auto& neighbour = shell.state.elements.neighbour[shell.element(e)];
        if (neighbour[0] != kNone && neighbour[1] != kNone && neighbour[2] != kNone) continue;
        for (uint32_t which = kFirstWall; which < kMostDrawnTriangles; ++which)
            if (is_drawn(shell, e, which)) count.indices[drawn_run(shell, count.materials, e, which)] += 3;
    }
    count.vertices = count.index_count();
    return count;
}

DrawnCount draw_shell(ShellView shell, DrawnRows to, Range& view_vertices, Range& view_indices) {
    const DrawnCount count = count_drawn(shell);
    CULLET_ASSERT(count.vertices <= view_vertices.capacity && count.index_count() <= view_indices.capacity,
                  "%u view vertices and %u indices do not fit their ranges", count.vertices, count.index_count());
    Writer w{shell,
             count.materials,
             to.view_vertices.vertex.data() + view_vertices.first,
             to.view_indices.source.data() + view_indices.first,
             {}};
    std::exclusive_scan(count.indices.begin(), count.indices.end(), w.next, 0u);
    for (uint32_t& next : w.next) next /= 3;
    write_shell(w);
    uint32_t* const index = to.view_indices.index.data() + view_indices.first;
    std::iota(index, index + count.index_count(), 0u);
    view_vertices.count = count.vertices;
    view_indices.count = count.index_count();
    return count;
}

void draw_body(BodyRows& state, Row<Bodies> body) {
    Bodies& bodies = state.bodies;
    const DrawnCount drawn =
        draw_shell(ShellView(state, bodies.structure[body]), {state.view_vertices, state.view_indices},
                   bodies.view_vertices[body], bodies.view_indices[body]);
    bodies.run_indices[body] = drawn.indices;
    bodies.drawn_materials[body] = drawn.materials.id;
    bodies.redrawn[body] = {0, drawn.index_count() / 3};
    ++bodies.view_stamp[body];
}

void remember_drawn(ShellView shell, const ViewIndices& rows, const Range& view_indices) {
    Elements& elements = shell.state.elements;
    for (uint32_t e = 0; e < shell.element_count(); ++e) elements.drawn[shell.element(e)].fill(kNone);
    for (uint32_t i = 0; i < view_indices.count; i += 3) {
        const uint32_t source = rows.source[view_indices.first + i];
        const uint32_t e = source / kMostDrawnTriangles;
        if (e < shell.element_count()) elements.drawn[shell.element(e)][source % kMostDrawnTriangles] = i / 3;
    }
}

void number_drawn(ShellView shell, const ViewIndices& rows, const Range& view_indices, std::span<uint32_t> numbers) {
    for (uint32_t i = 0; i < view_indices.count; i += 3) {
        const uint32_t source = rows.source[view_indices.first + i];
        const auto corners = drawn_corners(shell, source / kMostDrawnTriangles, source % kMostDrawnTriangles);
        for (uint32_t k = 0; k < 3; ++k) numbers[i + k] = 2 * corners[k].vertex + corners[k].is_inner;
    }
}

namespace {

// 6 corners an element and 6 of the wall below each free edge. An exact count would ask where depth is 0, for ten times
// the time.
template <class ForEach>
uint32_t most_rows(const ShellView& shell, ForEach for_each) {
    uint32_t count = 0;
    for_each([&](uint32_t e) {
        ++count;
        for (uint32_t n : shell.state.elements.neighbour[shell.element(e)]) count += n == kNone;
    });
    return 6 * count;
}

}  // namespace

uint32_t most_view_rows(ShellView shell) {
    return most_rows(shell, [&](auto visit) {
        for (uint32_t e = 0; e < shell.element_count(); ++e)
            if (!(shell.state.elements.flags[shell.element(e)] & kDead)) visit(e);
    });
}

uint32_t most_view_rows(ShellView shell, const FragmentPart& part) {
    return most_rows(shell, [&](auto visit) {
        for (uint32_t e = part.first_element; e != kNone; e = shell.state.elements.next[shell.element(e)]) visit(e);
    });
}

}  // namespace cullet
