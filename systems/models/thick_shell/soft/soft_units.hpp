// What soft bodies cost, in units, and what they are given of them.
#pragma once
#include "components/body_rows.hpp"

namespace cullet {

/// A frame of every awake body with all of its substeps.
uint64_t soft_units_wanted(const SoftRows& state);
inline uint32_t most_soft_bodies(const SoftRows& state) {
    return state.soft_bodies.limit();
}
/// Gives each awake body as many of its substeps as the units allow, all the same share, but at least kLeastSubsteps:
/// with fewer than it asks for it runs slower than the world. `slow_frames` counts these. Returns what they cost.
uint64_t grant_soft(SoftRows& state, uint64_t units, uint64_t& slow_frames);
/// Of one substep of these springs, contacts and flow with it.
uint64_t soft_units_a_substep(const ShellSprings& springs, Row<ShellSprings> row);
/// That the body runs in this frame: the step, or less where it was granted fewer substeps.
float soft_seconds(const SoftBodies& soft, uint32_t row, float step_seconds);

}  // namespace cullet
