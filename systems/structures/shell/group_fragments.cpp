#include "systems/structures/shell/group_fragments.hpp"

#include <algorithm>

namespace cullet {
namespace {

// Union-find inside the part column. The smaller element becomes the root, so every parent is at most its child, and
// one rising pass can turn parents into part numbers.
uint32_t find_root(uint32_t* parent, uint32_t e) {
    while (parent[e] != e) e = parent[e] = parent[parent[e]];
    return e;
}

void join_neighbours(ShellView shell, uint32_t* parent) {
    const Elements& elements = shell.state.elements;
    for (uint32_t e = 0; e < shell.element_count(); ++e) parent[e] = e;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        if (elements.flags[shell.element(e)] & kDead) continue;
        for (uint32_t n : elements.neighbour[shell.element(e)]) {
            if (n == kNone || n > e) continue;
            const uint32_t a = find_root(parent, e), b = find_root(parent, n);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
}

}  // namespace

void add_to_part(const ShellView& shell, FragmentPart& part, uint32_t e) {
    Elements& elements = shell.state.elements;
    if (part.first_element == kNone) part.first_element = e;
    if (part.last_element != kNone) elements.next[shell.element(part.last_element)] = e;
    elements.next[shell.element(e)] = kNone;
    part.last_element = e;
    ++part.element_count;
    part.mass += elements.mass[shell.element(e)];
    for (uint32_t v : elements.corner[shell.element(e)])
        if (shell.state.vertices.is_pinned[shell.vertex(v)]) part.has_pins = true;
}

uint32_t group_fragments(ShellView shell, std::span<FragmentPart> parts) {
    uint32_t* part = shell.state.elements.part.data() + shell.elements().first;
    join_neighbours(shell, part);
    uint32_t count = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        if (shell.state.elements.flags[shell.element(e)] & kDead) {
            part[e] = kNone;
            continue;
        }
        const bool is_root = part[e] == e;
        part[e] = is_root ? count : part[part[e]];
        if (is_root && count < parts.size()) parts[count] = {};
        count += is_root;
        if (part[e] < parts.size()) add_to_part(shell, parts[part[e]], e);
    }
    return count;
}

FragmentPart whole_part(const ShellView& shell) {
    Elements& elements = shell.state.elements;
    FragmentPart whole;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const bool is_dead = elements.flags[shell.element(e)] & kDead;
        elements.part[shell.element(e)] = is_dead ? kNone : 0;
        if (!is_dead) add_to_part(shell, whole, e);
    }
    return whole;
}

bool is_numbered_zero(const ShellView& shell) {
    static_assert(kNone + 1u == 0);
    const uint32_t* const part = shell.state.elements.part.data() + shell.elements().first;
    const uint32_t count = shell.element_count();
    uint32_t others = 0;
    for (uint32_t e = 0; e < count; ++e) others |= part[e] + 1 > 1;
    return others == 0;
}

void list_part(ShellView shell, FragmentPart& part, uint32_t number) {
    if (is_listed(part)) return;
    const double mass = part.mass;
    const bool has_pins = part.has_pins;
    part = {};
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        if (shell.state.elements.part[shell.element(e)] == number) add_to_part(shell, part, e);
    part.mass = mass;
    part.has_pins = has_pins;
}

bool is_of_one_part(const ShellView& shell) {
    if (is_numbered_zero(shell)) return true;
    const Elements& elements = shell.state.elements;
    uint32_t part = kNone;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        if (elements.flags[row] & kDead) continue;
        if (part == kNone) part = elements.part[row];
        if (elements.part[row] != part) return false;
    }
    return true;
}

void join_parts(ShellView shell, FragmentPart& from, FragmentPart& to, uint32_t number) {
    if (&from == &to || from.element_count == 0) return;
    Elements& elements = shell.state.elements;
    for (uint32_t e = from.first_element; e != kNone; e = elements.next[shell.element(e)])
        elements.part[shell.element(e)] = number;
    if (!is_listed(to))
        to.first_element = std::min(to.first_element, from.first_element);
    else if (to.element_count == 0)
        to.first_element = from.first_element;
    else
        elements.next[shell.element(to.last_element)] = from.first_element;
    if (is_listed(to)) to.last_element = from.last_element;
    to.element_count += from.element_count;
    to.mass += from.mass;
    to.has_pins = to.has_pins || from.has_pins;
    from = {};
}

}  // namespace cullet
