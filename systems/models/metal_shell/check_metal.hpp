// Whether the rows of a metal shell are such that systems can work on them: for files, which are not believed.
#pragma once
#include "systems/structures/shell/cook/check_shell_rows.hpp"

namespace cullet::metal_shell {

Result<void> check_metal_shell(const ShellView& shell, Wear wear, const std::string& name, const char* advice);

}  // namespace cullet::metal_shell
