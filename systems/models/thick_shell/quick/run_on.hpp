// A crack that has started runs on.
#pragma once
#include "systems/models/thick_shell/quick/splitting.hpp"

namespace cullet {

/// Edges that a crack of coarse fracture runs on for at most, either way: cut-outs of large bodies must reach so far.
inline constexpr uint32_t kCoarseRunSteps = 8;

/// C4, large fragments: from a tip on that goes `way`, along the plane of unit `normal`, no criterion asked, until the
/// crack meets a border or a crack, or is farther than run_length from where it began. The plane turns a little about
/// the shell's normal at each vertex; its own turns do not add up, or cracks would curl. Beyond the published method, a
/// crack that would pass another closely turns to it, as in the hidden run. So few cracks are dead ends. Where the
/// plane runs out of the surface's way, at a body's sharp edges, the crack goes straight on over them.
void run_on(Splitting& s, uint32_t tip, Vec3 way, Vec3 normal, uint32_t root);

}  // namespace cullet
