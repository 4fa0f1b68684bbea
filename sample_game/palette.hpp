// Colours: one for each fragment, and the way between sRGB bytes and linear light.
#pragma once
#include <cstdint>

#include "cullet/types.hpp"

namespace cullet {

/// Linear light, 0 to 1 a channel. Id 0 (what kept the old body) is warm grey; twelve muted hues follow, then the same
/// hues lighter, darker and mixed with their neighbours. Stable by id.
Vec3 fragment_colour(uint32_t id);

/// sRGB transfer function (IEC 61966-2-1), both ways; the way back clamps to [0, 1] and returns 0 to 255 unrounded.
Vec3 linear_from_srgb(uint8_t red, uint8_t green, uint8_t blue);
float linear_from_srgb(uint8_t value);
float srgb_from_linear(float light);

}  // namespace cullet
