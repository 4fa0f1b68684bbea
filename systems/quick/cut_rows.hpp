// Which rows of a body's shell a cut-out of it has.
#pragma once
#include <algorithm>
#include <bit>

#include "components/state.hpp"

namespace cullet {

inline uint32_t round_to_packs(uint32_t vertices) {
    return (vertices + kLanes - 1) / kLanes * kLanes;
}

/// Rows without their scratch, which is a third of an element's: in a cut-out it is written before it is read, and in
/// the body it says what rows stand where.
void copy_kept_rows(AnyTable& table, uint32_t from, uint32_t to, uint32_t count);

/// Which rows of a range are meant, 32 in a word: to clear them and to look for those that are costs a thirtieth of
/// what a mark a row does.
struct RowBits {
    uint32_t* words;

    static uint32_t words_of(uint32_t rows) { return (rows + 31) / 32; }
    void clear(uint32_t rows) const { std::fill_n(words, words_of(rows), 0u); }
    bool has(uint32_t row) const { return words[row / 32] >> (row % 32) & 1; }
    void add(uint32_t row) const { words[row / 32] |= 1u << (row % 32); }
    /// Calls f(row) for those of the first `rows`, rising.
    template <class F>
    void for_each(uint32_t rows, F&& f) const {
        for (uint32_t w = 0; w < words_of(rows); ++w)
            for (uint32_t left = words[w]; left != 0; left &= left - 1)
                f(32 * w + static_cast<uint32_t>(std::countr_zero(left)));
    }
};

/// The cut-out has the elements of `list`, their corners, and the hinges between them, all in the order that they have
/// in the body's shell. Kept in scratch of that shell: Vertices.copy and Elements.copy say where a row is in the
/// cut-out, Elements.next_in_cell is the list, and bits in Elements.other_slope say which vertices belong to it.
struct CutRows {
    ShellView source;
    uint32_t* list;
    RowBits has_element, has_vertex;  // the first for whoever makes the list
    uint32_t element_count = 0, vertex_count = 0, hinge_count = 0;

    /// Nothing is known yet but where the list is.
    explicit CutRows(const ShellView& of)
        : source(of),
          list(of.state.elements.next_in_cell.data() + of.elements().first),
          has_element{reinterpret_cast<uint32_t*>(of.state.elements.other_slope.data() + of.elements().first)},
          has_vertex{has_element.words + RowBits::words_of(of.element_count())},
          vertex_place_(of.state.vertices.copy.data() + of.vertices().first),
          element_place_(of.state.elements.copy.data() + of.elements().first) {}
    /// As number() left it in this step, for a cut-out whose counts stand.
    CutRows(const ShellView& of, const ShellView& cut) : CutRows(of) {
        element_count = cut.element_count(), vertex_count = cut.vertex_count(), hinge_count = cut.hinge_count();
    }

    /// Whether the bits fit. They do where each vertex belongs to some element; a file may say otherwise.
    static bool has_room(const ShellView& of) {
        return RowBits::words_of(of.element_count()) + RowBits::words_of(of.vertex_count()) <=
               uint64_t{3} * of.element_count();
    }
    /// Numbers what belongs to the first `count` elements of the list, which rise. O(the cut-out), and a look at
    /// a bit a vertex of the body. Hinges are not counted.
    void number(uint32_t count);
    void count_hinges();

    /// In the cut-out, or kNone.
    uint32_t vertex(uint32_t v) const { return has_vertex.has(v) ? vertex_place_[v] : kNone; }
    uint32_t element(uint32_t e) const {
        const uint32_t place = element_place_[e];
        return place < element_count && list[place] == e ? place : kNone;
    }
    /// Calls f(vertex of the body) for each, rising.
    template <class F>
    void for_each_vertex(F&& f) const {
        has_vertex.for_each(source.vertex_count(), f);
    }
    /// Calls f(element, edge, other element, its edge, hinge of the body) for each hinge between two elements, the
    /// elements by their numbers in the cut-out, in the order of the cut-out's hinges.
    template <class F>
    void for_each_hinge(F&& f) const {
        const Elements& elements = source.state.elements;
        for (uint32_t e = 0; e < element_count; ++e) {
            const uint32_t row = source.element(list[e]);
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t n = elements.neighbour[row][k], hinge = elements.hinge[row][k];
                if (n == kNone || n < list[e] || hinge == kNone) continue;
                const uint32_t other = element(n);
                if (other == kNone) continue;
                const auto& hinges = elements.hinge[source.element(n)];
                for (uint32_t j = 0; j < 3; ++j)
                    if (hinges[j] == hinge) f(e, k, other, j, hinge);
            }
        }
    }

 private:
    uint32_t *vertex_place_, *element_place_;
};

}  // namespace cullet
