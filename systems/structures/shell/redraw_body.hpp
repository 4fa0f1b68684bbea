// What a hit changed of a drawn mesh.
#pragma once
#include "components/body_rows.hpp"
#include "components/view_boxes.hpp"

namespace cullet {

/// Draws the elements of the body's changed cells (Cells::is_changed) as they are now, into the mesh that was drawn of
/// it last, and the borders on which they lie. A triangle that goes leaves its place to the last of its run, so that
/// the triangles are those that draw_body would write, bit for bit, in another order within the runs. Boxes that hold
/// them are marked as outdated. False: there is no room, and the mesh is good for nothing but to be drawn anew.
/// O(elements of changed cells + borders + boxes).
bool redraw_body(BodyRows& state, Row<Bodies> body, ViewBoxes& boxes);

/// View vertices that the mesh may need in between, once the body has this shell: what it has, and what is to come of
/// the elements that `part` (kNone: any) numbers.
uint32_t rows_to_draw(const BodyRows& state, Row<Bodies> body, ShellView shell, uint32_t part);

}  // namespace cullet
