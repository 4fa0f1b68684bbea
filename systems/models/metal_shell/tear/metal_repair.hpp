// Rows of metal follow when a shell is cut: what is put on an edge lies between its ends in all that metal keeps, and
// springs do not reach across a crack.
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"
#include "systems/structures/shell/touched.hpp"

namespace cullet {

/// While cuts put vertices on edges, one after the other. What has no room for its rows has none in the shell either.
struct MetalRepair : CutRepair {
    explicit MetalRepair(const MetalView& of);
    MetalTables metal;
};

/// What rows of the shell were there before some cuts.
struct RowsBefore {
    uint32_t vertices = 0, elements = 0;
};
RowsBefore rows_of(const MetalView& metal);

/// After each of them: copies of vertices get the rows of those that they were.
void follow_copies(const MetalView& metal);
/// After the last one: springs are laid anew along the edges of all that the cuts touched. Lengths and stiffness are
/// those of the original shape, as cooking found them.
void lay_springs_anew(const MetalView& metal, RowsBefore before);

}  // namespace cullet
