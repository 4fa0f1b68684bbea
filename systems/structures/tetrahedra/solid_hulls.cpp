#include "systems/structures/tetrahedra/solid_hulls.hpp"

#include "systems/structures/shell/piece_shape.hpp"

namespace cullet {
namespace {

constexpr float kMostPull = 0.5f;  // of the way to the hull's middle

// Towards the middle: faces stand out by a little, since they are pulled by less than their corners.
void write_points(ConvexCells rows, uint32_t first, std::span<const Vec3> points, float margin) {
    Vec3 middle;
    for (const Vec3 p : points) middle += p;
    middle = (1.0f / static_cast<float>(points.size())) * middle;
    for (const Vec3 p : points) {
        const Vec3 way = middle - p;
        const float far = length(way);
        const Vec3 pull = far > 0 ? (std::min(margin, kMostPull * far) / far) * way : Vec3{};
        rows.hull_points.point.set(first++, p + pull);
    }
}

}  // namespace

void add_hulls(ConvexCells rows, Row<Structures> structure, std::span<const uint8_t> sizes,
               std::span<const Vec3> corners) {
    Structures& structures = rows.structures;
    Range &cells = structures.cells[structure], &points = structures.points[structure];
    for (const uint8_t count : sizes) {
        CULLET_ASSERT(cells.count < cells.capacity && points.count + count <= points.capacity,
                      "%u hulls do not fit the cells of their structure", cells.count + 1);
        const uint32_t row = cells.first + cells.count++;
        rows.cells.clear_rows(row, 1);
        rows.cells.first_point[row] = points.count;
        rows.cells.point_count[row] = count;
        rows.cells.part_points[row] = {count, 0, 0, 0};
        rows.cells.element_count[row] = 1;
        rows.cells.same_cell[row] = rows.cells.shape[row] = kNone;
        write_points(rows, points.first + points.count, corners.first(count), structures.margin[structure]);
        points.count += count;
        corners = corners.subspan(count);
    }
    structures.shape[structure] = static_cast<uint8_t>(ShapeKind::Cells);
    structures.shape_points[structure] = 0;
}

void write_hulls(ConvexCells rows, Row<Structures> structure, std::span<const SolidHull> hulls, double thickness) {
    rows.structures.margin[structure] = margin_for(thickness);
    rows.structures.cells[structure].count = rows.structures.points[structure].count = 0;
    for (const SolidHull& hull : hulls) {
        const auto count = static_cast<uint8_t>(hull.points.size());
        add_hulls(rows, structure, {&count, 1}, hull.points);
    }
}

}  // namespace cullet
