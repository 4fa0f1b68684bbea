// Ways along a metal sheet, over its edges and the ties between sheets.
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"

namespace cullet {

inline constexpr float kNoWay = 1e30f;

/// Fills MetalVertices.way: what stands there before, or a neighbour's way and that from it, where both together are
/// shorter and at most `limit`. So with 0 where it begins and kNoWay elsewhere it is the shortest way from there.
/// between(vertex, other, row of the spring): the way from one to the next, 0 or more.
///
/// A ring of vertices whose way became shorter. What it holds in the end does not hang on the order.
template <class Between>
void spread_ways(const MetalView& metal, float limit, Between between) {
    MetalVertices& vertices = metal.vertices();
    const uint32_t count = metal.vertex_count(), first = metal.vertex(0);
    uint32_t begin = 0, queued = 0;
    const auto push = [&](uint32_t v) {
        if (vertices.is_queued[first + v]) return;
        vertices.is_queued[first + v] = 1;
        vertices.queued[first + (begin + queued++) % count] = v;
    };
    for (uint32_t v = 0; v < count; ++v) {
        vertices.is_queued[first + v] = 0;
        if (vertices.way[first + v] <= limit) push(v);
    }
    while (queued > 0) {
        const uint32_t v = vertices.queued[first + begin];
        begin = (begin + 1) % count, --queued;
        vertices.is_queued[first + v] = 0;
        metal.for_each_spring(v, [&](uint32_t other, uint32_t spring) {
            const float way = vertices.way[first + v] + between(v, other, spring);
            if (!(way <= limit) || !(way < vertices.way[first + other])) return;
            vertices.way[first + other] = way;
            push(other);
        });
    }
}

/// The same, in m along the original shape.
void spread_ways(const MetalView& metal, float limit);

}  // namespace cullet
