// Cracks that have not parted a body, as lines: edges of its crack faces along a wall whose other side is drawn with
// the same body lie between the same two places and run the other way. Edges of faces whose other side flew off have no
// partner, nor have those of an inner wall that touches the outer one at an end.
#include <algorithm>
#include <tuple>

#include "components/body_id.hpp"
#include "systems/api/checks.hpp"
#include "systems/world_contents.hpp"

namespace cullet {
namespace {

std::tuple<float, float, float> key(Vec3 p) {
    return {p.x, p.y, p.z};
}

/// The body's drawn mesh. An edge is named by the place of its first corner among the indices.
struct Drawn {
    const ViewVertex* vertex;
    const uint32_t* index;

    uint32_t from(uint32_t edge) const { return index[edge]; }
    uint32_t to(uint32_t edge) const { return index[edge % 3 == 2 ? edge - 2 : edge + 1]; }
    Vec3 place(uint32_t v) const { return vertex[v].position; }
    /// Whether it runs from the later place to the earlier one.
    bool is_back(uint32_t edge) const { return key(place(to(edge))) < key(place(from(edge))); }
    std::pair<Vec3, Vec3> places(uint32_t edge) const {
        const Vec3 p = place(from(edge)), q = place(to(edge));
        return is_back(edge) ? std::pair(q, p) : std::pair(p, q);
    }
    /// Both ends on one of the walls: a crack face's v is its depth, and the sides of its quads have one u.
    bool is_along_wall(uint32_t edge) const {
        const Vec2 a = vertex[from(edge)].uv, b = vertex[to(edge)].uv;
        return (a.y > 0) == (b.y > 0) && a.x != b.x;
    }
    bool comes_before(uint32_t a, uint32_t b) const {
        const auto [a_low, a_high] = places(a);
        const auto [b_low, b_high] = places(b);
        const auto left = std::tuple(key(a_low), key(a_high), is_back(a), a);
        return left < std::tuple(key(b_low), key(b_high), is_back(b), b);
    }
    bool are_alike(uint32_t a, uint32_t b) const { return places(a) == places(b); }
};

}  // namespace

// Works on the drawn mesh alone, in the caller's memory: first the edges, sorted by place, then the lines over them. A
// line takes two rows and comes from two edges at least.
Result<uint32_t> World::hairlines(BodyId id, uint32_t* indices, uint32_t room) const {
    const FpMode mode;
    const State& state = contents_->data.state;
    const Bodies& bodies = state.bodies;
    const Row<Bodies> body = body_row(bodies, id);
    if (!body.exists()) return stale("body", id.index);
    if (!bodies.structure[body].exists()) return 0u;
    const Range all = bodies.view_indices[body];
    const Drawn drawn{state.view_vertices.vertex.data() + bodies.view_vertices[body].first,
                      state.view_indices.index.data() + all.first};
    uint32_t first = 0, count = 0;
    for (uint32_t run = 0; run < static_cast<uint32_t>(SurfaceKind::Crack) * kMostDrawnMaterials; ++run)
        first += bodies.run_indices[body][run];
    for (uint32_t edge = first; edge < all.count / 3 * 3; ++edge) {
        if (!drawn.is_along_wall(edge)) continue;
        if (count == room)
            return Error{"hairlines: room for " + std::to_string(room) + " indices is too little; give " +
                         std::to_string(all.count / 2) + ", half of the view's index_count."};
        indices[count++] = edge;
    }
    std::sort(indices, indices + count, [&](uint32_t a, uint32_t b) { return drawn.comes_before(a, b); });
    uint32_t written = 0;
    for (uint32_t begin = 0, end = 0; begin < count; begin = end) {
        const uint32_t edge = indices[begin];
        for (end = begin + 1; end < count && drawn.are_alike(edge, indices[end]);) ++end;
        if (drawn.is_back(edge) || !drawn.is_back(indices[end - 1])) continue;  // one way only
        indices[written++] = drawn.from(edge);
        indices[written++] = drawn.to(edge);
    }
    return written;
}

}  // namespace cullet
