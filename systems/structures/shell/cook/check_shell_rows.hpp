// Whether the rows of a shell are such that systems can work on them: for files, which are not believed.
#pragma once
#include "components/shell_rows.hpp"
#include "cullet/result.hpp"
#include "systems/checks/wear.hpp"

namespace cullet {

/// The shell's own rows: its ranges are inside the tables. `name` is the file's, `advice` the sentence that ends a
/// refusal.
Result<void> check_shell_rows(const ShellView& shell, Wear wear, const std::string& name, const char* advice);

}  // namespace cullet
