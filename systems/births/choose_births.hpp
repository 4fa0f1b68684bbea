// Which fragments become debris, which bodies, and which stay with the largest.
#pragma once
#include "systems/births/planning.hpp"

namespace cullet {

/// Heaviest first, ties by row; of a body that tore those with pins before all. Rows of new bodies are taken.
void choose_births(Planning& planning, Break& plan);

/// The fragment finds no room and goes on as part of the largest: `setting` is the limit to raise.
void stay(Planning& planning, Break& plan, Row<Fragments> fragment, const char* setting);

}  // namespace cullet
