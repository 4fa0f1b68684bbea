// The elements of some cells, without a look at those of the others.
#pragma once
#include <algorithm>

#include "components/shell_rows.hpp"

namespace cullet {

/// How many first elements stand in order of cells, the most there are. Looked for once a shell and then remembered:
/// O(elements) the first time.
uint32_t sorted_elements(ShellIn<Tables<Shells, const Elements>> shell);

/// Calls visit(element) for all elements, dead ones too, of the cells that is_wanted(cell) names: cell by cell, and
/// behind them those that cracks added. Within a cell elements rise. O(elements of these cells + cells + added ones).
template <class View, class IsWanted, class Visit>
void for_each_element_of_cells(const View& shell, IsWanted&& is_wanted, Visit&& visit) {
    const uint32_t sorted = sorted_elements(shell);
    const uint32_t* const cell = shell.state.elements.cell.data() + shell.elements().first;
    for (uint32_t c = 0; c < shell.cells().count; ++c) {
        if (!is_wanted(c)) continue;
        const auto first = static_cast<uint32_t>(std::lower_bound(cell, cell + sorted, c) - cell);
        for (uint32_t e = first; e < sorted && cell[e] == c; ++e) visit(e);
    }
    for (uint32_t e = sorted; e < shell.element_count(); ++e)
        if (is_wanted(cell[e])) visit(e);
}

/// The same of cells with a mark in Cells::is_changed.
template <class Visit>
void for_each_element_of_changed_cells(const ShellView& shell, Visit&& visit) {
    const uint8_t* const is_changed = shell.state.cells.is_changed.data() + shell.cells().first;
    for_each_element_of_cells(
        shell, [&](uint32_t c) { return is_changed[c] != 0; }, visit);
}

}  // namespace cullet
