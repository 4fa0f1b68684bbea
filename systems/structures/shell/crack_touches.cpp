#include "systems/structures/shell/crack_touches.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

#include "systems/structures/shell/cell_elements.hpp"
#include "systems/structures/shell/prism.hpp"

namespace cullet {
namespace {

struct CrackEdge {
    uint64_t place;  // of both ends: equal where they are, and sorts in one comparison
    Vec3 low, high;  // rest positions of its ends, in the order of their coordinates
    uint32_t element, edge;
};

auto key(Vec3 p) {
    return std::tuple(p.x, p.y, p.z);
}

// Zeros of both signs are one place.
uint64_t place_of(Vec3 low, Vec3 high) {
    uint64_t hash = 0;
    for (const float x : {low.x, low.y, low.z, high.x, high.y, high.z})
        hash = (hash ^ std::bit_cast<uint32_t>(x + 0.0f)) * 0x9e3779b97f4a7c15ull, hash ^= hash >> 29;
    return hash;
}

/// Calls visit(element, edge) for each free edge of a live element that is a crack.
template <class Visit>
void for_each_crack_edge(const ShellView& shell, bool is_local, Visit visit) {
    const Elements& elements = shell.state.elements;
    const auto look = [&](uint32_t e) {
        const uint32_t row = shell.element(e);
        if (elements.flags[row] & kDead) return;
        for (uint32_t k = 0; k < 3; ++k)
            if (elements.neighbour[row][k] == kNone &&
                elements.edge_kind[row][k] == static_cast<uint8_t>(EdgeKind::Crack))
                visit(e, k);
    };
    const uint8_t* const is_stale = shell.state.cells.is_stale.data() + shell.cells().first;
    if (is_local)
        for_each_element_of_cells(
            shell, [&](uint32_t c) { return is_stale[c] != 0; }, look);
    else
        for (uint32_t e = 0; e < shell.element_count(); ++e) look(e);
}

// Outwards from the element of `edge` is depth x along: its corners run counter-clockwise seen from outside.
void write_touches(const ShellView& shell, const CrackEdge& edge, Row<Fragments> a, Row<Fragments> b, Touches& touches,
                   uint32_t row) {
    const auto& corner = shell.state.elements.corner[shell.element(edge.element)];
    const uint32_t from = shell.vertex(corner[edge.edge]), to = shell.vertex(corner[(edge.edge + 1) % 3]);
    const Vec3d outer_from(smoothed_place(shell.state, from)), outer_to(smoothed_place(shell.state, to));
    const Vec3d inner_from = smoothed_twin(shell.state, from), inner_to = smoothed_twin(shell.state, to);
    const Vec3d outer = 0.5 * (outer_from + outer_to), inner = 0.5 * (inner_from + inner_to);
    const Vec3d out_of_a = cross(inner - outer, outer_to - outer_from + inner_to - inner_from);
    const double size = length(out_of_a);
    const Vec3d normal = size > 0 ? (-1 / size) * out_of_a : Vec3d{};
    for (const Vec3d point : {outer_from, outer_to, inner_from, inner_to}) {
        touches.a[row] = a, touches.b[row] = b;
        touches.point.set(row, point), touches.normal.set(row, normal);
        touches.reach[row] = length(outer_to - outer_from);
        ++row;
    }
}

}  // namespace

Rows<Touches> crack_touches(ShellView shell, Row<Fragments> first, bool is_local, Touches& touches, Arena& arena) {
    uint32_t count = 0, wanted = 0;
    for_each_crack_edge(shell, is_local, [&](uint32_t, uint32_t) { ++count; });
    const auto edges = arena.take<CrackEdge>(count);
    if (edges.empty()) return {};
    count = 0;
    for_each_crack_edge(shell, is_local, [&](uint32_t e, uint32_t k) {
        const auto& corner = shell.state.elements.corner[shell.element(e)];
        Vec3 low = shell.state.vertices.rest[shell.vertex(corner[k])],
             high = shell.state.vertices.rest[shell.vertex(corner[(k + 1) % 3])];
        if (key(high) < key(low)) std::swap(low, high);
        edges[count++] = {place_of(low, high), low, high, e, k};
    });
    std::sort(edges.begin(), edges.end(), [](const CrackEdge& p, const CrackEdge& q) {
        if (p.place != q.place) return p.place < q.place;
        return std::tuple(key(p.low), key(p.high), p.element, p.edge) <
               std::tuple(key(q.low), key(q.high), q.element, q.edge);
    });
    const auto for_each_crack = [&](auto visit) {
        for (uint32_t i = 0, end = 0; i < count; i = end) {
            for (end = i + 1; end < count && edges[end].low == edges[i].low && edges[end].high == edges[i].high;) ++end;
            if (end - i != 2) continue;  // what lay beyond it is gone, or several sheets end on one line
            const uint32_t a = shell.state.elements.part[shell.element(edges[i].element)],
                           b = shell.state.elements.part[shell.element(edges[i + 1].element)];
            if (a != b) visit(edges[i], a, b);
        }
    };
    for_each_crack([&]([[maybe_unused]] const CrackEdge& edge, uint32_t, uint32_t) { wanted += 4; });
    const uint32_t made = touches.append(wanted);
    if (made == kNone) return {};
    uint32_t next = made;
    for_each_crack([&](const CrackEdge& edge, uint32_t a, uint32_t b) {
        write_touches(shell, edge, Row<Fragments>(first + a), Row<Fragments>(first + b), touches, next);
        next += 4;
    });
    return {made, wanted};
}

}  // namespace cullet
