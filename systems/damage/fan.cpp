#include "systems/damage/fan.hpp"

#include <algorithm>

namespace cullet {
namespace {

/// Corner of `element` that is `vertex`, 3 when it is none.
uint8_t corner_of(const std::array<uint32_t, 3>& corner, uint32_t vertex) {
    for (uint8_t c = 0; c < 3; ++c)
        if (corner[c] == vertex) return c;
    return 3;
}

/// Adds elements from `element` on, turning over edge (corner + turn) % 3, until a border, the start or a full fan.
/// True when the walk came back to `start`.
bool walk(const ShellView& shell, uint32_t vertex, uint32_t element, uint32_t start, int turn, Fan& fan) {
    const Elements& elements = shell.state.elements;
    while (element != kNone && fan.count < kMostFan) {
        const uint32_t row = shell.element(element);
        const uint8_t corner = corner_of(elements.corner[row], vertex);
        CULLET_ASSERT(corner < 3, "vertex %u is no corner of element %u, reached over a neighbour link", vertex,
                      element);
        if (corner == 3) return false;
        fan.element[fan.count] = element;
        fan.corner[fan.count++] = corner;
        element = elements.neighbour[row][static_cast<uint32_t>(corner + turn) % 3];
        if (element == start) return true;
    }
    return false;
}

void sort_by_element(Fan& fan) {
    for (uint32_t i = 1; i < fan.count; ++i) {
        const uint32_t element = fan.element[i];
        const uint8_t corner = fan.corner[i];
        uint32_t j = i;
        for (; j > 0 && fan.element[j - 1] > element; --j)
            fan.element[j] = fan.element[j - 1], fan.corner[j] = fan.corner[j - 1];
        fan.element[j] = element, fan.corner[j] = corner;
    }
}

}  // namespace

void collect_fan(const ShellView& shell, uint32_t vertex, Fan& fan) {
    fan.count = 0;
    const uint32_t start = shell.state.vertices.element[shell.vertex(vertex)];
    if (start == kNone) return;
    if (!walk(shell, vertex, start, start, 2, fan) && fan.count > 0) {
        const uint32_t row = shell.element(start);
        const uint8_t corner = fan.corner[0];
        walk(shell, vertex, shell.state.elements.neighbour[row][corner], start, 0, fan);
    }
    sort_by_element(fan);
}

void collect_hinges(const ShellView& shell, const Fan& fan, FanHinges& hinges) {
    hinges.count = 0;
    // Inserted in order: a fan has about twelve, and a sort of all that repeat takes twice as long.
    for (uint32_t i = 0; i < fan.count; ++i)
        for (const uint32_t hinge : shell.state.elements.hinge[shell.element(fan.element[i])]) {
            if (hinge == kNone) continue;
            uint32_t at = hinges.count;
            while (at > 0 && hinges.hinge[at - 1] > hinge) --at;
            if (at > 0 && hinges.hinge[at - 1] == hinge) continue;
            for (uint32_t j = hinges.count++; j > at; --j) hinges.hinge[j] = hinges.hinge[j - 1];
            hinges.hinge[at] = hinge;
        }
}

}  // namespace cullet
