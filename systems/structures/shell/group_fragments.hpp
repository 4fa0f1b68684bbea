// Which elements still hang together: components over neighbour links.
#pragma once
#include <span>

#include "components/shell_rows.hpp"

namespace cullet {

/// Writes Elements.part (0, 1, ... by smallest element; kNone for dead ones) and Elements.next, and describes the
/// parts. Returns how many there are. When `parts` is shorter, the parts beyond it are numbered but not described, and
/// their elements not chained. O(elements), no scratch.
uint32_t group_fragments(ShellView shell, std::span<FragmentPart> parts);

/// All live elements as part 0, whether they hang together or not. O(elements).
FragmentPart whole_part(const ShellView& shell);

/// By the numbers of the last grouping: cooking's, or that of the break that made the shell.
bool is_of_one_part(const ShellView& shell);
/// All live elements are numbered 0 and no dead one has a number.
bool is_numbered_zero(const ShellView& shell);

/// Whether the part's elements are chained: what is left of a body may not be (find_pieces).
inline bool is_listed(const FragmentPart& part) {
    return part.element_count == 0 || part.last_element != kNone;
}
/// Chains the elements of the part of that number where they are not yet. O(elements).
void list_part(ShellView shell, FragmentPart& part, uint32_t number);

/// Puts element e behind the part's others; they come in rising order.
void add_to_part(const ShellView& shell, FragmentPart& part, uint32_t e);

/// Makes a part one with the part of that number, for a fragment that gets no body of its own: its elements get the
/// number, and `from` is left empty (first_element kNone, no mass). make_piece then gives both one shell. O(elements of
/// from).
void join_parts(ShellView shell, FragmentPart& from, FragmentPart& to, uint32_t number);

}  // namespace cullet
