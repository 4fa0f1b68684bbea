// Parts of a broken shell, as rows of Fragments.
#pragma once
#include <span>

#include "components/shell_parts.hpp"

namespace cullet {

inline FragmentPart part_of(const Fragments& fragments, uint32_t row) {
    return {fragments.first_element[row], fragments.last_element[row], fragments.element_count[row],
            fragments.mass[row], fragments.has_pins[row] != 0};
}
inline void set_part(Fragments& fragments, uint32_t row, const FragmentPart& part) {
    fragments.first_element[row] = part.first_element;
    fragments.last_element[row] = part.last_element;
    fragments.element_count[row] = part.element_count;
    fragments.mass[row] = part.mass;
    fragments.has_pins[row] = part.has_pins;
}
/// New rows for them; none where there is no room.
inline Rows<Fragments> append_parts(Fragments& fragments, std::span<const FragmentPart> parts) {
    const Rows<Fragments> made = append_fragments(fragments, static_cast<uint32_t>(parts.size()));
    for (const Row<Fragments> f : made) set_part(fragments, f, parts[f - made.first]);
    return made;
}

}  // namespace cullet
