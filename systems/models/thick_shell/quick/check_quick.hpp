#pragma once
#include <string>

#include "components/body_rows.hpp"
#include "cullet/result.hpp"

namespace cullet {

/// What the quick mode's rows must be before a step may follow them: numbers that a spawn would have taken, runs of
/// open tasks with springs of the task's shell, regions that rise and lie in it. The error is one sentence that begins
/// with `name` and ends with `advice`. `own`: the number of this damage model; runs of others' tasks are not looked at.
Result<void> check_quick_rows(const BodyRows& state, uint8_t own, const std::string& name, const std::string& advice);

}  // namespace cullet
