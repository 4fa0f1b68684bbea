#include "systems/bodies/pin_boxes.hpp"

namespace cullet {
namespace {

// Bodies that share a range name the same rows, and ranges do not overlap otherwise: they move down one by one, in the
// order of their rows.
void drop_unused(BodyRows& state) {
    PinBoxes& boxes = state.pin_boxes;
    Bodies& bodies = state.bodies;
    uint32_t kept = 0;
    for (uint32_t row = 0; row < boxes.size();) {
        Range range;
        for (uint32_t b = 0; b < bodies.size(); ++b)
            if (bodies.pins[b].count > 0 && bodies.pins[b].first == row) range = bodies.pins[b];
        if (range.count == 0) {
            ++row;
            continue;
        }
        if (kept < row) boxes.copy_rows(boxes, row, kept, range.count);
        for (uint32_t b = 0; b < bodies.size(); ++b)
            if (bodies.pins[b].count > 0 && bodies.pins[b].first == row) bodies.pins[b].first = kept;
        row += range.count;
        kept += range.count;
    }
    boxes.truncate(kept);
}

}  // namespace

Range add_pin_boxes(BodyRows& state, std::span<const Box> boxes) {
    PinBoxes& rows = state.pin_boxes;
    const auto count = static_cast<uint32_t>(boxes.size());
    if (boxes.size() > rows.limit()) return {};
    if (rows.size() + count > rows.limit()) drop_unused(state);
    if (rows.size() + count > rows.limit()) return {};
    const Range range{rows.size(), count, count};
    rows.append(count);
    for (uint32_t i = 0; i < count; ++i) {
        rows.low.set(range.first + i, boxes[i].low);
        rows.high.set(range.first + i, boxes[i].high);
    }
    return range;
}

bool is_held(const PinBoxes& boxes, Range rows, Vec3 p) {
    for (uint32_t row = rows.first; row < rows.first + rows.count; ++row) {
        const Vec3 low = boxes.low[row], high = boxes.high[row];
        if (p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y && p.z <= high.z)
            return true;
    }
    return false;
}

}  // namespace cullet
