#include "systems/quick/cut_rows.hpp"

#include <cstring>

namespace cullet {

// A vertex belongs to some element, so that the bits of both, an eighth of a word an element and at most three times
// that, fit three words an element.
void CutRows::number(uint32_t count) {
    static_assert(sizeof(std::array<uint32_t, 3>) == 3 * sizeof(uint32_t));
    const Elements& elements = source.state.elements;
    element_count = count;
    has_vertex.clear(source.vertex_count());
    for (uint32_t e = 0; e < count; ++e) {
        element_place_[list[e]] = e;
        for (const uint32_t v : elements.corner[source.element(list[e])]) has_vertex.add(v);
    }
    vertex_count = 0;
    for_each_vertex([&](uint32_t v) { vertex_place_[v] = vertex_count++; });
}

void copy_kept_rows(AnyTable& table, uint32_t from, uint32_t to, uint32_t count) {
    for (const ColumnInfo& c : table.columns())
        for (int a = 0; c.keep == Keep::State && a < c.lanes * c.sides; ++a) {
            std::byte* const memory = table.column_memory(c, a);
            std::memcpy(memory + size_t{to} * c.row_bytes, memory + size_t{from} * c.row_bytes,
                        size_t{count} * c.row_bytes);
        }
}

void CutRows::count_hinges() {
    hinge_count = 0;
    for_each_hinge([&](uint32_t, uint32_t, uint32_t, uint32_t, uint32_t) { ++hinge_count; });
}

}  // namespace cullet
