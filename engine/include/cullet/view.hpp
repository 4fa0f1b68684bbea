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

/// Indices [first, first + count) of one kind; those of one drawn material of the game stand together.
struct MaterialRun {
    SurfaceKind kind = SurfaceKind::Outer;
    uint32_t first_index = 0, index_count = 0;
};

/// Bytes of a buffer that changed in the last step: elements [first, first + count). count 0: none.
struct DirtyRange {
    uint32_t first = 0, count = 0;
};

/// One body's drawn mesh: a closed surface, every edge shared by exactly two triangles.
struct BodyView {
    const ViewVertex* vertices = nullptr;
    uint32_t vertex_count = 0;
    const uint32_t* indices = nullptr;  // into vertices
    uint32_t index_count = 0;
    MaterialRun runs[3];
    uint32_t stamp = 0;  // another number whenever the mesh is another one
    DirtyRange dirty_vertices, dirty_indices;
    Pose pose_before, pose;  // before and after the last step: mix them by the share of the step not yet simulated
};

}  // namespace cullet
