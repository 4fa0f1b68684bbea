#include "systems/fragments/cell_hulls.hpp"

#include <algorithm>
#include <iterator>

namespace cullet {
namespace {

constexpr uint32_t kBatchElements = 256;  // a cell has about 128; more are worked off in batches
constexpr uint32_t kMostVertices = 3 * kBatchElements;
constexpr uint32_t kMostCandidates = 2 * kMostVertices + kMostHullPoints;
constexpr float kGoodEnough = 0.05f;  // of the margin: a reach lacking less is worth no point

struct Frame {
    Vec3 x, y, n;
};

/// Points by lanes, so that reaches are found 8 at a time.
struct Candidates {
    alignas(32) float x[kMostCandidates + kLanes], y[kMostCandidates + kLanes], z[kMostCandidates + kLanes];
    uint32_t count = 0;
    void add(Vec3 p) {
        x[count] = p.x, y[count] = p.y, z[count] = p.z;
        ++count;
    }
    Vec3 point(uint32_t i) const { return {x[i], y[i], z[i]}; }
};

// Cosine and sine of k * 30 degrees, and what turns by 15 more.
constexpr float kHalfRoot3 = 0.8660254f, kCosine15 = 0.9659258f, kSine15 = 0.2588190f;
constexpr float kTurn[12][2] = {
    {1, 0},  {kHalfRoot3, 0.5f},   {0.5f, kHalfRoot3},   {0, 1},  {-0.5f, kHalfRoot3}, {-kHalfRoot3, 0.5f},
    {-1, 0}, {-kHalfRoot3, -0.5f}, {-0.5f, -kHalfRoot3}, {0, -1}, {0.5f, -kHalfRoot3}, {kHalfRoot3, -0.5f}};

// Round the patch at each of these heights of the direction's tip over the plane, every second ring turned by half a
// step: no direction is farther than about 15 degrees from one of them. With nothing between 45 and 90 degrees jagged
// shards of 12 cm stood 4.5 mm deep in the floor, on corners that their hulls did not have.
constexpr float kLift[] = {0.3f, 0.3f, -0.3f, -0.3f, 0, 0, 0.8f, 0.8f, -0.8f, -0.8f, 1.7f, 1.7f, -1.7f, -1.7f, 4, -4};
constexpr uint32_t kRings = std::size(kLift);
constexpr uint32_t kDirections = 12 * kRings + 2;

struct Directions {
    Vec3 way[kDirections];
    explicit Directions(const Frame& f) {
        uint32_t count = 0;
        for (uint32_t ring = 0; ring < kRings; ++ring)
            for (const auto& turn : kTurn) {
                const bool is_between = ring % 2 == 1;
                const float c = is_between ? kCosine15 * turn[0] - kSine15 * turn[1] : turn[0];
                const float s = is_between ? kCosine15 * turn[1] + kSine15 * turn[0] : turn[1];
                way[count++] = normalised(c * f.x + s * f.y + kLift[ring] * f.n);
            }
        way[count++] = f.n;
        way[count++] = -f.n;
    }
};

/// The candidate that reaches farthest, the first of equals, and how far. Candidates beyond the count repeat the first.
/// In three plain loops, which the compiler turns into vector code; with one it branches.
uint32_t farthest(const Candidates& list, Vec3 way, float& reach) {
    alignas(32) float reaches[kMostCandidates + kLanes];
    const uint32_t count = (list.count + kLanes - 1) / kLanes * kLanes;
    for (uint32_t i = 0; i < count; ++i) reaches[i] = way.x * list.x[i] + way.y * list.y[i] + way.z * list.z[i];
    float best[kLanes];
    for (uint32_t l = 0; l < kLanes; ++l) best[l] = reaches[l];
    for (uint32_t i = kLanes; i < count; i += kLanes)
        for (uint32_t l = 0; l < kLanes; ++l) best[l] = reaches[i + l] > best[l] ? reaches[i + l] : best[l];
    reach = best[0];
    for (uint32_t l = 1; l < kLanes; ++l) reach = best[l] > reach ? best[l] : reach;
    uint32_t at = 0;
    while (at + 1 < count && reaches[at] != reach) ++at;
    return at;
}

/// Keeps all that there are up to 32; else at most 32: again and again the point whose direction lacks most reach so
/// far, the first of equals, until none lacks more than `enough`.
void keep_extremes(Candidates& list, const Directions& directions, float enough) {
    if (list.count <= kMostHullPoints) return;
    for (uint32_t l = 0; l < kLanes; ++l) {
        list.x[list.count + l] = list.x[0], list.y[list.count + l] = list.y[0], list.z[list.count + l] = list.z[0];
    }
    float reach[kDirections], reached[kDirections];
    uint32_t at[kDirections];
    for (uint32_t d = 0; d < kDirections; ++d) {
        at[d] = farthest(list, directions.way[d], reach[d]);
        reached[d] = reach[d] - 1e30f;
    }
    Vec3 chosen[kMostHullPoints];
    uint32_t count = 0;
    while (count < kMostHullPoints) {
        uint32_t worst = 0;
        for (uint32_t d = 1; d < kDirections; ++d)
            if (reach[d] - reached[d] > reach[worst] - reached[worst]) worst = d;
        if (!(reach[worst] - reached[worst] > enough)) break;
        const Vec3 p = chosen[count++] = list.point(at[worst]);
        for (uint32_t d = 0; d < kDirections; ++d) reached[d] = std::max(reached[d], dot(directions.way[d], p));
        reached[worst] = reach[worst];
    }
    list.count = 0;
    for (uint32_t i = 0; i < count; ++i) list.add(chosen[i]);
}

struct Triangle {
    Vec3 p[3];
};

Triangle outer_triangle(const ShellView& shell, uint32_t element) {
    const auto c = shell.state.elements.corner[shell.element(element)];
    const Vertices& v = shell.state.vertices;
    return {{v.rest[shell.vertex(c[0])], v.rest[shell.vertex(c[1])], v.rest[shell.vertex(c[2])]}};
}

uint32_t next_of(const ShellView& shell, uint32_t element) {
    return shell.state.elements.next_in_cell[shell.element(element)];
}

/// Normal by area, longest way from the middle, and what is square to both; of a list of elements.
Frame cell_frame(const ShellView& shell, uint32_t first) {
    Vec3 n, middle;
    uint32_t count = 0;
    for (uint32_t e = first; e != kNone; e = next_of(shell, e), ++count) {
        const auto [p] = outer_triangle(shell, e);
        n += cross(p[1] - p[0], p[2] - p[0]);
        middle += p[0] + p[1] + p[2];
    }
    middle = (1.0f / (3.0f * static_cast<float>(count))) * middle;
    n = normalised(n);
    if (!(dot(n, n) > 0)) n = {0, 1, 0};  // closed or folded: no normal of its own
    Vec3 longest;
    for (uint32_t e = first; e != kNone; e = next_of(shell, e)) {
        const Vec3 way = outer_triangle(shell, e).p[0] - middle;
        const Vec3 flat = way - dot(way, n) * n;
        if (dot(flat, flat) > dot(longest, longest)) longest = flat;
    }
    Vec3 x = normalised(longest);
    if (!(dot(x, x) > 0)) x = normalised(std::fabs(n.x) < 0.7f ? cross(n, {1, 0, 0}) : cross(n, {0, 1, 0}));
    return {x, cross(n, x), n};
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

/// Of the list's elements from `first` on, up to `last`.
void gather_vertices(const ShellView& shell, uint32_t first, uint32_t last, CellVertices& found) {
    const Elements& elements = shell.state.elements;
    found.clear();
    for (uint32_t e = first; e != last; e = next_of(shell, e)) {
        const uint32_t row = shell.element(e);
        const auto& corner = elements.corner[row];
        uint32_t number[3];
        for (int k = 0; k < 3; ++k) number[k] = found.number_of(corner[k]);
        for (int k = 0; k < 3; ++k) {
            if (elements.neighbour[row][k] != kNone) continue;
            const auto [p] = outer_triangle(shell, e);
            const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
            const Vec3 in = normalised(cross(normal, p[(k + 1) % 3] - p[k]));
            found.way_in[number[k]] += in;
            found.way_in[number[(k + 1) % 3]] += in;
        }
    }
}

void add_candidates(const ShellView& shell, const CellVertices& found, float margin, Candidates& list) {
    const Vertices& vertices = shell.state.vertices;
    for (uint32_t i = 0; i < found.count; ++i) {
        const uint32_t row = shell.vertex(found.vertex[i]);
        const float pull = std::min(margin, 0.5f * vertices.depth[row]);
        const Vec3 p = vertices.rest[row] + margin * normalised(found.way_in[i]), m = vertices.inward[row];
        list.add(p + pull * m);
        list.add(p + (vertices.depth[row] - pull) * m);
    }
}

struct Workspace {
    CellVertices vertices;
    Candidates list;
};

/// Of the list of elements that begins with `first`; no points for an empty one.
void choose_points(const ShellView& shell, uint32_t first, float margin, Workspace& work) {
    work.list.count = 0;
    if (first == kNone) return;
    const Directions directions(cell_frame(shell, first));
    while (first != kNone) {
        uint32_t end = first;
        for (uint32_t n = 0; n < kBatchElements && end != kNone; ++n) end = next_of(shell, end);
        gather_vertices(shell, first, end, work.vertices);
        add_candidates(shell, work.vertices, margin, work.list);
        keep_extremes(work.list, directions, kGoodEnough * margin);
        first = end;
    }
}

uint32_t cell_row(const ShellView& shell, uint32_t cell) {
    return shell.shells().cells[shell.row].first + cell;
}

// Until pack_hulls, the points of cell c stand from row 32 c of the shell's range on.
void write_points(const ShellView& shell, uint32_t cell, const Candidates& list) {
    const uint32_t first = kMostHullPoints * cell, to = shell.shells().points[shell.row].first + first;
    for (uint32_t i = 0; i < list.count; ++i) shell.state.hull_points.point.set(to + i, list.point(i));
    shell.state.cells.first_point[cell_row(shell, cell)] = first;
    shell.state.cells.point_count[cell_row(shell, cell)] = list.count;
}

void copy_points(const ShellView& shell, uint32_t cell, uint32_t first_row, uint32_t count) {
    const uint32_t first = kMostHullPoints * cell;
    HullPoints& table = shell.state.hull_points;
    table.copy_rows(table, first_row, shell.shells().points[shell.row].first + first, count);
    shell.state.cells.first_point[cell_row(shell, cell)] = first;
    shell.state.cells.point_count[cell_row(shell, cell)] = count;
}

void check_room(const ShellView& shell) {
    CULLET_ASSERT(shell.shells().points[shell.row].capacity >= kMostHullPoints * shell.shells().cells[shell.row].count,
                  "hull points of shell %u do not fit", shell.row.index);
}

/// Links the elements of each cell in rising order, and counts them: elements stand sorted by cell.
void link_sorted(const ShellView& shell) {
    Elements& elements = shell.state.elements;
    Cells& cells = shell.state.cells;
    const uint32_t count = shell.element_count();
    uint32_t e = 0;
    for (uint32_t c = 0; c < shell.shells().cells[shell.row].count; ++c) {
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
}

/// The same of live elements in any order.
void link_live(const ShellView& shell) {
    Elements& elements = shell.state.elements;
    Cells& cells = shell.state.cells;
    for (uint32_t c = 0; c < shell.shells().cells[shell.row].count; ++c) {
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

float hull_margin(const ShellView& shell) {
    return std::min(0.2f * shell.shells().thickness[shell.row], 0.001f);
}

void choose_hull(ShellView shell, uint32_t cell) {
    Workspace work;
    choose_points(shell, shell.state.cells.first_element[cell_row(shell, cell)], hull_margin(shell), work);
    write_points(shell, cell, work.list);
}

void pack_hulls(ShellView shell) {
    Cells& cells = shell.state.cells;
    Range& points = shell.shells().points[shell.row];
    points.count = 0;
    for (uint32_t c = 0; c < shell.shells().cells[shell.row].count; ++c) {
        const uint32_t row = cell_row(shell, c), count = cells.point_count[row];
        shell.state.hull_points.copy_rows(shell.state.hull_points, points.first + cells.first_point[row],
                                          points.first + points.count, count);
        cells.first_point[row] = points.count;
        points.count += count;
    }
}

void build_hulls(ShellView shell) {
    link_sorted(shell);
    check_room(shell);
    for (uint32_t c = 0; c < shell.shells().cells[shell.row].count; ++c) choose_hull(shell, c);
    pack_hulls(shell);
}

void copy_piece_hulls(ShellView piece, ShellView parent, float parents_margin) {
    Cells& cells = piece.state.cells;
    link_sorted(piece);
    check_room(piece);
    const bool may_copy = std::fabs(hull_margin(piece) - parents_margin) <= 0.05f * parents_margin;
    const uint32_t parent_points = parent.shells().points[parent.row].first;
    for (uint32_t c = 0; c < piece.shells().cells[piece.row].count; ++c) {
        uint32_t& same = cells.same_cell[cell_row(piece, c)];
        if (!may_copy) same = kNone;
        if (same == kNone) continue;
        const uint32_t from = cell_row(parent, same);
        copy_points(piece, c, parent_points + cells.first_point[from], cells.point_count[from]);
    }
}

void find_changed_cells(ShellView shell, ShellView before) {
    const Elements& elements = shell.state.elements;
    Cells& cells = shell.state.cells;
    for (uint32_t c = 0; c < shell.shells().cells[shell.row].count; ++c)
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
        if (!is_same) cells.is_changed[cell_row(shell, elements.cell[now])] = 1;
    }
}

void copy_rest_hulls(ShellView shell, Range points, ShellView before) {
    Cells& cells = shell.state.cells;
    const uint32_t count = shell.shells().cells[shell.row].count;
    for (uint32_t c = 0; c < count; ++c) {  // before counts are changed where `before` is the same shell
        const uint32_t row = cell_row(shell, c), then = cell_row(before, c);
        cells.list_count[row] = cells.element_count[row];
        cells.first_point[row] = cells.first_point[then];
        cells.point_count[row] = cells.point_count[then];
    }
    link_live(shell);
    check_room(shell);
    for (uint32_t c = 0; c < count; ++c) {
        const uint32_t row = cell_row(shell, c);
        const bool is_same = !cells.is_changed[row] && cells.element_count[row] == cells.list_count[row];
        cells.same_cell[row] = is_same ? c : kNone;
        if (is_same)
            copy_points(shell, c, points.first + cells.first_point[row], cells.point_count[row]);
        else
            cells.is_stale[row] = 0;
    }
}

}  // namespace cullet
