#include "systems/view/find_hairlines.hpp"

#include <algorithm>
#include <tuple>

#include "systems/systems.hpp"

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

void find_hairlines(Bodies& bodies, Row<Bodies> body, const ViewVertices& vertices, const ViewIndices& indices,
                    ViewLines& lines) {
    const Range all = bodies.view_indices[body];
    const Drawn drawn{vertices.vertex.data() + bodies.view_vertices[body].first, indices.index.data() + all.first};
    uint32_t first = 0;
    for (uint32_t run = 0; run < static_cast<uint32_t>(SurfaceKind::Crack) * kMostDrawnMaterials; ++run)
        first += bodies.run_indices[body][run];
    // The lines overwrite the edges that they were found from: a line takes two rows and comes from two edges at least.
    uint32_t* const row = lines.index.data() + first_line_row(bodies, body);
    // Enough for what we draw; a snapshot may hold anything.
    const uint32_t room = all.capacity / 2, end_of_indices = all.count / 3 * 3;
    uint32_t count = 0;
    for (uint32_t edge = first; edge < end_of_indices && count < room; ++edge)
        if (drawn.is_along_wall(edge)) row[count++] = edge;
    std::sort(row, row + count, [&](uint32_t a, uint32_t b) { return drawn.comes_before(a, b); });
    uint32_t written = 0;
    for (uint32_t begin = 0, end = 0; begin < count; begin = end) {
        const uint32_t edge = row[begin];
        for (end = begin + 1; end < count && drawn.are_alike(edge, row[end]);) ++end;
        if (drawn.is_back(edge) || !drawn.is_back(row[end - 1])) continue;  // one way only
        row[written++] = drawn.from(edge);
        row[written++] = drawn.to(edge);
    }
    bodies.hairline_indices[body] = written;
}

void draw_hairlines(Each<ShellChanged> changed, Bodies& bodies, const ViewVertices& vertices,
                    const ViewIndices& indices, ViewLines& lines) {
    const Row<Bodies> body = changed->body;
    if (static_cast<BodyKind>(bodies.kind[body]) == BodyKind::Free) return;
    find_hairlines(bodies, body, vertices, indices, lines);
}

}  // namespace cullet
