// The boxes that hold a body's pins: kept, so that a cut through what is pinned knows which of its sides they hold.
#pragma once
#include <span>

#include "components/body_rows.hpp"
#include "cullet/world.hpp"

namespace cullet {

/// Rows for the boxes, or none where there is no room. Rows that no body names any more are taken again.
Range add_pin_boxes(BodyRows& state, std::span<const Box> boxes);

/// Whether one of the boxes holds the place, body frame, borders included.
bool is_held(const PinBoxes& boxes, Range rows, Vec3 place);

}  // namespace cullet
