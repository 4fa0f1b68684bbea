// What hangs together in a broken shell.
#pragma once
#include <span>

#include "components/fragments.hpp"

namespace cullet {

/// One component of a broken shell. Its elements are first_element, Elements.next of it, and so on in rising order
/// until kNone.
struct FragmentPart {
    uint32_t first_element = kNone;  // the smallest; parts are ordered by it
    uint32_t last_element = kNone;
    uint32_t element_count = 0;
    double mass = 0;  // kg, of the elements in rising order
    bool has_pins = false;
};

/// Row t kMostParts + p is part p of task t, between the slots Group and plan_births, where it becomes a row of
/// Fragments. Rows behind the last task's are of a shell that no task works on.
struct ShellParts : Table<ShellParts> {
    using Table::Table;
    CULLET_TABLE(shell_parts);
    Column<FragmentPart> part{*this, "part", "1", Keep::Scratch};

    std::span<FragmentPart> of_task(uint32_t task) { return {part.data() + size_t{task} * kMostParts, kMostParts}; }
    std::span<FragmentPart> of_none() { return {part.data() + (size() - kMostParts), kMostParts}; }
};

}  // namespace cullet
