// What to draw. Buffers are the world's own memory: they stay good until the next step, and their addresses do not
// change while the stamp does not.
#pragma once
#include <cstdint>

#include "cullet/types.hpp"

namespace cullet {

struct ViewVertex {
    Vec3 position;  // body coordinates, m
    Vec3 normal;    // unit
    Vec2 uv;        // the game's on outer and inner faces; (arc length along the crack, depth) in m on crack faces
};

enum class SurfaceKind : uint8_t { Outer, Inner, Crack };

/// A body's drawn materials that have runs of their own. Where it has more, the eighth in rising order takes the later
/// ones too. Doubled, a body's row grows by 112 bytes.
inline constexpr uint32_t kMostDrawnMaterials = 8;
inline constexpr uint32_t kMostRuns = 3 * kMostDrawnMaterials;

/// Indices [first, first + count): the triangles of one kind that the game gave one material.
struct MaterialRun {
    SurfaceKind kind = SurfaceKind::Outer;
    uint16_t material = 0;  // MeshView::materials of the triangle, also on the inner and crack faces below it
    uint32_t first_index = 0, index_count = 0;
};

/// Elements [first, first + count) of a buffer, vertices or indices. All that changed in the last step are among them;
/// count 0: none did. What a hit leaves of a body keeps the order of its triangles, but for those that fill the gaps. A
/// body that was spawned since the last step has all of them until the next step is over.
struct DirtyRange {
    uint32_t first = 0, count = 0;
};

/// One body's drawn mesh: a closed surface. Take equal positions as one. Then every edge is run as often one way as
/// the other, by one triangle each. Only along cracks there may be more: both sides lie on each other until they part.
struct BodyView {
    const ViewVertex* vertices = nullptr;
    uint32_t vertex_count = 0;
    const uint32_t* indices = nullptr;  // into vertices
    uint32_t index_count = 0;
    MaterialRun runs[kMostRuns];  // the first run_count, none empty, by (kind, material); they cover all indices
    uint32_t run_count = 0;
    /// While the body is intact the buffers are those of this model, and the same for all its intact bodies. So a game
    /// may draw them as instances. The null handle: the body has a mesh of its own.
    ModelId model;
    uint32_t stamp = 0;  // another number whenever the mesh is another one
    DirtyRange dirty_vertices, dirty_indices;
    Pose pose_before, pose;  // before and after the last step: mix them by the share of the step not yet simulated
};

}  // namespace cullet
