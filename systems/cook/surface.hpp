// A mesh made ready for extrusion: cleaned, in canonical order, wound outward, with neighbours and one fan of triangles
// a vertex. Everything later is bit-identical for any numbering of the input, because the canonical order depends on
// positions alone.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cullet/result.hpp"
#include "engine/math.hpp"
#include "engine/mesh.hpp"
#include "engine/ray_scene.hpp"
#include "engine/table.hpp"

namespace cullet {

/// What was changed to make a mesh usable. All zero for a clean closed mesh.
struct SurfaceRepairs {
    uint32_t welded_vertices = 0;            // same position as an earlier one, or within the tolerance
    uint32_t unused_vertices = 0;            // in no triangle that was kept
    uint32_t repeated_corner_triangles = 0;  // dropped
    uint32_t zero_area_triangles = 0;        // area below 1e-12 of the diagonal squared, dropped
    uint32_t repeated_triangles = 0;         // same three positions as another, either winding, dropped
    uint32_t crowded_edges = 0;              // in more than two triangles; sheets paired by angle
    uint32_t loose_sheets = 0;               // triangle edges left without a partner at crowded edges
    uint32_t turned_triangles = 0;           // winding changed to agree with the neighbours
    uint32_t turned_components = 0;          // closed and inside out, turned whole
    uint32_t flipped_triangles = 0;          // whose winding, after both, is not the one that came
    uint32_t cavities = 0;                   // closed, inside out, and inside another: kept as they are
    uint32_t unorientable_components = 0;    // one-sided; they get depth 0
    uint32_t split_vertices = 0;             // vertices added because several fans met at one position
    uint32_t crossing_pairs = 0;             // triangles that cut or touch each other; kept, never tested later
    uint32_t independent_pairs = 0;          // pairs of components that cross, touch or share a position
    uint32_t open_borders = 0;               // loops of edges with one triangle; no repair: they stay open
    uint32_t border_edges = 0;               // edges of these loops
    bool is_mostly_border = false;  // most edges have one triangle: positions are perhaps equal only within noise
    /// Nothing was changed or found that a person should know; open borders are ordinary.
    bool is_clean() const;
};
/// One sentence for a person, for example "Surface: welded 3 vertices at the position of another, flipped 2 triangles."
std::string describe(const SurfaceRepairs& repairs);

/// Triangles connected over paired edges.
struct SurfaceComponent {
    uint32_t first_triangle = 0;  // lowest of its triangles
    uint32_t triangle_count = 0;
    double volume = 0;  // m3, signed; 0 when open
    bool is_closed = false;
    bool is_orientable = true;
    bool is_cavity = false;
};

struct BorderEdge {
    uint32_t triangle = 0;
    uint32_t edge = 0;  // from corner `edge` to corner (edge + 1) % 3
};

struct Surface {
    std::vector<Vec3d> positions;        // m, one a vertex
    std::vector<uint32_t> position_ids;  // vertices at the same place share it; positions in (x, y, z) order
    uint32_t position_count = 0;
    std::vector<Triangle> triangles;   // vertices, counter-clockwise from outside
    std::vector<Triangle> neighbours;  // triangle across edge k, from corner k to corner (k + 1) % 3, or kNone
    std::vector<uint32_t> component_of;
    std::vector<SurfaceComponent> components;
    /// Triangle t came from triangle source_triangles[t] of the mesh; its corner k from that one's corner
    /// source_corners[t][k].
    std::vector<uint32_t> source_triangles;
    std::vector<std::array<uint8_t, 3>> source_corners;
    /// Border edges, loop after loop in walking order; loop l is [border_loops[l], border_loops[l + 1]).
    std::vector<BorderEdge> border_edges;
    std::vector<uint32_t> border_loops;
    std::vector<std::array<uint32_t, 2>> crossings;  // triangles a < b that cut or touch, sorted
    /// Components that cross, touch or share a position: they are bodies of their own and never limit each other's
    /// depth.
    std::vector<std::array<uint32_t, 2>> independent;  // both orders, sorted
    Vec3d low, high;                                   // m, bounds
    double diagonal = 0;                               // m
    SurfaceRepairs repairs;

    bool are_independent(uint32_t component_a, uint32_t component_b) const;
};

struct SurfaceSettings {
    double weld_tolerance =
        0;  // of the diagonal, 0 to 0.01; 0 welds equal positions only, 1e-7 heals a soup with noise
    bool searches_crossings =
        true;  // false for a mesh known to have none: saves a microsecond a triangle, gives no guarantee
};

/// Refuses what is not finite, out of range or without area; repairs the rest and says what was repaired.
Result<Surface> prepare_surface(const Mesh& mesh, const SurfaceSettings& settings = {});

}  // namespace cullet
