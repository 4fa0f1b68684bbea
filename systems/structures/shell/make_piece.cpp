#include "systems/structures/shell/make_piece.hpp"

#include <algorithm>

#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/metal_piece.hpp"
#include "systems/structures/shell/piece_shape.hpp"

namespace cullet {
namespace {

constexpr uint32_t kMostCellElements = 128;
constexpr uint32_t kFewCellElements = 48;  // below it a cell joins a neighbour

template <class Visit>
void for_each_element(const ShellView& shell, const FragmentPart& part, Visit visit) {
    for (uint32_t e = part.first_element; e != kNone; e = shell.state.elements.next[shell.element(e)]) visit(e);
}

uint32_t cell_row(const ShellView& shell, uint32_t cell) {
    return shell.cells().first + cell;
}

struct Counts {
    uint32_t vertices = 0, hinges = 0, cells = 0;
};

// Marks the part's vertices and lists its elements by cell. A vertex's mark is any number but kNone.
Counts mark_part(const ShellView& shell, const FragmentPart& part) {
    ShellRows& state = shell.state;
    Elements& elements = state.elements;
    Cells& cells = state.cells;
    for_each_element(shell, part, [&](uint32_t e) {
        const uint32_t row = shell.element(e);
        for (uint32_t v : elements.corner[row]) state.vertices.copy[shell.vertex(v)] = kNone;
        cells.list_count[cell_row(shell, elements.cell[row])] = 0;
    });
    Counts counts;
    for_each_element(shell, part, [&](uint32_t e) {
        const uint32_t row = shell.element(e), c = cell_row(shell, elements.cell[row]);
        for (int k = 0; k < 3; ++k) {
            uint32_t& mark = state.vertices.copy[shell.vertex(elements.corner[row][k])];
            if (mark == kNone) mark = counts.vertices++;
            const uint32_t n = elements.neighbour[row][k];
            if (n != kNone && n > e && elements.hinge[row][k] != kNone) ++counts.hinges;
        }
        elements.next_in_cell[row] = kNone;
        if (cells.list_count[c]++ == 0) {
            cells.first_element[c] = e;
            cells.merged[c] = elements.cell[row];
            ++counts.cells;
        } else {
            elements.next_in_cell[shell.element(cells.last_element[c])] = e;
        }
        cells.last_element[c] = e;
    });
    return counts;
}

uint32_t final_cell(const ShellView& shell, uint32_t cell) {
    const Cells& cells = shell.state.cells;
    while (cells.merged[cell_row(shell, cell)] != cell) cell = cells.merged[cell_row(shell, cell)];
    return cell;
}

/// The neighbouring cell with which `cell` shares most edges and at most 128 elements; ties to the lower. kNone: none.
uint32_t best_neighbour(const ShellView& shell, uint32_t cell) {
    constexpr uint32_t kMost = 32;
    uint32_t found[kMost], edges[kMost], count = 0;
    const Elements& elements = shell.state.elements;
    const Cells& cells = shell.state.cells;
    const uint32_t own = cells.list_count[cell_row(shell, cell)];
    for (uint32_t e = cells.first_element[cell_row(shell, cell)]; e != kNone;
         e = elements.next_in_cell[shell.element(e)])
        for (uint32_t n : elements.neighbour[shell.element(e)]) {
            if (n == kNone) continue;
            const uint32_t other = final_cell(shell, elements.cell[shell.element(n)]);
            if (other == cell || own + cells.list_count[cell_row(shell, other)] > kMostCellElements) continue;
            const uint32_t at = static_cast<uint32_t>(std::find(found, found + count, other) - found);
            if (at == kMost) continue;
            if (at == count) found[count] = other, edges[count++] = 0;
            ++edges[at];
        }
    uint32_t best = kNone;
    for (uint32_t i = 0; i < count; ++i)
        if (best == kNone || edges[i] > edges[best] || (edges[i] == edges[best] && found[i] < found[best])) best = i;
    return best == kNone ? kNone : found[best];
}

void join_cells(const ShellView& shell, uint32_t from, uint32_t to) {
    Cells& cells = shell.state.cells;
    const uint32_t f = cell_row(shell, from), t = cell_row(shell, to);
    shell.state.elements.next_in_cell[shell.element(cells.last_element[t])] = cells.first_element[f];
    cells.last_element[t] = cells.last_element[f];
    cells.list_count[t] += cells.list_count[f];
    cells.merged[f] = to;
    cells.is_changed[t] |= kCracked;
}

/// Joins small cells to neighbours, by rising cell, until none can. Returns how many cells are left.
uint32_t merge_small_cells(const ShellView& shell, const FragmentPart& part, uint32_t count) {
    const Elements& elements = shell.state.elements;
    bool is_changing = true;
    while (is_changing) {
        is_changing = false;
        for_each_element(shell, part, [&](uint32_t e) {
            const uint32_t cell = elements.cell[shell.element(e)], row = cell_row(shell, cell);
            const bool is_small_head = shell.state.cells.first_element[row] == e &&
                                       shell.state.cells.merged[row] == cell &&
                                       shell.state.cells.list_count[row] < kFewCellElements;
            if (!is_small_head) return;
            const uint32_t other = best_neighbour(shell, cell);
            if (other == kNone) return;
            join_cells(shell, cell, other);
            --count;
            is_changing = true;
        });
    }
    return count;
}

/// The part's vertices in rising order, into the copy column of the piece's own rows; and the way back.
void order_vertices(const ShellView& shell, const FragmentPart& part, const ShellView& piece, uint32_t count) {
    Vertices& vertices = shell.state.vertices;
    uint32_t* source = vertices.copy.data() + piece.vertices().first;
    for_each_element(shell, part, [&](uint32_t e) {
        for (uint32_t v : shell.state.elements.corner[shell.element(e)]) source[vertices.copy[shell.vertex(v)]] = v;
    });
    std::sort(source, source + count);
    for (uint32_t i = 0; i < count; ++i) vertices.copy[shell.vertex(source[i])] = i;
}

/// The same where the piece is all that is left of the shell: nothing is to be sorted.
void order_live_vertices(const ShellView& shell, const ShellView& piece, [[maybe_unused]] uint32_t expected) {
    Vertices& vertices = shell.state.vertices;
    uint32_t* const source = vertices.copy.data() + piece.vertices().first;
    uint32_t count = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        if (vertices.element[shell.vertex(v)] == kNone) continue;
        vertices.copy[shell.vertex(v)] = count;
        source[count++] = v;
    }
    CULLET_ASSERT(count == expected, "%u live vertices, and elements with %u", count, expected);
}

/// Row of `vertex` in the piece, or kNone when the piece does not have it.
uint32_t vertex_in_piece(const uint32_t* source, uint32_t count, uint32_t vertex) {
    const uint32_t* at = std::lower_bound(source, source + count, vertex);
    return at < source + count && *at == vertex ? static_cast<uint32_t>(at - source) : kNone;
}

void copy_vertices(const ShellView& shell, const ShellView& piece, uint32_t count) {
    Vertices& vertices = shell.state.vertices;
    const Structures& structures = shell.structures();
    const bool is_whole = structures.generation[piece.structure] == structures.generation[shell.structure];
    uint32_t* source = vertices.copy.data() + piece.vertices().first;
    for (uint32_t i = 0; i < count;) {
        const uint32_t first = i, from = source[i];
        while (i < count && source[i] == from + (i - first)) ++i;
        vertices.copy_rows(vertices, shell.vertex(from), piece.vertex(first), i - first);
        // The copies brought their old copy column along: the row in the piece.
        for (uint32_t k = first; k < i; ++k) source[k] = from + (k - first);
    }
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t row = piece.vertex(i);
        if (vertices.crack_start[row] != kNone)
            vertices.crack_start[row] = vertex_in_piece(source, count, vertices.crack_start[row]);
        const bool counts = vertices.crack[row] == static_cast<uint8_t>(CrackState::Tip) || is_whole;
        if (counts && vertices.crack[row]) piece.structures().has_cracks[piece.structure] = 1;
        vertices.ready_time[row] = 0;
        vertices.is_start_banned[row] = 0;
        vertices.displacement.set(row, {});
        vertices.crush[row] = 0;
        vertices.velocity.set(row, {});
        for (int side : {0, 1}) vertices.probe.set(row, {}, side);
    }
    piece.vertices().count = count;
}

/// Calls visit(cell, its row) for each cell that is left, in the order of their first elements.
template <class Visit>
void for_each_cell(const ShellView& shell, const FragmentPart& part, Visit visit) {
    const Cells& cells = shell.state.cells;
    for_each_element(shell, part, [&](uint32_t head) {
        const uint32_t cell = shell.state.elements.cell[shell.element(head)], c = cell_row(shell, cell);
        if (cells.first_element[c] == head && cells.merged[c] == cell) visit(cell, c);
    });
}

/// Copies the elements and springs of one cell's list behind those that the piece has.
void copy_cell(const ShellView& shell, const ShellView& piece, uint32_t head, uint32_t number) {
    Elements& elements = shell.state.elements;
    uint32_t& count = piece.elements().count;
    for (uint32_t e = head; e != kNone;) {
        const uint32_t first = e, to = count;
        uint32_t next = e;
        do {
            elements.copy[shell.element(next)] = count++;
            next = elements.next_in_cell[shell.element(e = next)];
        } while (next == e + 1);
        const uint32_t rows = count - to;
        elements.copy_rows(elements, shell.element(first), piece.element(to), rows);
        shell.state.triangle_springs.copy_rows(shell.state.triangle_springs, shell.element(first), piece.element(to),
                                               rows);
        for (uint32_t i = to; i < count; ++i) elements.cell[piece.element(i)] = number;
        e = next;
    }
}

/// Which of the shell's hinges this one of the piece is going to be, until copy_hinges.
uint32_t& source_of_hinge(const ShellView& piece, uint32_t hinge) {
    return piece.state.hinges.vertex[piece.hinge(hinge)][0];
}
uint32_t list_hinge(const ShellView& piece, uint32_t hinge) {
    const uint32_t to = piece.hinges().count++;
    source_of_hinge(piece, to) = hinge;
    return to;
}
/// In runs: hinges mostly stand in the order of their elements.
void copy_hinges(const ShellView& shell, const ShellView& piece) {
    Hinges& hinges = shell.state.hinges;
    const uint32_t count = piece.hinges().count;
    for (uint32_t h = 0; h < count;) {
        const uint32_t first = h, from = source_of_hinge(piece, h);
        while (h < count && source_of_hinge(piece, h) == from + (h - first)) ++h;
        hinges.copy_rows(hinges, shell.hinge(from), piece.hinge(first), h - first);
    }
    for (uint32_t h = 0; h < count; ++h)
        for (uint32_t& v : hinges.vertex[piece.hinge(h)]) v = shell.state.vertices.copy[shell.vertex(v)];
}

/// Turns what the copied elements name into the piece's own rows.
void renumber_elements(const ShellView& shell, const FragmentPart& part, const ShellView& piece) {
    ShellRows& state = shell.state;
    Elements& elements = state.elements;
    for_each_element(shell, part, [&](uint32_t old) {
        const uint32_t e = elements.copy[shell.element(old)], row = piece.element(e);
        elements.part[row] = 0;
        for (int k = 0; k < 3; ++k) {
            elements.corner[row][k] = state.vertices.copy[shell.vertex(elements.corner[row][k])];
            state.vertices.element[piece.vertex(elements.corner[row][k])] = e;
            const uint32_t n = elements.neighbour[shell.element(old)][k], h = elements.hinge[shell.element(old)][k];
            elements.neighbour[row][k] = n == kNone ? kNone : elements.copy[shell.element(n)];
            elements.hinge[row][k] = kNone;
            if (n == kNone || h == kNone) continue;
            if (n > old) {
                elements.hinge[row][k] = list_hinge(piece, h);
                continue;
            }
            // The neighbour came first and has copied it; two elements may share two edges, hence the old number.
            const auto& others = elements.hinge[shell.element(n)];
            for (int j = 0; j < 3; ++j)
                if (others[j] == h)
                    elements.hinge[row][k] = elements.hinge[piece.element(elements.copy[shell.element(n)])][j];
        }
    });
}

void inherit(const ShellView& from, const ShellView& to) {
    Structures& structures = from.structures();
    const auto inherit_all = [](uint32_t parent, uint32_t child, auto&... column) {
        ((column[child] = column[parent]), ...);
    };
    inherit_all(from.structure, to.structure, structures.material, structures.damage_model, structures.intact_mass,
                structures.first_crack_speed, structures.first_crack_force);
    Shells& shells = from.shells();
    inherit_all(from.row, to.row, shells.depth_floor, shells.mean_edge, shells.time_step, shells.triangle_limit,
                shells.hinge_limit, shells.vertex_limit);
}

void copy_shape(Structures& structures, Row<Structures> from, Row<Structures> to) {
    structures.shape[to] = structures.shape[from];
    structures.shape_points[to] = structures.shape_points[from];
    structures.box_ratio[to] = structures.box_ratio[from];
    structures.hull_ratio[to] = structures.hull_ratio[from];
    structures.margin[to] = structures.margin[from];
}

ShellRoom room_of(const Counts& counts, const FragmentPart& part) {
    return {.vertices = (counts.vertices + kLanes - 1) / kLanes * kLanes,
            .elements = part.element_count,
            .hinges = counts.hinges,
            .cells = counts.cells,
            .points = most_points(counts.cells, part.element_count)};
}

}  // namespace

ShellRoom piece_room(ShellView broken, const FragmentPart& part) {
    Counts counts = mark_part(broken, part);
    counts.cells = merge_small_cells(broken, part, counts.cells);
    return room_of(counts, part);
}

namespace {

/// Springs at the part's vertices, which are marked by their numbers in the order of their first elements.
uint32_t metal_springs_of(MetalShellRows rows, const ShellView& shell, const FragmentPart& part) {
    const uint32_t first = rows.metal_shells.vertices[metal_of(rows, shell.structure)].first;
    const uint32_t* const mark = shell.state.vertices.copy.data() + shell.vertices().first;
    uint32_t next = 0, count = 0;
    for_each_element(shell, part, [&](uint32_t e) {
        for (const uint32_t v : shell.state.elements.corner[shell.element(e)]) {
            if (mark[v] != next) continue;
            ++next;
            count += rows.metal_vertices.spring_count[first + v];
        }
    });
    return count;
}

/// Of metal: sub-shells as many as the broken shell has at most, which are few.
MetalRoom metal_room(MetalShellRows rows, const ShellView& broken, const FragmentPart& part, const ShellRoom& shell) {
    const MetalRoom whole = metal_room_of(rows, broken.structure);
    const uint32_t cells = std::min(whole.cells, shell.elements);
    return {shell.vertices, shell.elements, metal_springs_of(rows, broken, part), cells,
            std::min(whole.borders, cells * cells)};
}

/// A shell for the part, with rows of metal where it is of metal.
Row<Structures> make_rows(MetalShellRows rows, const ShellView& broken, const FragmentPart& part, const ShellRoom& room,
                          const char** full) {
    const Row<Structures> row = make_shell_unclear(rows, room, full);
    if (!row.exists() || !metal_of(rows, broken.structure).exists()) return row;
    if (reserve_metal(rows, broken.structure, row, metal_room(rows, broken, part, room), full)) return row;
    release_shell(rows, row);
    return {};
}

/// What follows the copied elements.
void finish_piece(MetalShellRows rows, const ShellView& shell, const FragmentPart& part, const ShellView& piece,
                  uint32_t vertex_count) {
    renumber_elements(shell, part, piece);
    copy_hinges(shell, piece);
    clear_pack_ends(shell.state, piece.structure);
    piece.vertices().count = (vertex_count + kLanes - 1) / kLanes * kLanes;
    piece.structures().live_elements[piece.structure] = piece.element_count();
    sum_vertex_masses(piece);
    measure_shell(piece);
    piece.structures().margin[piece.structure] = margin_for(piece.shells().thickness[piece.row]);
    fill_metal(rows, shell.structure, piece.structure, {part.first_element, vertex_count});
}

void begin_piece(const ShellView& shell, const ShellView& piece, uint32_t vertex_count) {
    inherit(shell, piece);
    copy_vertices(shell, piece, vertex_count);
}

}  // namespace

// Cells of the broken shell may be shared by parts: what they say of this one is written to the piece's own.
Row<Structures> reserve_piece(MetalShellRows rows, Row<Structures> broken, const FragmentPart& part, uint8_t generation,
                              const char** full) {
    ShellRows& state = rows;
    const ShellView shell(state, broken);
    Counts counts = mark_part(shell, part);
    counts.cells = merge_small_cells(shell, part, counts.cells);
    const Row<Structures> row = make_rows(rows, shell, part, room_of(counts, part), full);
    if (!row.exists()) return row;
    const ShellView piece(state, row);
    state.structures.generation[row] = generation;
    state.structures.damage_model[row] = state.structures.damage_model[broken];  // asked before the rows are filled
    piece.vertices().count = counts.vertices;
    Cells& cells = state.cells;
    for_each_cell(shell, part, [&](uint32_t cell, uint32_t c) {
        const uint32_t own = cell_row(piece, state.structures.cells[row].count++);
        const bool is_same = !(cells.is_changed[c] & kCracked) && cells.list_count[c] == cells.element_count[c];
        cells.first_element[own] = cells.first_element[c];
        cells.same_cell[own] = is_same ? cell : kNone;
    });
    return row;
}

void fill_piece(MetalShellRows rows, Row<Structures> broken, const FragmentPart& part, Row<Structures> row) {
    ShellRows& state = rows;
    const ShellView shell(state, broken), piece(state, row);
    const uint32_t vertex_count = piece.vertex_count();
    order_vertices(shell, part, piece, vertex_count);
    begin_piece(shell, piece, vertex_count);
    for (uint32_t c = 0; c < state.structures.cells[row].count; ++c)
        copy_cell(shell, piece, state.cells.first_element[cell_row(piece, c)], c);
    finish_piece(rows, shell, part, piece, vertex_count);
}

Row<Structures> make_piece(MetalShellRows rows, Row<Structures> broken, const FragmentPart& part, uint8_t generation,
                           const char** full) {
    const Row<Structures> row = reserve_piece(rows, broken, part, generation, full);
    if (!row.exists()) return row;
    fill_piece(rows, broken, part, row);
    build_hulls(ShellView(rows, row), sheet_of(rows, row));
    return row;
}

Row<Structures> compact_shell(MetalShellRows rows, Row<Structures> old, const FragmentPart& whole, const char** full) {
    ShellRows& state = rows;
    const ShellView shell(state, old);
    const Counts counts = mark_part(shell, whole);
    ShellRoom room = room_of(counts, whole);
    room.cells = state.structures.cells[old].count;
    room.points = state.structures.points[old].count;
    const Row<Structures> row = make_rows(rows, shell, whole, room, full);
    if (!row.exists()) return row;
    const ShellView piece(state, row);
    state.structures.generation[row] = state.structures.generation[old];
    order_live_vertices(shell, piece, counts.vertices);
    begin_piece(shell, piece, counts.vertices);
    for_each_cell(shell, whole,
                  [&](uint32_t cell, uint32_t c) { copy_cell(shell, piece, state.cells.first_element[c], cell); });
    finish_piece(rows, shell, whole, piece, counts.vertices);
    Range &cells = state.structures.cells[row], &points = state.structures.points[row];
    cells.count = room.cells;
    points.count = room.points;
    state.cells.copy_rows(state.cells, state.structures.cells[old].first, cells.first, cells.count);
    state.hull_points.copy_rows(state.hull_points, state.structures.points[old].first, points.first, points.count);
    state.structures.has_cracks[row] = state.structures.has_cracks[old];
    copy_shape(state.structures, old, row);
    return row;
}

}  // namespace cullet
