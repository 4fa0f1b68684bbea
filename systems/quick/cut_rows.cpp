#include "systems/quick/cut_rows.hpp"

#include <algorithm>
#include <cstring>

namespace cullet {

void CutRows::number(uint32_t count) {
    const Elements& elements = source.state.elements;
    constexpr uint32_t kCorner = 0;
    element_count = count;
    std::fill_n(vertex_place_, source.vertex_count(), kNone);
    for (uint32_t e = 0; e < count; ++e) {
        element_place_[list[e]] = e;
        for (const uint32_t v : elements.corner[source.element(list[e])]) vertex_place_[v] = kCorner;
    }
    vertex_count = 0;
    for (uint32_t v = 0; v < source.vertex_count(); ++v)
        if (vertex_place_[v] == kCorner) vertex_place_[v] = vertex_count++;
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
