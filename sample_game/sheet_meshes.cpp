#include <algorithm>
#include <cmath>

#include "sample_game/mesh_tools.hpp"
#include "sample_game/meshes.hpp"

namespace cullet {
namespace {

constexpr double kColumnWidth = 0.86602540378443865;  // of an equilateral triangle, in edges

/// Column x of a sheet, bottom to top. Odd columns are moved by half an edge and keep a point at both ends, so that the
/// borders are straight; points on a border move along it, corners stay, and all others both ways by up to `moved`.
std::vector<uint32_t> add_column(MeshDraft& surface, double x, double height, uint64_t segments, bool is_side,
                                 double moved, uint64_t seed, uint64_t column) {
    const bool is_odd = column % 2 == 1;
    const uint64_t count = segments + (is_odd ? 2 : 1);
    std::vector<uint32_t> ids;
    for (uint64_t i = 0; i < count; ++i) {
        const bool is_end = i == 0 || i + 1 == count;
        const double place = i == 0   ? 0
                             : is_end ? static_cast<double>(segments)
                                      : static_cast<double>(i) - (is_odd ? 0.5 : 0);
        const double across = is_side ? 0 : moved * jitter(seed, column, i, 1);
        const double along = is_end ? 0 : moved * jitter(seed, column, i, 2);
        ids.push_back(static_cast<uint32_t>(surface.points.size()));
        surface.points.push_back({x + across, height * place / static_cast<double>(segments) + along, 0});
    }
    return ids;
}

MeshDraft sheet(double width, double height, double wanted_edge, uint64_t seed, double share_moved) {
    const double edge = usable_edge(wanted_edge, std::max(width, height));
    // One less each way makes up for the closer points along the borders: vertices are area / (sqrt(3)/2 edge^2), as
    // inside.
    const auto columns = static_cast<uint64_t>(std::max(2.0, std::floor(width / (kColumnWidth * edge)) - 1));
    const auto segments = static_cast<uint64_t>(std::max(2.0, std::floor(height / edge) - 1));
    MeshDraft surface;
    std::vector<uint32_t> before;
    for (uint64_t column = 0; column <= columns; ++column) {
        const double x = width * (static_cast<double>(column) / static_cast<double>(columns) - 0.5);
        const bool is_side = column == 0 || column == columns;
        const std::vector<uint32_t> ids =
            add_column(surface, x, height, segments, is_side, share_moved * edge, seed, column);
        if (column > 0) stitch_rows(surface, before, ids, false);
        before = ids;
    }
    flip_to_delaunay(surface);
    return surface;
}

}  // namespace

Mesh make_wall(float width, float height, float edge, uint64_t seed) {
    return to_mesh(
        sheet(static_cast<double>(width), static_cast<double>(height), static_cast<double>(edge), seed, kUnevenness),
        "wall");
}

Mesh make_pane(float side, float edge, uint64_t seed, double unevenness) {
    return to_mesh(
        sheet(static_cast<double>(side), static_cast<double>(side), static_cast<double>(edge), seed, unevenness),
        "pane");
}

}  // namespace cullet
