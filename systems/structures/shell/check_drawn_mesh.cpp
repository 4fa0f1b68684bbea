#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "systems/structures/shell/drawn_triangles.hpp"
#include "systems/structures/shell/prism.hpp"

namespace cullet {
namespace {

Vec3 place_of(const ViewVertices& drawn, const Range& vertices, uint32_t v) {
    return drawn.vertex[vertices.first + v].position;
}

std::string text(Vec3 p) {
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
}

/// Points of the shell by rising number, as one key.
uint64_t pair_of(uint32_t a, uint32_t b) {
    return uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

Result<void> check_rows(const ShellView& shell, const ViewIndices& drawn, const Range& vertices, const Range& indices) {
    const DrawnCount count = count_drawn(shell);
    if (vertices.count != count.vertices || indices.count != count.index_count() || indices.count % 3 != 0)
        return Error{"drawn mesh: " + std::to_string(vertices.count) + " vertices and " +
                     std::to_string(indices.count) + " indices, but its shell has " + std::to_string(count.vertices) +
                     " and " + std::to_string(count.index_count()) + "; the mesh is open."};
    for (uint32_t i = 0; i < indices.count; ++i)
        if (const uint32_t v = drawn.index[indices.first + i]; v >= vertices.count)
            return Error{"drawn mesh: index " + std::to_string(i) + " is " + std::to_string(v) + " of " +
                         std::to_string(vertices.count) + " vertices."};
    return {};
}

Result<void> check_sources(const ShellView& shell, const ViewIndices& drawn, const Range& indices) {
    std::vector<uint32_t> sources;
    for (uint32_t i = 0; i < indices.count; i += 3) sources.push_back(drawn.source[indices.first + i]);
    for (const uint32_t source : sources)
        if (const uint32_t e = source / kMostDrawnTriangles;
            e >= shell.element_count() || !is_drawn(shell, e, source % kMostDrawnTriangles))
            return Error{"drawn mesh: a triangle is of element " + std::to_string(e) + ", which does not have it."};
    std::sort(sources.begin(), sources.end());
    if (const auto twice = std::adjacent_find(sources.begin(), sources.end()); twice != sources.end())
        return Error{"drawn mesh: element " + std::to_string(*twice / kMostDrawnTriangles) +
                     " has a triangle that is drawn twice."};
    return {};
}

Result<void> check_places(const ShellView& shell, const ViewVertices& rows, const Range& vertices,
                          const std::vector<uint32_t>& numbers) {
    for (uint32_t v = 0; v < vertices.count; ++v) {
        const uint32_t row = shell.vertex(numbers[v] / 2);
        const Vec3 wanted =
            numbers[v] % 2 ? smoothed_twin(shell.state, row).to_float() : smoothed_place(shell.state, row);
        const Vec3 drawn = place_of(rows, vertices, v);
        if (std::memcmp(&wanted, &drawn, sizeof wanted) != 0)
            return Error{"drawn mesh: vertex " + std::to_string(v) + " is drawn at " + text(drawn) +
                         ", its point stands at " + text(wanted) + "."};
    }
    return {};
}

/// Pairs of vertices with a free edge on both of its sides: cracks of a single edge.
std::vector<uint64_t> single_cracks(const ShellView& shell) {
    const Elements& elements = shell.state.elements;
    std::vector<uint64_t> free_edges, found;
    for (uint32_t e = shell.element(0); e < shell.element(shell.element_count()); ++e)
        for (int k = 0; k < 3; ++k)
            if (!(elements.flags[e] & kDead) && elements.neighbour[e][k] == kNone)
                free_edges.push_back(pair_of(elements.corner[e][k], elements.corner[e][(k + 1) % 3]));
    std::sort(free_edges.begin(), free_edges.end());
    for (size_t i = 1; i < free_edges.size(); ++i)
        if (free_edges[i] == free_edges[i - 1]) found.push_back(free_edges[i]);
    return found;
}

struct Use {
    uint64_t edge;      // pair_of
    uint32_t is_back;   // from the larger to the smaller number
    uint32_t from, to;  // view vertices
};

Result<void> check_edges(const ShellView& shell, DrawnRows drawn, const Range& vertices, const Range& indices,
                         const std::vector<uint32_t>& numbers) {
    std::vector<Use> uses;
    for (uint32_t i = 0; i < indices.count; ++i) {
        const uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        const uint32_t from = drawn.view_indices.index[indices.first + i],
                       to = drawn.view_indices.index[indices.first + next];
        if (numbers[from] == numbers[to])
            return Error{"drawn mesh: triangle " + std::to_string(i / 3) + " has a corner twice, at " +
                         text(place_of(drawn.view_vertices, vertices, from)) + "."};
        uses.push_back({pair_of(numbers[from], numbers[to]), numbers[from] > numbers[to], from, to});
    }
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
        return a.edge != b.edge ? a.edge < b.edge : a.is_back != b.is_back ? a.is_back < b.is_back : a.from < b.from;
    });
    const std::vector<uint64_t> single = single_cracks(shell);
    const auto is_flat = [&](uint32_t v) { return !(shell.state.vertices.depth[shell.vertex(v)] > 0); };
    for (size_t i = 0; i < uses.size();) {
        size_t count[2] = {0, 0}, end = i;
        for (; end < uses.size() && uses[end].edge == uses[i].edge; ++end) ++count[uses[end].is_back];
        const uint32_t a = static_cast<uint32_t>(uses[i].edge >> 32) / 2, b = static_cast<uint32_t>(uses[i].edge) / 2;
        const bool may_be_four =
            (is_flat(a) && is_flat(b)) || std::binary_search(single.begin(), single.end(), pair_of(a, b));
        if (count[0] != count[1] || count[0] > (may_be_four ? 2u : 1u))
            return Error{"drawn mesh: edge " + text(place_of(drawn.view_vertices, vertices, uses[i].from)) + " to " +
                         text(place_of(drawn.view_vertices, vertices, uses[i].to)) + " is used " +
                         std::to_string(count[0]) + " times one way and " + std::to_string(count[1]) +
                         " times the other, not once each; the mesh is open there or touches itself."};
        i = end;
    }
    return {};
}

double drawn_volume(DrawnRows drawn, const Range& vertices, const Range& indices) {
    const auto place = [&](uint32_t i) {
        return Vec3d(place_of(drawn.view_vertices, vertices, drawn.view_indices.index[indices.first + i]));
    };
    if (indices.count == 0) return 0;
    const Vec3d origin = place(0);
    double sum = 0;
    for (uint32_t i = 0; i < indices.count; i += 3)
        sum += dot(cross(place(i) - origin, place(i + 1) - origin), place(i + 2) - origin) / 6;
    return sum;
}

}  // namespace

Result<void> check_drawn_mesh(ShellView shell, DrawnRows drawn, const Range& view_vertices, const Range& view_indices) {
    if (Result<void> rows = check_rows(shell, drawn.view_indices, view_vertices, view_indices); !rows) return rows;
    if (Result<void> sources = check_sources(shell, drawn.view_indices, view_indices); !sources) return sources;
    std::vector<uint32_t> numbers(view_vertices.count);
    number_drawn(shell, drawn.view_indices, view_indices, numbers);
    if (Result<void> places = check_places(shell, drawn.view_vertices, view_vertices, numbers); !places) return places;
    if (Result<void> closed = check_edges(shell, drawn, view_vertices, view_indices, numbers); !closed) return closed;
    double volume = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e)
        if (!(shell.state.elements.flags[shell.element(e)] & kDead))
            volume += prism_volume(load_smoothed_prism(shell, e));
    const double of_mesh = drawn_volume(drawn, view_vertices, view_indices);
    if (!(std::fabs(of_mesh - volume) <= 1e-4 * std::fabs(volume)))
        return Error{"drawn mesh: its volume is " + std::to_string(of_mesh * 1e6) + " cm3, its elements' " +
                     std::to_string(volume * 1e6) + " cm3."};
    return {};
}

}  // namespace cullet
