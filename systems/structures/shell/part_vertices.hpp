// The vertices of a part.
#pragma once
#include "components/shell_rows.hpp"

namespace cullet {

/// Calls visit(row) for each vertex of a listed part, in the order of its elements: each vertex names one of them.
template <class Visit>
void for_each_vertex_of(const ShellView& shell, const FragmentPart& part, Visit visit) {
    const ShellRows& state = shell.state;
    for (uint32_t e = part.first_element; e != kNone; e = state.elements.next[shell.element(e)])
        for (const uint32_t v : state.elements.corner[shell.element(e)])
            if (state.vertices.element[shell.vertex(v)] == e) visit(shell.vertex(v));
}

}  // namespace cullet
