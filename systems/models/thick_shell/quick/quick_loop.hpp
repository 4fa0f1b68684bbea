// The inner loop of the quick mode, on tables alone.
#pragma once
#include "systems/models/thick_shell/hidden/brittle_loop.hpp"

namespace cullet {

/// A loop's `body` is a task whose region is awake; task_goes_on tells when it ends.
BrittleLoop make_quick_loop();

/// Units of one repetition, with its share of the checks.
uint64_t quick_units_a_step(const RunRows& state, uint32_t task);
/// Of what follows the last one: the cut-out goes back, pieces are found, made and drawn.
uint64_t quick_units_of_end(const RunRows& state, uint32_t task);

}  // namespace cullet
