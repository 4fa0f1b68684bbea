#include "tests/support/closed_view.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <vector>

namespace cullet::test {

std::string find_open_edge(const BodyView& view) {
    if (view.index_count % 3 != 0) return std::to_string(view.index_count) + " indices are no triangles";
    using Place = std::array<float, 3>;
    std::vector<Place> places;
    for (uint32_t v = 0; v < view.vertex_count; ++v) {
        const Vec3 p = view.vertices[v].position;
        places.push_back({p.x + 0.0f, p.y + 0.0f, p.z + 0.0f});  // -0 is 0
    }
    std::vector<Place> welded = places;
    std::sort(welded.begin(), welded.end());
    welded.erase(std::unique(welded.begin(), welded.end()), welded.end());
    const auto number = [&](uint32_t index) -> size_t {
        if (index >= view.vertex_count) return welded.size();
        return static_cast<size_t>(std::lower_bound(welded.begin(), welded.end(), places[index]) - welded.begin());
    };
    std::map<std::pair<size_t, size_t>, int> runs;  // one way less the other
    for (uint32_t i = 0; i < view.index_count; ++i) {
        const size_t from = number(view.indices[i]), to = number(view.indices[i % 3 == 2 ? i - 2 : i + 1]);
        if (from == welded.size()) return "index " + std::to_string(i) + " names no vertex";
        if (from == to) continue;
        runs[std::minmax(from, to)] += from < to ? 1 : -1;
    }
    for (const auto& [edge, balance] : runs) {
        if (balance == 0) continue;
        const Place p = welded[edge.first], q = welded[edge.second];
        char text[200];
        std::snprintf(text, sizeof text, "edge (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g) has %d more one way", p[0],
                      p[1], p[2], q[0], q[1], q[2], balance);
        return text;
    }
    return "";
}

}  // namespace cullet::test
