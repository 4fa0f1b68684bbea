// A shell that is of metal, with its rows looked up.
#pragma once
#include "components/metal_rows.hpp"

namespace cullet {

struct MetalView {
    ShellView shell;
    MetalTables metal;
    Row<MetalShells> row;

    MetalView(MetalShellRows rows, Row<Structures> of) : shell(rows, of), metal(rows), row(metal_of(rows, of)) {}
    MetalShells& shells() const { return metal.metal_shells; }
    MetalVertices& vertices() const { return metal.metal_vertices; }
    SubShells& cells() const { return metal.sub_shells; }
    MetalSprings& springs() const { return metal.metal_springs; }
    SubShellBorders& borders() const { return metal.sub_shell_borders; }
    uint32_t vertex_count() const { return shells().vertices[row].count; }
    uint32_t element_count() const { return shells().elements[row].count; }
    uint32_t cell_count() const { return shells().cells[row].count; }
    /// Table rows of relative indices.
    uint32_t vertex(uint32_t v) const { return shells().vertices[row].first + v; }
    uint32_t cell(uint32_t c) const { return shells().cells[row].first + c; }
    uint32_t cell_of(uint32_t element) const {
        return metal.metal_elements.cell[shells().elements[row].first + element];
    }
    bool is_pinned(uint32_t v) const { return shell.state.vertices.is_pinned[shell.vertex(v)] != 0; }
    const std::array<uint32_t, 3>& corners(uint32_t element) const {
        return shell.state.elements.corner[shell.element(element)];
    }
    bool is_dead(uint32_t element) const { return shell.state.elements.flags[shell.element(element)] & kDead; }
    /// visit(other vertex, row of the spring) for each spring of a vertex.
    template <class Visit>
    void for_each_spring(uint32_t v, Visit visit) const {
        const MetalSprings& s = springs();
        const uint32_t first = shells().springs[row].first + vertices().first_spring[vertex(v)];
        for (uint32_t k = first; k < first + vertices().spring_count[vertex(v)]; ++k) visit(s.other[k], k);
    }
    template <class Visit>
    void for_each_border(uint32_t c, Visit visit) const {
        const uint32_t first = shells().borders[row].first + cells().first_border[cell(c)];
        for (uint32_t k = first; k < first + cells().border_count[cell(c)]; ++k)
            visit(borders().other[k], borders().length[k]);
    }
};

}  // namespace cullet
