#include "systems/structures/shell/cell_hulls.hpp"

#include <algorithm>

#include "systems/hulls/extreme_points.hpp"
#include "systems/structures/shell/cell_elements.hpp"
#include "systems/structures/shell/cell_parts.hpp"
#include "systems/structures/shell/piece_shape.hpp"
#include "systems/structures/shell/prism.hpp"

namespace cullet {
namespace {

constexpr uint32_t kBatchElements = 256;  // a cell has about 128; of more a single hull is made, batch by batch
constexpr uint32_t kMostVertices = 3 * kBatchElements;
static_assert(kMostCellPoints == kMostCellParts * kMostHullPoints);
static_assert(2 * kMostVertices + kMostHullPoints <= kMostExtremeCandidates);
// Of the grain: a point above the hull by less is worth none. 0.05 cost twice the points and kept nothing from
// sinking.
constexpr float kGoodEnough = 0.2f;
// Of its size: sheet metal whose part is hollow by more is halved. A hull spans the hollow of a dent, and what lies in
// it would hover.
constexpr float kMostHollow = 0.03f;
constexpr float kMetalGrain = 0.025f;  // of its size: see grain_of()
// Of the grain: a hull that leaves out more is halved while the cell has parts left.
constexpr float kTooMuch = 0.4f;

uint32_t next_of(const ShellView& shell, uint32_t element) {
    return shell.state.elements.next_in_cell[shell.element(element)];
}

std::array<Vec3, 3> outer_triangle(const ShellView& shell, uint32_t element) {
    const auto c = shell.state.elements.corner[shell.element(element)];
    const Vertices& v = shell.state.vertices;
    return {v.rest[shell.vertex(c[0])], v.rest[shell.vertex(c[1])], v.rest[shell.vertex(c[2])]};
}

/// A cell's vertices, each once, with the sum of the ways in from the free edges that it is an end of. Neighbouring
/// cells share vertices and are worked off at once, so the places are kept here and not in a column: a table with open
/// addresses, never fuller than three eighths.
struct CellVertices {
    static constexpr uint32_t kPlaces = 2048;
    static_assert(8 * kMostVertices <= 3 * kPlaces);
    uint32_t vertex[kMostVertices];
    Vec3 way_in[kMostVertices];
    uint16_t place[kPlaces];  // number of the vertex plus 1, or 0
    uint32_t count = 0;

    void clear() {
        std::fill_n(place, kPlaces, uint16_t{0});
        count = 0;
    }
    uint32_t number_of(uint32_t v) {
        uint32_t at = v * 2654435761u >> 21;
        while (place[at] && vertex[place[at] - 1] != v) at = (at + 1) % kPlaces;
        if (place[at]) return place[at] - 1u;
        vertex[count] = v;
        way_in[count] = {};
        place[at] = static_cast<uint16_t>(++count);
        return count - 1;
    }
};

void gather_vertices(const ShellView& shell, std::span<const uint32_t> list, CellVertices& found) {
    const Elements& elements = shell.state.elements;
    found.clear();
    for (const uint32_t e : list) {
        const uint32_t row = shell.element(e);
        const auto& corner = elements.corner[row];
        uint32_t number[3];
        for (int k = 0; k < 3; ++k) number[k] = found.number_of(corner[k]);
        for (int k = 0; k < 3; ++k) {
            if (elements.neighbour[row][k] != kNone) continue;
            const auto p = outer_triangle(shell, e);
            const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
            const Vec3 in = normalised(cross(normal, p[(k + 1) % 3] - p[k]));
            found.way_in[number[k]] += in;
            found.way_in[number[(k + 1) % 3]] += in;
        }
    }
}

/// Points of one cell, part by part.
struct Workspace {
    uint32_t elements[kBatchElements];
    CellVertices vertices;
    Vec3 candidates[2 * kMostVertices + kMostHullPoints];
    uint32_t candidate_count = 0;
    ExtremePoints chosen;
    struct Part {
        Vec3 point[kMostHullPoints];
        uint32_t count = 0;
        float left_out = 0;
    } part[kMostCellParts];
    uint32_t part_count = 0;
};

void add_candidates(const ShellView& shell, std::span<const uint32_t> list, float margin, Workspace& work) {
    gather_vertices(shell, list, work.vertices);
    const Vertices& vertices = shell.state.vertices;
    for (uint32_t i = 0; i < work.vertices.count; ++i) {
        const uint32_t row = shell.vertex(work.vertices.vertex[i]);
        const Vec3 p = smoothed_place(shell.state, row) + margin * normalised(work.vertices.way_in[i]),
                   m = vertices.inward[row];
        const float pull = pull_of(margin, vertices.depth[row], work.vertices.way_in[i]);
        work.candidates[work.candidate_count++] = p + pull * m;
        work.candidates[work.candidate_count++] = p + (vertices.depth[row] - pull) * m;
    }
}

/// Diagonal of the box round these elements, m.
float size_of(const ShellView& shell, std::span<const uint32_t> list) {
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    for (const uint32_t e : list)
        for (const Vec3 p : outer_triangle(shell, e)) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    return length(high - low);
}

/// The margin, and of sheet metal at least so much of its size: a margin is a half of a sheet, and crumpled sheets have
/// bumps of that size everywhere. Four hulls of all their points each were most of a crash's worst frame.
float grain_of(const ShellView& shell, Sheet sheet, float margin, std::span<const uint32_t> list) {
    return sheet == Sheet::None ? margin : std::max(margin, kMetalGrain * size_of(shell, list));
}

void keep_extremes(const ShellView& shell, Workspace& work, float grain) {
    choose_extremes(shell.state.scratch, {work.candidates, work.candidate_count}, kMostHullPoints, kGoodEnough * grain,
                    work.chosen);
}

/// A cell of more elements than a batch has: one hull.
void choose_points_by_batches(const ShellView& shell, Sheet sheet, uint32_t first, float margin, Workspace& work) {
    Workspace::Part& part = work.part[0];
    work.part_count = 1;
    part.count = 0;
    for (uint32_t e = first; e != kNone;) {
        uint32_t count = 0;
        for (; count < kBatchElements && e != kNone; e = next_of(shell, e)) work.elements[count++] = e;
        std::copy_n(part.point, part.count, work.candidates);
        work.candidate_count = part.count;
        add_candidates(shell, {work.elements, count}, margin, work);
        keep_extremes(shell, work, grain_of(shell, sheet, margin, {work.elements, count}));
        part.count = work.chosen.count;
        for (uint32_t i = 0; i < part.count; ++i) part.point[i] = work.candidates[work.chosen.index[i]];
    }
}

void choose_part(const ShellView& shell, std::span<const uint32_t> list, float margin, float grain, Workspace& work,
                 Workspace::Part& part) {
    work.candidate_count = 0;
    add_candidates(shell, list, margin, work);
    keep_extremes(shell, work, grain);
    part.count = work.chosen.count;
    part.left_out = work.chosen.left_out;
    for (uint32_t i = 0; i < part.count; ++i) part.point[i] = work.candidates[work.chosen.index[i]];
}

/// How deep the hollow of a part is that its hull spans, as a share of its size. Of an open sheet both sides count, of
/// others the outer one: nothing lies inside.
float hollow_of(const ShellView& shell, Sheet sheet, std::span<const uint32_t> list) {
    Vec3 normal, low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    for (const uint32_t e : list) {
        const auto p = outer_triangle(shell, e);
        normal += cross(p[1] - p[0], p[2] - p[0]);
        for (const Vec3 q : p) {
            low = {std::min(low.x, q.x), std::min(low.y, q.y), std::min(low.z, q.z)};
            high = {std::max(high.x, q.x), std::max(high.y, q.y), std::max(high.z, q.z)};
        }
    }
    normal = normalised(normal);
    float deepest = 1e30f, highest = -1e30f, sum = 0;
    for (const uint32_t e : list)
        for (const Vec3 p : outer_triangle(shell, e)) {
            const float at = dot(p - low, normal);
            deepest = std::min(deepest, at), highest = std::max(highest, at);
            sum += at;
        }
    const float mean = sum / static_cast<float>(3 * list.size()), size = length(high - low);
    // Most of a cup lies low, most of a hill high.
    if (!(size > 0) || (sheet == Sheet::Closed && mean > 0.5f * (deepest + highest))) return 0;
    return (highest - deepest) / size;
}

void halve_what_is_hollow(const ShellView& shell, Sheet sheet, std::span<uint32_t> elements, CellParts& parts) {
    float hollow[kMostCellParts] = {hollow_of(shell, sheet, elements)};
    while (parts.count < kMostCellParts) {
        uint32_t worst = 0;
        for (uint32_t p = 1; p < parts.count; ++p)
            if (hollow[p] > hollow[worst]) worst = p;
        if (!(hollow[worst] > kMostHollow)) return;
        const uint32_t other = halve_part(shell, elements, parts, worst);
        if (other == worst)
            hollow[worst] = 0;
        else
            for (const uint32_t p : {worst, other}) hollow[p] = hollow_of(shell, sheet, parts.list(elements, p));
    }
}

/// Of the list of elements that begins with `first`; no points for an empty one.
void choose_points(const ShellView& shell, Sheet sheet, uint32_t first, float margin, Workspace& work) {
    work.part_count = 0;
    uint32_t count = 0;
    uint32_t e = first;
    for (; e != kNone && count < kBatchElements; e = next_of(shell, e)) work.elements[count++] = e;
    if (count == 0) return;
    if (e != kNone) return choose_points_by_batches(shell, sheet, first, margin, work);
    CellParts parts{.first = {0}, .size = {count}, .count = 1};
    if (sheet != Sheet::None) halve_what_is_hollow(shell, sheet, {work.elements, count}, parts);
    work.part_count = parts.count;
    const float grain = grain_of(shell, sheet, margin, {work.elements, count});
    for (uint32_t p = 0; p < parts.count; ++p)
        choose_part(shell, parts.list({work.elements, count}, p), margin, grain, work, work.part[p]);
    while (parts.count < kMostCellParts) {
        uint32_t worst = 0;
        for (uint32_t p = 1; p < parts.count; ++p)
            if (work.part[p].left_out > work.part[worst].left_out) worst = p;
        if (!(work.part[worst].left_out > kTooMuch * grain)) break;
        const uint32_t other = halve_part(shell, {work.elements, count}, parts, worst);
        if (other == worst) {
            work.part[worst].left_out = 0;
            continue;
        }
        work.part_count = parts.count;
        for (uint32_t p : {worst, other})
            choose_part(shell, parts.list({work.elements, count}, p), margin, grain, work, work.part[p]);
    }
}

uint32_t cell_row(const ShellView& shell, uint32_t cell) {
    return shell.cells().first + cell;
}

// Until pack_hulls, each cell's points stand at its first_point, where there is room for as many as it may have.
void write_points(const ShellView& shell, uint32_t cell, const Workspace& work) {
    Cells& cells = shell.state.cells;
    const uint32_t row = cell_row(shell, cell), first = shell.points().first + cells.first_point[row];
    uint32_t count = 0;
    cells.part_points[row] = {};
    for (uint32_t p = 0; p < work.part_count; ++p) {
        const Workspace::Part& part = work.part[p];
        cells.part_points[row][p] = static_cast<uint8_t>(part.count);
        for (uint32_t i = 0; i < part.count; ++i) shell.state.hull_points.point.set(first + count++, part.point[i]);
    }
    cells.point_count[row] = count;
}

/// Room for cells in turn, in the shell's range of points.
class PointRoom {
 public:
    explicit PointRoom(const ShellView& shell, uint32_t first = 0) : shell_(shell), next_(first) {}
    /// For points that are chosen later.
    void reserve(uint32_t cell) {
        Cells& cells = shell_.state.cells;
        const uint32_t row = cell_row(shell_, cell);
        place(cell, most_points(1, cells.element_count[row]));
        cells.point_count[row] = 0;
        cells.part_points[row] = {};
    }
    /// Of the cell in row `from`, whose points are relative to row `first`.
    void copy(uint32_t cell, uint32_t first, uint32_t from) {
        HullPoints& table = shell_.state.hull_points;
        Cells& cells = shell_.state.cells;
        const uint32_t row = cell_row(shell_, cell), count = cells.point_count[from];
        const uint32_t source = first + cells.first_point[from];
        place(cell, count);
        table.copy_rows(table, source, shell_.points().first + cells.first_point[row], count);
        cells.point_count[row] = count;
        cells.part_points[row] = cells.part_points[from];
    }

 private:
    void place(uint32_t cell, uint32_t count) {
        CULLET_ASSERT(next_ + count <= shell_.points().capacity, "hull points of cell %u do not fit", cell);
        shell_.state.cells.first_point[cell_row(shell_, cell)] = next_;
        next_ += count;
    }
    const ShellView& shell_;
    uint32_t next_;
};

/// Links the elements of each cell in rising order, and counts them: elements stand sorted by cell.
void link_sorted(const ShellView& shell) {
    Elements& elements = shell.state.elements;
    Cells& cells = shell.state.cells;
    const uint32_t count = shell.element_count();
    uint32_t e = 0;
    for (uint32_t c = 0; c < shell.cells().count; ++c) {
        const uint32_t first = e;
        while (e < count && elements.cell[shell.element(e)] == c) {
            const bool is_last = e + 1 == count || elements.cell[shell.element(e + 1)] != c;
            elements.next_in_cell[shell.element(e)] = is_last ? kNone : e + 1;
            ++e;
        }
        cells.first_element[cell_row(shell, c)] = first == e ? kNone : first;
        cells.element_count[cell_row(shell, c)] = e - first;
        cells.is_stale[cell_row(shell, c)] = 0;
    }
    CULLET_ASSERT(e == count, "elements of shell %u are not sorted by cell", shell.row.index);
    shell.shells().sorted_elements[shell.row] = count;
}

/// The same of live elements of cells that changed.
void link_changed(const ShellView& shell) {
    Elements& elements = shell.state.elements;
    Cells& cells = shell.state.cells;
    for (uint32_t c = 0; c < shell.cells().count; ++c) {
        const uint32_t row = cell_row(shell, c);
        if (!cells.is_changed[row]) continue;
        cells.first_element[row] = cells.last_element[row] = kNone;
        cells.element_count[row] = 0;
    }
    for_each_element_of_changed_cells(shell, [&](uint32_t e) {
        const uint32_t row = shell.element(e);
        if (elements.flags[row] & kDead) return;
        const uint32_t c = cell_row(shell, elements.cell[row]);
        elements.next_in_cell[row] = kNone;
        if (cells.first_element[c] == kNone)
            cells.first_element[c] = e;
        else
            elements.next_in_cell[shell.element(cells.last_element[c])] = e;
        cells.last_element[c] = e;
        ++cells.element_count[c];
    });
}

/// The same of live elements in any order.
void link_live(const ShellView& shell) {
    Elements& elements = shell.state.elements;
    Cells& cells = shell.state.cells;
    for (uint32_t c = 0; c < shell.cells().count; ++c) {
        cells.first_element[cell_row(shell, c)] = kNone;
        cells.element_count[cell_row(shell, c)] = 0;
    }
    for (uint32_t e = shell.element_count(); e-- > 0;) {
        const uint32_t row = shell.element(e);
        if (elements.flags[row] & kDead) continue;
        const uint32_t c = cell_row(shell, elements.cell[row]);
        elements.next_in_cell[row] = cells.first_element[c];
        cells.first_element[c] = e;
        ++cells.element_count[c];
    }
}

}  // namespace

Sheet sheet_of(Tables<const Structures, const MetalOwners, const MetalShells> rows, Row<Structures> structure) {
    const Row<MetalShells> metal = metal_of(rows, structure);
    if (!metal.exists()) return Sheet::None;
    return rows.metal_shells.crush_pressure[metal] == 0 ? Sheet::Open : Sheet::Closed;
}

float hull_margin(const ShellView& shell) {
    return shell.structures().margin[shell.structure];
}

void choose_hull(ShellView shell, uint32_t cell, Sheet sheet) {
    const Scratch<Workspace> work(shell.state.scratch);
    choose_points(shell, sheet, shell.state.cells.first_element[cell_row(shell, cell)], hull_margin(shell), *work);
    write_points(shell, cell, *work);
}

void pack_hulls(ShellView shell) {
    Cells& cells = shell.state.cells;
    Range& points = shell.points();
    points.count = shell.structures().shape_points[shell.structure];
    for (uint32_t c = 0; c < shell.cells().count; ++c) {
        const uint32_t row = cell_row(shell, c), count = cells.point_count[row];
        shell.state.hull_points.copy_rows(shell.state.hull_points, points.first + cells.first_point[row],
                                          points.first + points.count, count);
        cells.first_point[row] = points.count;
        points.count += count;
    }
}

void build_hulls(ShellView shell, Sheet sheet) {
    shell.structures().margin[shell.structure] = margin_for(shell.shells().thickness[shell.row]);
    clear_shape(shell);
    link_sorted(shell);
    PointRoom room(shell);
    for (uint32_t c = 0; c < shell.cells().count; ++c) {
        room.reserve(c);
        choose_hull(shell, c, sheet);
    }
    pack_hulls(shell);
}

namespace {

void empty_cells(const ShellView& shell) {
    Cells& cells = shell.state.cells;
    for (uint32_t c = 0; c < shell.cells().count; ++c) {
        const uint32_t row = cell_row(shell, c);
        cells.first_point[row] = cells.point_count[row] = 0;
        cells.part_points[row] = {};
        cells.is_stale[row] = 0;
        cells.same_cell[row] = kNone;
    }
}

}  // namespace

void empty_piece_cells(ShellView piece) {
    link_sorted(piece);
    empty_cells(piece);
}

void empty_rest_cells(ShellView shell) {
    link_live(shell);
    empty_cells(shell);
}

void copy_piece_hulls(ShellView piece, ShellView parent, float parents_margin, bool have_cells) {
    Cells& cells = piece.state.cells;
    link_sorted(piece);
    PointRoom room(piece);
    const bool may_copy = have_cells && std::fabs(hull_margin(piece) - parents_margin) <= 0.05f * parents_margin;
    const uint32_t parent_points = parent.points().first;
    for (uint32_t c = 0; c < piece.cells().count; ++c) {
        uint32_t& same = cells.same_cell[cell_row(piece, c)];
        if (!may_copy) same = kNone;
        if (same != kNone)
            room.copy(c, parent_points, cell_row(parent, same));
        else
            room.reserve(c);
    }
}

void find_changed_cells(ShellView shell, ShellView before) {
    const Elements& elements = shell.state.elements;
    Cells& cells = shell.state.cells;
    for (uint32_t c = 0; c < shell.cells().count; ++c)
        cells.is_changed[cell_row(shell, c)] = cells.is_stale[cell_row(shell, c)];
    if (before.row == shell.row) return;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t now = shell.element(e);
        bool is_same = e < before.element_count();
        if (is_same) {
            const uint32_t then = before.element(e);
            is_same = elements.corner[now] == elements.corner[then];
            for (int k = 0; k < 3; ++k)
                is_same = is_same && (elements.neighbour[now][k] == kNone) == (elements.neighbour[then][k] == kNone);
        }
        if (!is_same) cells.is_changed[cell_row(shell, elements.cell[now])] = kCracked;
    }
}

void copy_rest_hulls(ShellView shell, Range points, ShellView before, bool have_cells) {
    Cells& cells = shell.state.cells;
    const uint32_t count = shell.cells().count;
    shell.structures().shape[shell.structure] = static_cast<uint8_t>(ShapeKind::Cells);
    shell.structures().shape_points[shell.structure] = 0;
    for (uint32_t c = 0; c < count; ++c) {  // before counts are changed where `before` is the same shell
        const uint32_t row = cell_row(shell, c), then = cell_row(before, c);
        cells.list_count[row] = cells.element_count[row];
        cells.first_point[row] = cells.first_point[then];
        cells.point_count[row] = cells.point_count[then];
        cells.part_points[row] = cells.part_points[then];
    }
    link_live(shell);
    PointRoom room(shell);
    for (uint32_t c = 0; c < count; ++c) {
        const uint32_t row = cell_row(shell, c);
        const bool is_same = have_cells && !cells.is_changed[row] && cells.element_count[row] == cells.list_count[row];
        cells.same_cell[row] = is_same ? c : kNone;
        if (is_same) {
            room.copy(c, points.first, row);
        } else {
            room.reserve(c);
            cells.is_stale[row] = 0;
        }
    }
}

bool has_room_to_renew(ShellView shell) {
    const Cells& cells = shell.state.cells;
    const Range points = shell.points();
    uint64_t wanted = points.count;
    for (uint32_t c = 0; c < shell.cells().count; ++c)
        if (cells.is_changed[cell_row(shell, c)]) wanted += most_points(1, cells.element_count[cell_row(shell, c)]);
    return wanted <= points.capacity;
}

void renew_rest_hulls(ShellView shell) {
    Cells& cells = shell.state.cells;
    link_changed(shell);
    PointRoom room(shell, shell.points().count);
    for (uint32_t c = 0; c < shell.cells().count; ++c) {
        const uint32_t row = cell_row(shell, c);
        cells.same_cell[row] = cells.is_changed[row] ? kNone : c;
        if (!cells.is_changed[row]) continue;
        room.reserve(c);
        cells.is_stale[row] = 0;
    }
}

void pack_renewed_hulls(ShellView shell) {
    Cells& cells = shell.state.cells;
    Range& points = shell.points();
    for (uint32_t c = 0; c < shell.cells().count; ++c) {
        const uint32_t row = cell_row(shell, c), count = cells.point_count[row];
        if (cells.same_cell[row] != kNone) continue;
        shell.state.hull_points.copy_rows(shell.state.hull_points, points.first + cells.first_point[row],
                                          points.first + points.count, count);
        cells.first_point[row] = points.count;
        points.count += count;
    }
}

}  // namespace cullet
