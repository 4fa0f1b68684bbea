#include "systems/structures/shell/cell_elements.hpp"

namespace cullet {

// Elements stay in their cells, so the count only grows: by elements that cracks add behind it in the last cell.
uint32_t sorted_elements(ShellIn<Tables<Shells, const Elements>> shell) {
    uint32_t& sorted = shell.shells().sorted_elements[shell.row];
    const uint32_t count = shell.element_count();
    const uint32_t* const cell = shell.state.elements.cell.data() + shell.elements().first;
    while (sorted < count && (sorted == 0 || cell[sorted - 1] <= cell[sorted])) ++sorted;
    return std::min(sorted, count);
}

}  // namespace cullet
