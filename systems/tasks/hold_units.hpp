#pragma once
#include <cstdint>

namespace cullet {

/// Units of the frame of the touch and of those that a hold lasts.
inline uint64_t hold_units(uint64_t units_a_frame, float hold_seconds, float step_seconds) {
    return units_a_frame * (1 + static_cast<uint64_t>(hold_seconds / step_seconds + 1e-3f));
}

}  // namespace cullet
