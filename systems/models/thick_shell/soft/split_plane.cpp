#include "systems/models/thick_shell/soft/split_plane.hpp"

#include "systems/models/thick_shell/stiffness/refresh.hpp"
#include "systems/structures/shell/cut_edge.hpp"
#include "systems/structures/shell/split_fans.hpp"

namespace cullet {
namespace {

/// By which sums of signed areas tell how much of a run lies on the wrong side.
struct Sides {
    uint32_t count = 0;
    float positive[kMostRing + 1];  // areas on the positive side before element i
    float negative[kMostRing + 1];
};

Sides sides_of(const SpringView& view, const Ring& ring, uint32_t vertex, Vec3 normal) {
    const ShellRows& s = view.state;
    const Vec3 at = view.position(vertex);
    Sides sides;
    sides.count = ring.count;
    sides.positive[0] = sides.negative[0] = 0;
    for (uint32_t i = 0; i < ring.count; ++i) {
        const auto& corner = s.elements.corner[view.shell.element(ring.element[i])];
        const Vec3 p[3] = {view.position(corner[0]), view.position(corner[1]), view.position(corner[2])};
        const float area = 0.5f * length(cross(p[1] - p[0], p[2] - p[0]));
        const bool is_above = dot(normal, (1 / 3.0f) * (p[0] + p[1] + p[2]) - at) >= 0;
        sides.positive[i + 1] = sides.positive[i] + (is_above ? area : 0);
        sides.negative[i + 1] = sides.negative[i] + (is_above ? 0 : area);
    }
    return sides;
}

/// Elements [from, to) on one side, the others on the other: area on the wrong one, whichever is which.
float wrong_area(const Sides& sides, uint32_t from, uint32_t to) {
    const float p = sides.positive[to] - sides.positive[from], n = sides.negative[to] - sides.negative[from];
    const float all_p = sides.positive[sides.count], all_n = sides.negative[sides.count];
    const float in_above = n + (all_p - p), in_below = p + (all_n - n);
    return in_above < in_below ? in_above : in_below;
}

struct Run {
    uint32_t from = 0, to = 0;  // of the ring
};

// Of a cycle [from, to) with 0 < length < count; of a chain [0, to). First of equals.
bool best_run(const Ring& ring, const Sides& sides, Run& best) {
    if (ring.count < 2) return false;
    float least = 1e30f;
    for (uint32_t from = 0; from < (ring.is_closed ? ring.count : 1u); ++from)
        for (uint32_t to = from + 1; to < ring.count + (from > 0 ? 1 : 0); ++to) {
            const float wrong = wrong_area(sides, from, to);
            if (!(wrong < least)) continue;
            least = wrong;
            best = {from, to};
        }
    return least < 1e30f;
}

}  // namespace

PlaneSplit split_plane(const SpringView& view, uint32_t vertex, Vec3 normal) {
    PlaneSplit split;
    const ShellView& shell = view.shell;
    ShellRows& s = view.state;
    Ring ring;
    walk_ring(shell, vertex, ring);
    Run run;
    if (!best_run(ring, sides_of(view, ring, vertex, normal), run)) return split;
    if (shell.vertex_count() + 3 > shell.vertices().capacity) return split;
    // The edge before element i of the ring: from the vertex to `end`.
    struct Cut {
        uint32_t element, edge, end;
        Ring ring;
        bool was_open;
    };
    Cut cuts[2];
    uint32_t cut_count = 0;
    const auto add_cut = [&](uint32_t i) {
        const uint32_t before = (i + ring.count - 1) % ring.count, element = ring.element[before];
        const uint32_t edge = (ring.corner[before] + 2u) % 3;
        Cut& cut = cuts[cut_count++];
        cut.element = element;
        cut.edge = edge;
        cut.end = s.elements.corner[shell.element(element)][edge];
        walk_ring(shell, cut.end, cut.ring);
        cut.was_open = !cut.ring.is_closed;
    };
    if (ring.is_closed) add_cut(run.from);
    add_cut(run.to % ring.count);
    const uint32_t count = shell.vertex_count();
    for (uint32_t k = 0; k < cut_count; ++k)
        if (cut_edge(shell, cuts[k].element, cuts[k].edge)) split.is_done = true;
    if (!split.is_done) return split;
    Touched rows(kStiffnessRepair);
    split_fans(shell, vertex, ring, rows);
    const auto touch = [&](uint32_t v) { split.touched[split.touched_count++] = v; };
    touch(vertex);
    s.vertices.crack[shell.vertex(vertex)] = static_cast<uint8_t>(CrackState::Cracked);
    for (uint32_t k = 0; k < cut_count; ++k) {
        const uint32_t row = shell.vertex(cuts[k].end);
        touch(cuts[k].end);
        if (!cuts[k].was_open) {
            s.vertices.crack[row] = static_cast<uint8_t>(CrackState::Tip);
            continue;
        }
        s.vertices.crack[row] = static_cast<uint8_t>(CrackState::Cracked);
        // The ring was walked before the vertex at its other end was split; elements and corners are the same.
        if (count_fans(shell, cuts[k].ring) > 1) split_fans(shell, cuts[k].end, cuts[k].ring, rows);
        split.has_closed = true;
    }
    for (uint32_t v = count; v < shell.vertex_count(); ++v) {
        s.vertices.crack[shell.vertex(v)] = static_cast<uint8_t>(CrackState::Cracked);
        touch(v);
    }
    shell.structures().has_cracks[shell.structure] = 1;
    return split;
}

}  // namespace cullet
