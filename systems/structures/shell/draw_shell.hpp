// The drawn mesh of a shell: outer surface, inner surface with rims, crack faces; closed, and of the elements' volume.
#pragma once
#include <array>
#include <span>

#include "components/body_rows.hpp"
#include "cullet/result.hpp"

namespace cullet {

/// The smallest kMostDrawnMaterials material ids of a shell's elements, rising; a larger id counts as the last of them.
struct DrawnMaterials {
    std::array<uint16_t, kMostDrawnMaterials> id{};
    uint32_t count = 0;
};

struct DrawnCount {
    uint32_t vertices = 0;
    DrawnMaterials materials;
    std::array<uint32_t, kMostRuns> indices{};  // by kind (outer, inner with rims, crack), then by material
    uint32_t index_count() const;
};

/// Where drawn meshes stand.
struct DrawnRows {
    ViewVertices& view_vertices;
    ViewIndices& view_indices;
};

/// Rows that draw_shell will write. Side quads split as the prisms do (A7), so the drawn volume is the elements'.
/// Triangles that collapse where depth is 0 are left out; the rest still closes.
DrawnCount count_drawn(ShellView shell);

/// Most rows that draw_shell can write, of either table, for all live elements or for those of a listed part.
uint32_t most_view_rows(ShellView shell);
uint32_t most_view_rows(ShellView shell, const FragmentPart& part);

/// Writes the mesh into these ranges of ViewVertices and ViewIndices (capacities at least as counted). Sets their
/// counts and returns the runs. Triangle s has vertices and indices 3 s to 3 s + 2, and elements stand in rising order
/// within a run. Outer corners have the game's normals and uvs. Inner ones have the same uvs and the normals turned
/// round, or the triangle's own where the inner wall runs another way. Rims and cracks have flat normals and uv = (way
/// along the free border, depth) in m. Each triangle has corners of its own. Nothing allocates. About 0.3 microseconds
/// an element.
DrawnCount draw_shell(ShellView shell, DrawnRows to, Range& view_vertices, Range& view_indices);
/// The same into the body's own ranges and run columns; its stamp becomes another.
void draw_body(BodyRows& state, Row<Bodies> body);

/// Elements.drawn from ViewIndices.source.
void remember_drawn(ShellView shell, const ViewIndices& rows, const Range& view_indices);

/// Which point of the solid each vertex of the drawn mesh stands for, by ViewIndices.source: 2 * vertex of the shell,
/// + 1 on the inner side where depth is above 0. `numbers` has room for as many as there are indices.
void number_drawn(ShellView shell, const ViewIndices& rows, const Range& view_indices, std::span<uint32_t> numbers);

/// Checks that each corner is drawn where its point is, to the bit, that every edge between two points belongs to
/// exactly two triangles, once each way, and that the volume is the elements' within 1e-4. By number and not by place:
/// the two sides of a crack stand at one place. Two kinds of edges belong to four triangles, twice each way: where both
/// ends have depth 0, outer and inner face are one; a crack of a single edge has not yet split its ends. For tests and
/// --validate; it allocates.
Result<void> check_drawn_mesh(ShellView shell, DrawnRows drawn, const Range& view_vertices, const Range& view_indices);

}  // namespace cullet
