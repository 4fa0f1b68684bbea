#include "systems/structures/shell/rest_of_body.hpp"

#include <algorithm>

#include "systems/structures/shell/cell_hulls.hpp"
#include "systems/structures/shell/mass_properties.hpp"
#include "systems/structures/shell/vertex_sums.hpp"

namespace cullet {

// Kernels go on over dead rows: a vertex without inverse mass stays where it is, at zero.
void shed_part(ShellView shell, const FragmentPart& part) {
    Elements& elements = shell.state.elements;
    Vertices& vertices = shell.state.vertices;
    Hinges& hinges = shell.state.hinges;
    for (uint32_t e = part.first_element; e != kNone; e = elements.next[shell.element(e)]) {
        const uint32_t row = shell.element(e);
        elements.flags[row] = static_cast<uint8_t>(elements.flags[row] | kDead);
        elements.part[row] = kNone;
        for (int k = 0; k < 3; ++k) {
            const uint32_t v = shell.vertex(elements.corner[row][k]), h = elements.hinge[row][k];
            vertices.element[v] = kNone;
            vertices.mass[v] = 0;
            vertices.inverse_mass[v] = 0;
            vertices.is_pinned[v] = 0;
            vertices.crack[v] = static_cast<uint8_t>(CrackState::None);
            vertices.crack_start[v] = kNone;
            if (h != kNone) hinges.vertex[shell.hinge(h)] = {kNone, kNone, kNone, kNone};
        }
    }
}

void clear_run(ShellView shell, bool is_whole, bool has_run, bool has_waiting) {
    Vertices& vertices = shell.state.vertices;
    uint8_t has_cracks = 0;
    for (uint32_t v = 0; v < shell.vertex_count(); ++v) {
        const uint32_t row = shell.vertex(v), start = vertices.crack_start[row];
        if (start != kNone && (start >= shell.vertex_count() || vertices.element[shell.vertex(start)] == kNone))
            vertices.crack_start[row] = kNone;
        const bool counts = is_whole || vertices.crack[row] == static_cast<uint8_t>(CrackState::Tip);
        has_cracks |= counts && vertices.crack[row] != 0;
        if (!has_run) continue;
        if (!has_waiting) vertices.velocity.set(row, {});
        vertices.ready_time[row] = 0;
        vertices.is_start_banned[row] = 0;
        vertices.displacement.set(row, {});
        for (int side : {0, 1}) vertices.probe.set(row, {}, side);
    }
    shell.structures().has_cracks[shell.structure] = has_cracks;
    stop_blocks(shell);
}

void stop_blocks(ShellView shell) {
    Vertices& vertices = shell.state.vertices;
    uint8_t* const moves = shell.state.vertex_blocks.moves.data() + block_row(shell, 0);
    for (uint32_t b = 0; b < block_count(shell); ++b) {
        if (!moves[b]) continue;
        moves[b] = 0;
        const uint32_t begin = b * kVerticesPerBlock, end = std::min(begin + kVerticesPerBlock, shell.vertex_count());
        for (uint32_t v = begin; v < end; ++v) vertices.velocity.set(shell.vertex(v), {});
    }
}

void measure_part(ShellView shell, const FragmentPart& part) {
    ShellSums sums;
    for (uint32_t e = part.first_element; e != kNone; e = shell.state.elements.next[shell.element(e)])
        sums = sums + element_sums(shell, e);
    write_sums(shell, sums);
}

void adopt_shell(BodyRows& state, MetalTables metal, Row<Bodies> body, Row<Structures> shell) {
    const Row<Structures> before = state.bodies.structure[body];
    if (before == shell) return;
    ++state.structures.users[shell];
    state.bodies.structure[body] = shell;
    release_metal_shell({state, metal}, before);
    drop_stiffness(state, shell);
    const ShellView own(state, shell);
    if (own.vertex_count() > kWholeCopyVertices) keep_vertex_sums(own);
}

bool keep_hulls(ShellView shell, ShellView before) {
    ShellRows& state = shell.state;
    if (shell.row == before.row) return true;
    const Range points = before.points(), cells = shell.cells();
    Range& own = shell.points();
    const Range old = own;
    if (!state.hull_points.take(points.count, own)) {
        own = old;
        return false;
    }
    state.hull_points.pool.give_back(old.first, old.capacity);
    const uint32_t then = before.cells().first;
    for (uint32_t c = 0; c < cells.count; ++c) {
        state.cells.first_point[cells.first + c] = state.cells.first_point[then + c];
        state.cells.point_count[cells.first + c] = state.cells.point_count[then + c];
        state.cells.part_points[cells.first + c] = state.cells.part_points[then + c];
        state.cells.is_stale[cells.first + c] = state.cells.is_changed[cells.first + c] & kCracked;
    }
    own.count = points.count;
    state.hull_points.copy_rows(state.hull_points, points.first, own.first, points.count);
    return true;
}

}  // namespace cullet
