// Which rows of a body's shell a cut-out of it has.
#pragma once
#include <algorithm>
#include <bit>
#include <span>

#include "components/shell_rows.hpp"

namespace cullet {

inline uint32_t round_to_packs(uint32_t vertices) {
    return (vertices + kLanes - 1) / kLanes * kLanes;
}

/// Rows without their scratch, which is a third of an element's: in a cut-out it is written before it is read, and in
/// the body it says what rows stand where.
void copy_kept_rows(AnyTable& table, uint32_t from, uint32_t to, uint32_t count);

/// Whom a cut-out's vertices and hinges are in the body, by their numbers in the cut-out, and how many they are: from
/// fill_cut_out to put_back, in scratch of its first elements, the body's, that only what is drawn uses. A vertex or
/// hinge belongs to an element, so that three words an element hold either. Elements that cracks add come behind.
struct CutMaps {
    uint32_t *vertex, *hinge;
    uint32_t &vertex_count, &hinge_count;

    CutMaps(const ShellView& cut, uint32_t elements)
        : vertex(cut.state.elements.drawn[cut.elements().first].data()),
          hinge(vertex + size_t{3} * elements),
          vertex_count(hinge[size_t{3} * elements]),
          hinge_count((&vertex_count)[1]) {
        static_assert(sizeof(std::array<uint32_t, kMostDrawnTriangles>) >= 8 * sizeof(uint32_t));
    }
    void clear() { vertex_count = hinge_count = 0; }
    void add_vertex(uint32_t v) { vertex[vertex_count++] = v; }
    void add_hinge(uint32_t h) { hinge[hinge_count++] = h; }
};

/// Copies rows of tables to other rows of them, runs of neighbours column by column: the columns of a large body come
/// from memory, and are read faster one after another than all at once. Scratch columns are left out, and those that
/// begin at one of `others`. The runs are kept in scratch of a cut-out: first row, where it goes to, how many.
class RowRuns {
 public:
    RowRuns(const ShellView& cut, std::span<AnyTable* const> tables, std::span<const void* const> others = {})
        : tables_(tables),
          others_(others),
          runs_(cut.state.elements.other_slope.data() + cut.elements().first),
          most_(cut.elements().capacity) {}
    void add(uint32_t from, uint32_t to) {
        if (count_ > 0) {
            auto& last = runs_[count_ - 1];
            if (from == last[0] + last[2] && to == last[1] + last[2]) return void(++last[2]);
        }
        if (count_ == most_) copy();
        runs_[count_++] = {from, to, 1};
    }
    /// What was added, which is forgotten then.
    void copy();

 private:
    std::span<AnyTable* const> tables_;
    std::span<const void* const> others_;
    std::array<uint32_t, 3>* runs_;
    uint32_t most_, count_ = 0;
};

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
    RowBits has_element, has_vertex;
    uint32_t element_count = 0, vertex_count = 0, hinge_count = 0;

    /// Nothing is known yet but where the list is.
    explicit CutRows(const ShellView& of)
        : source(of),
          list(of.state.elements.next_in_cell.data() + of.elements().first),
          has_element{reinterpret_cast<uint32_t*>(of.state.elements.other_slope.data() + of.elements().first)},
          has_vertex{has_element.words + RowBits::words_of(of.element_count())},
          vertex_place_(of.state.vertices.copy.data() + of.vertices().first),
          element_place_(of.state.elements.copy.data() + of.elements().first) {}
    /// The same of a cut-out's vertices, by whom they are in the body (CutMaps). The elements' bits are not known.
    void number_vertices(std::span<const uint32_t> of_body);
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
    /// a bit a vertex of the body. Hinges are not counted. Needs the bits of the elements.
    void number(uint32_t count);
    /// The same from the list alone.
    void mark_and_number(uint32_t count);
    void count_hinges();

    /// Of a vertex that belongs to it, in the cut-out.
    uint32_t place_of(uint32_t v) const { return vertex_place_[v]; }
    /// In the cut-out, or kNone.
    uint32_t vertex(uint32_t v) const { return has_vertex.has(v) ? vertex_place_[v] : kNone; }
    uint32_t element(uint32_t e) const { return has_element.has(e) ? element_place_[e] : kNone; }
    /// Calls f(vertex of the body) for each, rising.
    template <class F>
    void for_each_vertex(F&& f) const {
        has_vertex.for_each(source.vertex_count(), f);
    }
    /// Calls f(hinge of the body) for each hinge between two elements, in the order of the cut-out's hinges: by the
    /// lower element, then by its edge.
    template <class F>
    void for_each_hinge(F&& f) const {
        const Elements& elements = source.state.elements;
        for (uint32_t e = 0; e < element_count; ++e) {
            const uint32_t row = source.element(list[e]);
            const auto &neighbour = elements.neighbour[row], &hinge = elements.hinge[row];
            for (uint32_t k = 0; k < 3; ++k)
                if (neighbour[k] != kNone && neighbour[k] > list[e] && hinge[k] != kNone &&
                    has_element.has(neighbour[k]))
                    f(hinge[k]);
        }
    }

 private:
    uint32_t *vertex_place_, *element_place_;
};

}  // namespace cullet
