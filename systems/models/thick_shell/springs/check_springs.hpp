#pragma once
#include <string>

#include "components/shell_rows.hpp"
#include "cullet/result.hpp"

namespace cullet {

/// What the springs of a state must be before a step may follow their indices. They are rows of live shells, one each,
/// with ranges of the shell's size and finite numbers. Their ends are vertices and corners of their elements' edges.
/// Their lists lie in slots of their own and name the springs' other ends. Ranges have been held against their pools.
/// The error is one sentence that begins with `name` and ends with `advice`.
Result<void> check_springs(const ShellRows& state, const std::string& name, const std::string& advice);

}  // namespace cullet
