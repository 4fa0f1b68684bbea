// Pushes one vertex inward after the other, in canonical order, as published (thick shell note A3).
#pragma once
#include "systems/structures/shell/cook/moving_faces.hpp"

namespace cullet {

/// Depths reached; local units. No two listed faces touch. With `tests_elements` every element is sound too (rule 2 of
/// A5); without, as in the paper, elements turn inside out where walls pinch, and part of the depth is theirs.
std::vector<double> run_single_vertex(ExtrusionWork& work, bool tests_elements);

}  // namespace cullet
