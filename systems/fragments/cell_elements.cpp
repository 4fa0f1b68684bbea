#include "systems/fragments/cell_elements.hpp"

namespace cullet {

uint32_t sorted_elements(ShellView shell) {
    uint32_t& sorted = shell.shells().sorted_elements[shell.row];
    const uint32_t count = shell.element_count();
    if (sorted > 0 || count == 0) return std::min(sorted, count);
    const uint32_t* const cell = shell.state.elements.cell.data() + shell.elements().first;
    sorted = static_cast<uint32_t>(std::is_sorted_until(cell, cell + count) - cell);
    return sorted;
}

}  // namespace cullet
