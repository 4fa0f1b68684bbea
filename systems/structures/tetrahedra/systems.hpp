// The systems of solids, in slots of structures.
#pragma once
#include "systems/structures/tetrahedra/draw_solid.hpp"
#include "systems/world_data.hpp"

namespace cullet {

/// Writes each piece, and what is left of the body, into the rows that planning took.
void fill_solids(Each<Birth> birth, const Events<Break>& breaks, All<SolidRows, const Tasks> rows, Fragments& fragments,
                 const Bodies& bodies);
/// The drawn mesh of each solid that changed.
void draw_solids(Each<DrawnChanged> changed, Step step, DrawnSolids rows);

}  // namespace cullet
