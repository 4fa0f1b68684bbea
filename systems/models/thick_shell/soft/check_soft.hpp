#pragma once
#include <string>

#include "components/body_rows.hpp"
#include "cullet/result.hpp"

namespace cullet {

/// What rows of soft bodies must be before a step may follow them: one a body with springs of its own, rows for its
/// contacts, numbers that a spawn would have given. The error is one sentence that begins with `name` and ends with
/// `advice`.
Result<void> check_soft(const SoftRows& state, const std::string& name, const std::string& advice);

}  // namespace cullet
