// Whether the rows of a metal shell are such that systems can work on them: for files, which are not believed.
#pragma once
#include "components/metal_rows.hpp"
#include "systems/structures/shell/cook/check_shell_rows.hpp"

namespace cullet::metal_shell {

Result<void> check_metal_shell(MetalShellRows rows, Row<Structures> structure, Wear wear, const std::string& name,
                               const char* advice);
/// Empty, or what an open task lacks.
std::string trouble_of_run(Read<MetalRows> rows, uint32_t task);
/// Impacts that are remembered, and that are worked off.
Result<void> check_metal_rows(Read<MetalRows> rows, uint8_t own, const std::string& name, const char* advice);

}  // namespace cullet::metal_shell
