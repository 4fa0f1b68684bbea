// What pins hold of a body, along a direction.
#pragma once
#include <algorithm>
#include <cmath>

#include "components/bodies.hpp"

namespace cullet {

/// Along an axis, from the frame's origin, m.
struct Held {
    double low, high;
};

/// Along the axis, m: how far the nearest pins are from a place, to both sides.
struct HeldSpan {
    double before = 1e30, behind = 1e30;
    double moment(double force) const {
        if (before < 1e29 && behind < 1e29)
            return before + behind > 0 ? force * before * behind / (before + behind) : 0;
        const double arm = std::min(before, behind);
        return arm < 1e29 ? force * arm : 0;
    }
};

/// What pins hold along an axis: apart from each other.
class HeldParts {
 public:
    // More parts than there is room for join the last one: what lies between them counts as held.
    void add(Held held) {
        for (uint32_t p = 0; p < count_;) {
            const bool is_apart = held.high < parts_[p].low || parts_[p].high < held.low;
            if (is_apart && !(count_ == kMost && p + 1 == count_)) {
                ++p;
                continue;
            }
            held = {std::min(held.low, parts_[p].low), std::max(held.high, parts_[p].high)};
            parts_[p] = parts_[--count_];
            p = 0;
        }
        parts_[count_++] = held;
    }
    HeldSpan span_at(double at) const {
        HeldSpan span;
        for (uint32_t p = 0; p < count_; ++p) {
            const Held held = parts_[p];
            if (held.low <= at && at <= held.high) return {0, 0};
            if (held.high < at) span.before = std::min(span.before, at - held.high);
            if (held.low > at) span.behind = std::min(span.behind, held.low - at);
        }
        return span;
    }

 private:
    static constexpr uint32_t kMost = 32;
    Held parts_[kMost];
    uint32_t count_ = 0;
};

/// The box in this row, body frame.
inline Held held_by_box(const PinBoxes& boxes, uint32_t box, Vec3d axis) {
    const Vec3 low = boxes.low[box], high = boxes.high[box];
    const Vec3d half = 0.5 * (Vec3d(high) - Vec3d(low));
    const double middle = dot(axis, 0.5 * (Vec3d(low) + Vec3d(high)));
    const double reach = std::fabs(axis.x) * half.x + std::fabs(axis.y) * half.y + std::fabs(axis.z) * half.z;
    return {middle - reach, middle + reach};
}

}  // namespace cullet
