#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "systems/fragments/prism.hpp"
#include "systems/view/draw_shell.hpp"

namespace cullet {
namespace {

using Place = std::array<float, 3>;

Place place_of(const State& state, uint32_t row) {
    const Vec3 p = state.view_vertices.vertex[row].position;
    return {p.x, p.y, p.z};
}

std::string text(const Place& p) {
    std::string out = "(";
    for (float x : p) out.append(out.size() > 1 ? ", " : "").append(std::to_string(x));
    return out.append(")");
}

/// Number of the first corner at the same place, for each view vertex.
std::vector<uint32_t> join_places(const State& state, const Range& range) {
    std::map<Place, uint32_t> first;
    std::vector<uint32_t> joined(range.count);
    for (uint32_t v = 0; v < range.count; ++v) {
        Place p = place_of(state, range.first + v);
        for (float& x : p) x += 0.0f;  // -0 is 0
        joined[v] = first.insert({p, v}).first->second;
    }
    return joined;
}

Result<void> check_edges(const State& state, const Range& vertices, const Range& indices) {
    const std::vector<uint32_t> joined = join_places(state, vertices);
    std::map<std::pair<uint32_t, uint32_t>, int> uses;  // + one way, - the other
    for (uint32_t i = 0; i < indices.count; ++i) {
        const uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        const uint32_t a = joined[state.view_indices.index[indices.first + i]];
        const uint32_t b = joined[state.view_indices.index[indices.first + next]];
        if (a != b) uses[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
    for (const auto& [edge, sum] : uses)
        if (sum != 0)
            return Error{"drawn mesh: edge " + text(place_of(state, vertices.first + edge.first)) +
                         " to " + text(place_of(state, vertices.first + edge.second)) + " is used " +
                         std::to_string(sum) + " times more one way than the other; the mesh is open there."};
    return {};
}

double drawn_volume(const State& state, const Range& vertices, const Range& indices) {
    const auto place = [&](uint32_t i) {
        const Place p = place_of(state, vertices.first + state.view_indices.index[indices.first + i]);
        return Vec3d(p[0], p[1], p[2]);
    };
    if (indices.count == 0) return 0;
    const Vec3d origin = place(0);
    double sum = 0;
    for (uint32_t i = 0; i < indices.count; i += 3)
        sum += dot(cross(place(i) - origin, place(i + 1) - origin), place(i + 2) - origin) / 6;
    return sum;
}

}  // namespace

Result<void> check_drawn_mesh(ShellView shell, const Range& view_vertices, const Range& view_indices) {
    const State& state = shell.state;
    if (view_indices.count % 3 != 0)
        return Error{"drawn mesh: " + std::to_string(view_indices.count) + " indices are no whole triangles."};
    for (uint32_t i = 0; i < view_indices.count; ++i)
        if (const uint32_t v = state.view_indices.index[view_indices.first + i]; v >= view_vertices.count)
            return Error{"drawn mesh: index " + std::to_string(i) + " is " + std::to_string(v) + " of " +
                         std::to_string(view_vertices.count) + " vertices."};
    if (Result<void> closed = check_edges(state, view_vertices, view_indices); !closed) return closed;
    double volume = 0, size = 0;
    for (uint32_t e = 0; e < shell.element_count(); ++e) {
        if (state.elements.flags[shell.element(e)] & kDead) continue;
        const double v = prism_volume(load_prism(shell, e, Surface::Drawn));
        volume += v;
        size += std::fabs(v);
    }
    const double drawn = drawn_volume(state, view_vertices, view_indices);
    if (!(std::fabs(drawn - volume) <= 1e-4 * size))
        return Error{"drawn mesh: its volume is " + std::to_string(drawn * 1e6) + " cm3, its elements' " +
                     std::to_string(volume * 1e6) + " cm3."};
    return {};
}

}  // namespace cullet
