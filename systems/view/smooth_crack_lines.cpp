#include "systems/view/smooth_crack_lines.hpp"

#include <algorithm>
#include <span>

#include "systems/fragments/prism.hpp"

namespace cullet {
namespace {

constexpr double kLeastVolume = 0.2;  // of each tetrahedron, after the move
constexpr int kMostRounds = 8;

Vec3 rest(const ShellView& shell, uint32_t vertex) {
    return shell.state.vertices.rest[shell.vertex(vertex)];
}

/// Rows of vertices between two crack edges, in the copy column of the shell's first rows, in no particular order.
/// Where a rim ends the line its neighbour stays kNone.
uint32_t list_crack_vertices(const ShellView& shell) {
    Vertices& vertices = shell.state.vertices;
    const Elements& elements = shell.state.elements;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v)
        vertices.border_next[shell.vertex(v)] = vertices.border_previous[shell.vertex(v)] = kNone;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        if (elements.flags[row] & kDead) continue;
        for (int k = 0; k < 3; ++k) {
            if (elements.edge_kind[row][k] != static_cast<uint8_t>(EdgeKind::Crack)) continue;
            const uint32_t a = elements.corner[row][k], b = elements.corner[row][(k + 1) % 3];
            vertices.border_next[shell.vertex(a)] = b;
            vertices.border_previous[shell.vertex(b)] = a;
        }
    }
    uint32_t* list = vertices.copy.data() + shell.vertices().first;
    uint32_t count = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v);
        const bool has_next = vertices.border_next[row] != kNone, has_previous = vertices.border_previous[row] != kNone;
        if (has_next && has_previous) list[count++] = v;
        // Where an edge at a crack was split, the new vertex may have inherited a shift.
        if (!has_next && !has_previous) vertices.drawn_shift.set(row, {});
    }
    return count;
}

bool is_before(const ShellView& shell, uint32_t v, uint32_t w) {
    const Vec3 p = rest(shell, v), q = rest(shell, w);
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    if (p.z != q.z) return p.z < q.z;
    return v < w;
}

bool is_one_line(const ShellView& shell, uint32_t v, uint32_t w) {
    const Vertices& vertices = shell.state.vertices;
    const auto next = [&](uint32_t x) { return rest(shell, vertices.border_next[shell.vertex(x)]); };
    const auto previous = [&](uint32_t x) { return rest(shell, vertices.border_previous[shell.vertex(x)]); };
    return next(v) == previous(w) && previous(v) == next(w) && !(next(v) == previous(v));
}

/// Keeps the two sides of each simple line place beside each other; returns how many vertices are left.
uint32_t keep_pairs(const ShellView& shell, std::span<uint32_t> list) {
    std::sort(list.begin(), list.end(), [&](uint32_t v, uint32_t w) { return is_before(shell, v, w); });
    uint32_t kept = 0;
    for (size_t i = 0; i < list.size();) {
        size_t end = i + 1;
        while (end < list.size() && rest(shell, list[end]) == rest(shell, list[i])) ++end;
        if (end - i == 2 && is_one_line(shell, list[i], list[i + 1])) {
            const uint32_t v = list[i], w = list[i + 1];
            list[kept++] = v;
            list[kept++] = w;
        }
        i = end;
    }
    return kept;
}

void shift_pair(const ShellView& shell, uint32_t v, uint32_t w) {
    Vertices& vertices = shell.state.vertices;
    const uint32_t row = shell.vertex(v);
    const Vec3 p = rest(shell, vertices.border_previous[row]), n = rest(shell, vertices.border_next[row]);
    const Vec3 move = 0.25f * (p + n) - 0.5f * rest(shell, v);
    const Vec3 m = vertices.inward[row];
    const Vec3 shift = move - dot(move, m) * m;
    vertices.drawn_shift.set(row, shift);
    vertices.drawn_shift.set(shell.vertex(w), shift);
}

bool is_squeezed(const ShellView& shell, uint32_t element) {
    double before[3], after[3];
    int i = 0, j = 0;
    for_each_tetrahedron(load_prism(shell, element),
                         [&](Vec3d, Vec3d, Vec3d, Vec3d, double volume) { before[i++] = volume; });
    for_each_tetrahedron(load_prism(shell, element, Surface::Drawn),
                         [&](Vec3d, Vec3d, Vec3d, Vec3d, double volume) { after[j++] = volume; });
    for (int k = 0; k < 3; ++k)
        if (after[k] < kLeastVolume * before[k]) return true;
    return false;
}

/// Takes back the moves of squeezed elements, both sides together. True when there were any.
bool take_back_squeezing(const ShellView& shell, std::span<const uint32_t> pairs, bool takes_all) {
    Vertices& vertices = shell.state.vertices;
    bool is_any = false;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        const uint32_t row = shell.element(e);
        if ((shell.state.elements.flags[row] & kDead) || !is_squeezed(shell, e)) continue;
        is_any = true;
        for (uint32_t v : shell.state.elements.corner[row]) vertices.border_next[shell.vertex(v)] = kNone;
    }
    if (!is_any) return false;
    for (size_t i = 0; i < pairs.size(); i += 2) {
        const uint32_t v = shell.vertex(pairs[i]), w = shell.vertex(pairs[i + 1]);
        const bool is_bad = vertices.border_next[v] == kNone || vertices.border_next[w] == kNone;
        if (!is_bad && !takes_all) continue;
        vertices.drawn_shift.set(v, {});
        vertices.drawn_shift.set(w, {});
    }
    return true;
}

}  // namespace

uint32_t smooth_crack_lines(ShellView shell) {
    const uint32_t crack_count = list_crack_vertices(shell);
    const std::span<uint32_t> list(shell.state.vertices.copy.data() + shell.vertices().first, crack_count);
    const std::span<const uint32_t> pairs = list.first(keep_pairs(shell, list));
    for (size_t i = 0; i < pairs.size(); i += 2) shift_pair(shell, pairs[i], pairs[i + 1]);
    int round = 0;
    while (!pairs.empty() && round < kMostRounds && take_back_squeezing(shell, pairs, round == kMostRounds - 1))
        ++round;
    uint32_t moved = 0;
    for (uint32_t v : pairs) moved += !(shell.state.vertices.drawn_shift[shell.vertex(v)] == Vec3{});
    return moved;
}

}  // namespace cullet
