// Third step of a surface: where it cuts or touches itself, and which components are therefore bodies of their own.
#pragma once
#include "systems/cook/surface.hpp"

namespace cullet {

/// Triangles a < b that touch although they share no corner there, sorted. About a microsecond a triangle. Refused: a
/// soup in which each meets a hundred others.
Result<std::vector<std::array<uint32_t, 2>>> find_crossings(const Surface& surface);

/// Pairs of components, both orders, sorted: those that cross or share a position.
std::vector<std::array<uint32_t, 2>> find_independent(const Surface& surface);

}  // namespace cullet
