// Vertices that the world holds: walls' feet, window frames.
#pragma once
#include <span>

#include "components/shell_rows.hpp"

namespace cullet {

/// Pins these vertices: inverse mass 0. Returns how many are pinned that were not. Indices outside of the shell and
/// dead rows are passed over.
uint32_t apply_pins(ShellView shell, std::span<const uint32_t> vertices);

/// Pins every vertex whose rest position lies in the box, body frame, borders included.
uint32_t apply_pins(ShellView shell, Vec3 low, Vec3 high);

bool has_pins(const ShellView& shell);

}  // namespace cullet
