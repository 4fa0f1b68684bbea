// What the check of a snapshot asks of the thick shell (model_calls.hpp).
#pragma once
#include "systems/model_calls.hpp"

namespace cullet {

/// The shell's rows, by the rules of cooked ones.
Result<void> check_worn_shell(const ShellView& shell, bool is_part, const std::string& name, const char* advice);
/// A hidden run has stiffness.
std::string trouble_of_run(const RunRows& state, uint32_t task);
/// Springs, quick runs and regions.
Result<void> check_model_rows(const BodyRows& state, const std::string& name, const char* advice);

}  // namespace cullet
