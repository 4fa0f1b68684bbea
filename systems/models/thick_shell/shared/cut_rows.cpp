#include "systems/models/thick_shell/shared/cut_rows.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

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
        for (int a = 0; c.is_state() && a < c.lanes * c.sides; ++a) {
            std::byte* const memory = table.column_memory(c, a);
            std::memcpy(memory + size_t{to} * c.row_bytes, memory + size_t{from} * c.row_bytes,
                        size_t{count} * c.row_bytes);
        }
}

void RowRuns::copy() {
    const std::span<const std::array<uint32_t, 3>> runs(runs_, std::exchange(count_, 0u));
    for (AnyTable* const table : tables_)
        for (const ColumnInfo& c : table->columns()) {
            const bool is_other =
                std::find(others_.begin(), others_.end(), table->column_memory(c, 0)) != others_.end();
            for (int a = 0; c.is_state() && !is_other && a < c.lanes * c.sides; ++a) {
                std::byte* const memory = table->column_memory(c, a);
                for (const auto& [from, to, count] : runs)
                    std::memcpy(memory + size_t{to} * c.row_bytes, memory + size_t{from} * c.row_bytes,
                                size_t{count} * c.row_bytes);
            }
        }
}

void CutRows::number_vertices(std::span<const uint32_t> of_body) {
    has_vertex.clear(source.vertex_count());
    vertex_count = 0;
    for (const uint32_t v : of_body) {
        has_vertex.add(v);
        vertex_place_[v] = vertex_count++;
    }
}

void CutRows::mark_and_number(uint32_t count) {
    has_element.clear(source.element_count());
    for (uint32_t e = 0; e < count; ++e) has_element.add(list[e]);
    number(count);
}

void CutRows::count_hinges() {
    hinge_count = 0;
    for_each_hinge([&](uint32_t) { ++hinge_count; });
}

}  // namespace cullet
