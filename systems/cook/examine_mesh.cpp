#include <algorithm>
#include <new>

#include "cullet/model.hpp"
#include "engine/fp_mode.hpp"
#include "systems/cook/mesh_of_view.hpp"
#include "systems/cook/surface.hpp"

namespace cullet {

// The same preparation that cooking begins with, looked at and thrown away.
Result<MeshReport> examine_mesh(const MeshView& view) {
    const FpMode mode;
    try {
        const Result<Mesh> mesh = mesh_of_view(view);
        if (!mesh) return Error{mesh.error()};
        const Result<Surface> surface = prepare_surface(*mesh);
        if (!surface) return Error{surface.error()};
        const SurfaceRepairs& r = surface->repairs;
        MeshReport report;
        report.welded_vertices = r.welded_vertices;
        report.dropped_triangles = r.repeated_corner_triangles + r.zero_area_triangles + r.repeated_triangles;
        report.flipped_triangles = r.flipped_triangles;
        report.split_edges = r.crowded_edges;
        report.split_vertices = r.split_vertices;
        report.crossing_pairs = r.crossing_pairs;
        report.one_sided_parts = r.unorientable_components;
        report.parts = static_cast<uint32_t>(surface->components.size());
        report.closed_parts = static_cast<uint32_t>(std::count_if(
            surface->components.begin(), surface->components.end(), [](const auto& c) { return c.is_closed; }));
        report.open_borders = r.open_borders;
        report.open_edges = r.border_edges;
        report.repairs = describe(r);
        return report;
    } catch (const std::bad_alloc&) {
        return Error{std::string(view.name ? view.name : "mesh") + ": no memory to examine its " +
                     std::to_string(view.triangle_count) + " triangles. Free memory or simplify the mesh."};
    }
}

}  // namespace cullet
