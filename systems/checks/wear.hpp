// How far the rows of a structure, which came from a file, may be from those that cooking made.
#pragma once
#include <cstdint>

namespace cullet {

/// Worn: a body's that was pinned, cracked or broken, or a task's, at whatever step of its run. CutOut: a task's that
/// has a part of the body (models/thick_shell/shared/cut_out.hpp).
enum class Wear : uint8_t { Intact, Worn, CutOut };

}  // namespace cullet
