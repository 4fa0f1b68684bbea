#pragma once

namespace cullet {

/// Steps and units of a run are counted in whole numbers, which a shell or a file must not leave: its step, s, and how
/// many steps its run may have. Cooked ones are 1e-7 s and some thousand.
constexpr float kShortestStep = 1e-12f, kMostSteps = 1e9f;

}  // namespace cullet
