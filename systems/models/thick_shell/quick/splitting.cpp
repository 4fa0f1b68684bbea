#include "systems/models/thick_shell/quick/splitting.hpp"

#include <algorithm>

#include "systems/models/thick_shell/hidden/heading.hpp"
#include "systems/models/thick_shell/quick/plane_split.hpp"
#include "systems/models/thick_shell/quick/put_vertex.hpp"
#include "systems/models/thick_shell/shared/cut_out.hpp"
#include "systems/models/thick_shell/shared/cut_rows.hpp"
#include "systems/models/thick_shell/springs/rebuild_springs.hpp"
#include "systems/structures/shell/elements_at.hpp"

namespace cullet {
namespace {

/// The copies that a cut at `vertex` made are in the region as what they are copies of.
void add_copies(const Splitting& s, uint32_t vertex, const Ends& ends, uint32_t first_copy) {
    for (uint32_t c = first_copy; c < s.shell().vertex_count(); ++c) {
        uint32_t origin = vertex;
        for (uint32_t i = 0; i < ends.count; ++i)
            if (s.rest(ends.end[i]) == s.rest(c)) origin = ends.end[i];
        const bool is_awake = s.region.is_awake(origin);
        if (!is_awake && !s.region.is_held(origin)) continue;
        s.region.add(c, !is_awake);
        const SpringView& view = s.region.springs;
        if (view.has_layers()) s.state().twins.copy_rows(s.state().twins, view.twin(origin), view.twin(c), 1);
    }
}

/// Ends that were interior are tips now.
void mark_tips(const Splitting& s, uint32_t vertex, const Ends& ends, uint32_t root) {
    Vertices& vertices = s.state().vertices;
    Ring ring;
    for (uint32_t i = 0; i < ends.count; ++i) {
        if (!ends.is_interior[i]) continue;
        const uint32_t row = s.row(ends.end[i]);
        walk_ring(s.shell(), ends.end[i], ring);
        vertices.crack[row] = static_cast<uint8_t>(CrackState::Tip);
        vertices.crack_start[row] = root;
        vertices.heading.set(row, into_plane(s.rest(ends.end[i]) - s.rest(vertex), ring_normal(s.shell(), ring)));
    }
}

}  // namespace

void flush(Splitting& s) {
    if (is_cut_out(s.state(), s.region.task)) mark_touched(s.shell(), s.touched);
    uint32_t list[VertexList::kMost], count = 0;
    for (const uint32_t v : s.touched.weighed.span())
        if (s.region.is_awake(v) || s.region.is_held(v)) list[count++] = v;
    s.is_full = s.is_full || s.touched.weighed.has_overflowed;
    s.touched.clear();
    if (count == 0) return;
    std::sort(list, list + count);
    if (s.are_springs_old) return;
    s.are_springs_old = !rebuild_springs(s.region.springs, {list, count});
    s.is_full = s.is_full || s.are_springs_old;
    if (!s.are_springs_old) limit_springs(s.region, {list, count});
}

Split split_along(Splitting& s, uint32_t vertex, Vec3 normal, uint32_t root) {
    const ShellView& shell = s.shell();
    Split split;
    for (;;) {
        const PlaneCrossing crossing = find_plane_crossing(shell, vertex, normal);
        s.is_full = s.is_full || crossing.is_full;
        if (crossing.element == kNone) break;
        put_vertex(s.region, crossing.element, crossing.edge, crossing.tau, s.touched);
    }
    Ring ring;
    walk_ring(shell, vertex, ring);
    if (ring.count < 2) return split;
    const RingSides sides = choose_sides(shell, vertex, ring, normal);
    if (!sides.is_split) return split;
    split.ends = ends_between(shell, ring, sides);
    const uint32_t first_copy = shell.vertex_count();
    const CutOutcome outcome = cut_ends(shell, vertex, split.ends, s.touched);
    s.is_full = s.is_full || outcome == CutOutcome::Full;
    if (outcome != CutOutcome::Cut) return split;
    add_copies(s, vertex, split.ends, first_copy);
    s.cut_edges += split.ends.count;
    split.is_cut = true;
    mark_tips(s, vertex, split.ends, root);
    return split;
}

void close_neighbours(const Splitting& s, uint32_t vertex, const Ends& ends, uint32_t first_copy) {
    Vertices& vertices = s.state().vertices;
    const auto is_end = [&](uint32_t v) {
        for (uint32_t i = 0; i < ends.count; ++i)
            if (ends.end[i] == v) return true;
        return false;
    };
    const auto close = [&](uint32_t v) {
        Ring ring;
        walk_ring(s.shell(), v, ring);
        for (uint32_t i = 0; i < ring.count; ++i)
            for (const uint32_t n : s.state().elements.corner[s.shell().element(ring.element[i])])
                if (!is_end(n)) vertices.is_start_banned[s.row(n)] = 1;
    };
    close(vertex);
    for (uint32_t c = first_copy; c < s.shell().vertex_count(); ++c)
        if (s.rest(c) == s.rest(vertex)) close(c);
}

}  // namespace cullet
