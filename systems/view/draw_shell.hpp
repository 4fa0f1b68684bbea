// The drawn mesh of a shell: outer surface, inner surface with rims, crack faces; closed, and of the elements' volume.
#pragma once
#include <array>

#include "components/state.hpp"
#include "cullet/result.hpp"

namespace cullet {

struct DrawnCount {
    uint32_t vertices = 0;
    std::array<uint32_t, 3> indices{};  // of the runs outer, inner (with rims), crack
    uint32_t index_count() const { return indices[0] + indices[1] + indices[2]; }
};

/// Rows that draw_shell will write. Side quads split as the prisms do (A7), so the drawn volume is the elements'.
/// Triangles that collapse where depth is 0 are left out; the rest still closes.
DrawnCount count_drawn(ShellView shell);

/// Writes the mesh into these ranges of ViewVertices and ViewIndices (capacities at least as counted), sets their
/// counts and returns the runs. Outer corners have the game's normals and uvs; inner ones the same uvs and the normals
/// turned round, or the triangle's own where the inner wall runs another way; rims and cracks flat normals and uv =
/// (way along the free border, depth) in m. Each triangle has corners of its own. Nothing allocates. About 0.3
/// microseconds an element.
DrawnCount draw_shell(ShellView shell, Range& view_vertices, Range& view_indices);

/// Joins corners of the very same position and checks that every edge is used as often in one direction as in the
/// other, that indices are in range, and that the volume is the elements' within 1e-4. For tests and --validate; it
/// allocates.
Result<void> check_drawn_mesh(ShellView shell, const Range& view_vertices, const Range& view_indices);

}  // namespace cullet
