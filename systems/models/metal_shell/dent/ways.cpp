#include "systems/models/metal_shell/dent/ways.hpp"

namespace cullet {

// A ring of vertices whose way became shorter. What it holds in the end does not hang on the order.
void spread_ways(const MetalView& metal, float limit) {
    MetalVertices& vertices = metal.vertices();
    const MetalSprings& springs = metal.springs();
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
            const float way = vertices.way[first + v] + springs.length[spring];
            if (!(way <= limit) || !(way < vertices.way[first + other])) return;
            vertices.way[first + other] = way;
            push(other);
        });
    }
}

}  // namespace cullet
