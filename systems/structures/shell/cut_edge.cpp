#include "systems/structures/shell/cut_edge.hpp"

namespace cullet {

uint8_t edge_between(ShellView shell, uint32_t element, uint32_t from, uint32_t to) {
    const auto& corner = shell.state.elements.corner[shell.element(element)];
    for (uint8_t k = 0; k < 3; ++k)
        if (corner[k] == from && corner[(k + 1) % 3] == to) return k;
    return 3;
}

bool cut_edge(ShellView shell, uint32_t element, uint32_t edge) {
    Elements& elements = shell.state.elements;
    const uint32_t row = shell.element(element);
    const uint32_t other = elements.neighbour[row][edge];
    if (other == kNone) return false;
    const auto& corner = elements.corner[row];
    const uint32_t other_row = shell.element(other);
    const uint8_t other_edge = edge_between(shell, other, corner[(edge + 1) % 3], corner[edge]);
    CULLET_ASSERT(other_edge < 3 && elements.neighbour[other_row][other_edge] == element,
                  "elements %u and %u disagree on their common edge", element, other);
    if (other_edge == 3) return false;
    if (const uint32_t h = elements.hinge[row][edge]; h != kNone) {
        shell.state.hinges.vertex[shell.hinge(h)][0] = kNone;
        shell.state.hinges.stiffness[shell.hinge(h)] = 0;
    }
    const auto open = [&](uint32_t r, uint32_t k) {
        elements.neighbour[r][k] = kNone;
        elements.hinge[r][k] = kNone;
        elements.edge_kind[r][k] = static_cast<uint8_t>(EdgeKind::Crack);
    };
    open(row, edge);
    open(other_row, other_edge);
    return true;
}

}  // namespace cullet
