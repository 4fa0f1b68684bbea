#include "systems/structures/shell/metal_piece.hpp"

#include <algorithm>
#include <array>

namespace cullet {
namespace {

/// The rows of both, and which number a sub-shell of the broken shell has in the piece; kNone: it has nothing of it.
struct Copying {
    MetalShellRows rows;
    ShellView from, to;
    Row<MetalShells> source, own;
    std::array<uint16_t, kMostSubShells> number;
    uint32_t live;  // vertices of the piece, which stand in their old order

    Copying(MetalShellRows r, Row<Structures> broken, Row<Structures> piece, uint32_t count)
        : rows(r), from(r, broken), to(r, piece), source(metal_of(r, broken)), own(metal_of(r, piece)), live(count) {
        number.fill(kNoMover);
    }
    MetalShells& shells() const { return rows.metal_shells; }
    /// Which vertex of the piece this one of the broken shell is; kNone: another part's.
    uint32_t in_piece(uint32_t vertex) const {
        const uint32_t* const was = rows.shell_rows.vertices.copy.data() + to.vertices().first;
        const uint32_t* const at = std::lower_bound(was, was + live, vertex);
        return at < was + live && *at == vertex ? static_cast<uint32_t>(at - was) : kNone;
    }
};

template <class Visit>
void for_each_element(const ShellView& shell, uint32_t first, Visit visit) {
    for (uint32_t e = first; e != kNone; e = shell.state.elements.next[shell.element(e)]) visit(e);
}

void copy_values(const Copying& c) {
    MetalShells& s = c.shells();
    s.mean_edge[c.own] = s.mean_edge[c.source];
    const auto& generation = c.rows.structures.generation;
    const bool is_whole = generation[c.to.structure] == generation[c.from.structure];
    s.crush_pressure[c.own] = is_whole ? s.crush_pressure[c.source] : 0;  // what came off is an open sheet
    s.published[c.own] = s.published[c.source];
    s.impulse_time[c.own] = s.impulse_time[c.source];
    s.tear_strain[c.own] = s.tear_strain[c.source];
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    const Range vertices = s.vertices[c.own];
    for (uint32_t v = vertices.first; v < vertices.first + c.live; ++v) {
        const Vec3 p = c.rows.metal_vertices.original[v];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    s.half_diagonal[c.own] = std::min(s.half_diagonal[c.source], 0.5f * length(high - low));
}

void copy_elements(Copying& c, uint32_t first_element) {
    const Range given = c.shells().elements[c.source];
    Range& own = c.shells().elements[c.own];
    own.count = c.to.element_count();
    auto& cell = c.rows.metal_elements.cell;
    uint16_t count = 0;
    for_each_element(c.from, first_element, [&](uint32_t e) {
        uint16_t& number = c.number[cell[given.first + e]];
        if (number == kNoMover) number = count++;
        cell[own.first + c.rows.shell_rows.elements.copy[c.from.element(e)]] = number;
    });
    c.shells().cells[c.own].count = count;
}

void copy_cells(const Copying& c) {
    const Range given = c.shells().cells[c.source], own = c.shells().cells[c.own];
    const Range given_borders = c.shells().borders[c.source];
    Range& borders = c.shells().borders[c.own];
    SubShells& cells = c.rows.sub_shells;
    SubShellBorders& border = c.rows.sub_shell_borders;
    borders.count = 0;
    for (uint32_t k = 0; k < given.count; ++k) {
        if (c.number[k] == kNoMover) continue;
        const uint32_t from = given.first + k, to = own.first + c.number[k];
        cells.copy_rows(cells, from, to, 1);
        cells.representative[to] = 0, cells.element_count[to] = 0;
        cells.first_border[to] = borders.count;
        for (uint32_t b = cells.first_border[from]; b < cells.first_border[from] + cells.border_count[from]; ++b) {
            const uint16_t other = c.number[border.other[given_borders.first + b]];
            if (other == kNoMover || borders.count == borders.capacity) continue;
            const uint32_t row = borders.first + borders.count++;
            border.length[row] = border.length[given_borders.first + b];
            border.other[row] = other;
        }
        cells.border_count[to] = borders.count - cells.first_border[to];
    }
    const uint32_t first = c.shells().elements[c.own].first;
    for (uint32_t e = c.to.element_count(); e-- > 0;) {
        const uint32_t row = own.first + c.rows.metal_elements.cell[first + e];
        cells.representative[row] = e;
        ++cells.element_count[row];
    }
}

// What it was blended with and the piece has not is left to the rest.
void number_cells(const Copying& c, uint32_t row) {
    auto& cell = c.rows.metal_vertices.cell[row];
    auto& weight = c.rows.metal_vertices.weight[row];
    float sum = 0;
    for (uint32_t k = 0; k < kBlended; ++k) {
        const uint16_t number = c.number[cell[k]];
        if (number == kNoMover) weight[k] = 0;
        cell[k] = number == kNoMover ? uint16_t{0} : number;
        sum += weight[k];
    }
    for (float& w : weight) w = sum > 0 ? w / sum : 0;
    if (!(sum > 0)) weight[0] = 1;
}

void copy_springs_of(const Copying& c, uint32_t from, uint32_t to) {
    MetalVertices& own = c.rows.metal_vertices;
    MetalSprings& springs = c.rows.metal_springs;
    const uint32_t given = c.shells().springs[c.source].first + own.first_spring[from];
    Range& range = c.shells().springs[c.own];
    const uint32_t begin = range.count;
    for (uint32_t k = given; k < given + own.spring_count[from] && range.count < range.capacity; ++k) {
        const uint32_t number = c.in_piece(springs.other[k]);
        if (number == kNone) continue;
        springs.copy_rows(springs, k, range.first + range.count, 1);
        springs.other[range.first + range.count++] = number;
    }
    own.first_spring[to] = begin;
    own.spring_count[to] = static_cast<uint16_t>(range.count - begin);
}

void copy_vertices(const Copying& c) {
    const Range given = c.shells().vertices[c.source];
    Range& own = c.shells().vertices[c.own];
    MetalVertices& v = c.rows.metal_vertices;
    own.count = c.to.vertex_count();
    c.shells().springs[c.own].count = 0;
    for (uint32_t k = 0; k < own.count; ++k) {
        const uint32_t row = own.first + k;
        if (k >= c.live) {
            v.clear_rows(row, 1);
            continue;
        }
        const uint32_t was = c.rows.shell_rows.vertices.copy[c.to.vertex(k)];
        v.copy_rows(v, given.first + was, row, 1);
        number_cells(c, row);
        copy_springs_of(c, given.first + was, row);
    }
}

}  // namespace

bool reserve_metal(MetalTables rows, Row<Structures> broken, Row<Structures> piece, const MetalRoom& room,
                   const char** full) {
    if (!metal_of(rows, broken).exists()) return true;
    return make_metal(rows, piece, room, full).exists();
}

void fill_metal(MetalShellRows rows, Row<Structures> broken, Row<Structures> piece, const MetalPart& part) {
    if (!metal_of(rows, broken).exists() || !metal_of(rows, piece).exists()) return;
    Copying copying(rows, broken, piece, part.vertices);
    copy_elements(copying, part.first_element);
    copy_vertices(copying);
    copy_cells(copying);
    copy_values(copying);
}

}  // namespace cullet
