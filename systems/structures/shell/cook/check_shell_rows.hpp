// Whether the rows of a shell are such that systems can work on them: for files, which are not believed.
#pragma once
#include "components/shell_rows.hpp"
#include "cullet/result.hpp"

namespace cullet {

/// Worn: a body's that was pinned, cracked or broken, or a task's, at whatever step of its run. CutOut: a task's that
/// has a part of the body (models/thick_shell/shared/cut_out.hpp).
enum class Wear : uint8_t { Intact, Worn, CutOut };

/// The shell's own rows: its ranges are inside the tables. `name` is the file's, `advice` the sentence that ends a
/// refusal.
Result<void> check_shell_rows(const ShellView& shell, Wear wear, const std::string& name, const char* advice);

}  // namespace cullet
