// Rows for what leaves, and for what is left.
#pragma once
#include "systems/births/planning.hpp"

namespace cullet {

/// Rows, structure and drawn mesh of a new body, or a row that does not exist and the name of the limit.
Row<Bodies> reserve_body(Planning& planning, const Break& plan, Row<Fragments> fragment, const char** full);

/// Hulls of the rest, whatever leaves. False: there is no room, and nothing else is to change.
bool reserve_hulls(Planning& planning, Break& plan);

/// Plans and reserves; what is refused asks again in the next frame. True: something leaves.
bool reserve_births(Planning& planning, Break& plan);

/// Whether only those cells of a body are to be drawn anew that changed. For that the mesh that is drawn of it has to
/// be up to date. It has to have room for what is new of `structure`, or of that part of it alone.
bool has_room_to_redraw(Planning& planning, Row<Bodies> body, Row<Structures> structure, uint32_t part = kNone);

/// The task's cuts wait until there is room (close_blows): the body stays as it was.
void keep_cuts(Blows& blows, Row<Tasks> task);

}  // namespace cullet
