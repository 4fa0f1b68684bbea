// Splits along planes as the quick mode makes them, for tests.
#pragma once
#include "engine/random.hpp"
#include "systems/models/thick_shell/quick/plane_split.hpp"
#include "systems/structures/shell/insert_vertex.hpp"
#include "systems/structures/shell/split_fans.hpp"
#include "tests/support/crack_meshes.hpp"

namespace cullet::crack_test {

/// The n-th unit direction of a seed.
inline Vec3 seeded_direction(uint64_t seed, uint64_t n) {
    const Random random{seed};
    for (uint64_t i = 0;; ++i) {
        const Vec3 v{static_cast<float>(2 * random.uniform(n, 3 * i) - 1),
                     static_cast<float>(2 * random.uniform(n, 3 * i + 1) - 1),
                     static_cast<float>(2 * random.uniform(n, 3 * i + 2) - 1)};
        if (dot(v, v) > 0.01f && dot(v, v) < 1) return normalised(v);
    }
}

/// What one split did.
struct SplitResult {
    bool is_cut = false, was_interior = false;
    uint32_t on_border = 0, ends = 0, inserted = 0;
};

/// Re-meshes and splits, as the quick mode does; `after_insert` is called between the two.
template <class Call>
SplitResult split(ShellView shell, uint32_t vertex, Vec3 normal, Touched& touched, Call after_insert) {
    SplitResult result;
    for (;;) {
        const PlaneCrossing crossing = find_plane_crossing(shell, vertex, normal);
        if (crossing.element == kNone) break;
        insert_vertex(shell, crossing.element, crossing.edge, crossing.tau, touched);
        ++result.inserted;
        touched.clear();
    }
    after_insert();
    Ring ring;
    walk_ring(shell, vertex, ring);
    result.was_interior = ring.is_closed;
    if (ring.count < 2) return result;
    const RingSides sides = choose_sides(shell, vertex, ring, normal);
    if (!sides.is_split) return result;
    Ends ends = ends_between(shell, ring, sides);
    result.is_cut = cut_ends(shell, vertex, ends, touched) == CutOutcome::Cut;
    touched.clear();
    result.ends = ends.count;
    for (uint32_t i = 0; i < ends.count; ++i) {
        result.on_border += !ends.is_interior[i];
        if (result.is_cut && ends.is_interior[i])
            shell.state.vertices.crack[shell.vertex(ends.end[i])] = static_cast<uint8_t>(CrackState::Tip);
    }
    return result;
}

}  // namespace cullet::crack_test
