// What the stages of one extrusion share. Local coordinates throughout (see LocalFrame).
#pragma once
#include "systems/hulls/box_tree.hpp"
#include "systems/structures/shell/cook/extrude.hpp"

namespace cullet {

/// Vertex -> rows, in ascending order of row.
struct VertexRows {
    std::vector<uint32_t> start, row;
    std::span<const uint32_t> operator[](uint32_t v) const {
        return {row.data() + start[v], row.data() + start[v + 1]};
    }
};

struct ExtrusionWork {
    const Surface& surface;
    LocalFrame frame;
    double thickness;
    ExtrusionSettings settings;

    std::vector<Vec3d> points;   // of the outer surface
    std::vector<Vec3d> normals;  // of triangles, unit, outward
    std::vector<double> areas;   // of triangles
    VertexRows ring;             // vertex -> triangles
    std::vector<uint32_t> component_of_vertex;

    std::vector<Vec3d> directions;   // inward, unit
    std::vector<double> facing;      // least m . -n over the triangles of a vertex
    std::vector<uint8_t> is_frozen;  // depth stays 0
    std::vector<double> wall_caps;   // by opposite walls
    std::vector<double> first_caps;  // also by slope
    std::vector<double> caps;        // also by the shape of each element
    ExtrusionStatistics statistics;
    std::vector<std::vector<double>> path;  // of depths, when settings.keeps_path

    ExtrusionWork(const Surface& s, double metres, const ExtrusionSettings& e);
    uint32_t vertex_count() const { return static_cast<uint32_t>(points.size()); }
    uint32_t triangle_count() const { return static_cast<uint32_t>(normals.size()); }
    void keep(const std::vector<double>& depth) {
        if (settings.keeps_path) path.push_back(depth);
    }
    Vec3d inner(uint32_t v, double depth) const { return points[v] + depth * directions[v]; }
};

/// Least m . -n of direction m over the triangles of v.
double least_facing(const ExtrusionWork& work, uint32_t v, Vec3d m);

/// A1: angle-weighted inward directions; where those do not see every face, the axis of the smallest cone of normals.
/// With a skin, the way across the wall stands for the normal where it is given.
void choose_directions(ExtrusionWork& work, const InnerSkin* skin = nullptr);

}  // namespace cullet
