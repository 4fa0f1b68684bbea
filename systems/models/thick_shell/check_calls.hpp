// What checks of files ask of the thick shell (model_calls.hpp).
#pragma once
#include "systems/model_calls.hpp"

namespace cullet {

/// The shell's rows; one that nothing has hit has its stiffness, and runs on it end.
Result<void> check_thick_shell(ShellRows& rows, Row<Structures> structure, Wear wear, const std::string& name,
                               const char* advice);
/// A hidden run has stiffness.
std::string trouble_of_run(const RunRows& state, uint32_t task);
/// Soft bodies, springs, quick runs and regions.
Result<void> check_model_rows(const SoftRows& state, uint8_t own, const std::string& name, const char* advice);

}  // namespace cullet
