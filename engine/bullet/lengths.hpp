// What the lengths of contacts are measured in.
//
// Gaps, depths and ranges are said as they fit a wall of 5 mm, and multiplied with the scale of the thinner of the two
// pieces: thin walls lie as deep in each other, in their own widths, as thick ones do. The walls of a vase of 1.5 cm
// are a quarter of a millimetre thick, and 1.5 mm of bearable overlap took its shards out below the floor. What is
// thicker keeps the lengths of 5 mm: they come from the solver's errors, which grow with steps and not with sizes.
#pragma once
#include <algorithm>

namespace cullet::bullet {

inline constexpr float kFullWidth = 0.005f;   // m, from which on a piece has the scale 1
inline constexpr float kFullMargin = 0.001f;  // m, which it has then, see margin_for()
// Of walls of a tenth of a millimetre. Two micrometres are what an advance aims past its gap by then, and a float is no
// finer 16 metres from the origin.
inline constexpr float kLeastScale = 0.02f;

/// The scale of a convex piece: by its margin, a fifth of its wall; by its width where it has none, or is a ball.
inline float scale_of_width(float margin, float width, bool is_ball) {
    const bool has_margin = margin > 0 && !is_ball;
    const float scale = has_margin ? margin / kFullMargin : width / kFullWidth;
    return std::clamp(scale, kLeastScale, 1.0f);
}

/// Points farther apart than this are no contact, m. Twice it and fast shards are braked by what they pass.
inline constexpr float kContactRange = 0.005f;

/// Pieces that lie this near to each other are side by side, m of scale 1. Bodies that move against each other by less
/// than this move as one, m/s: half a millimetre in a step of a sixtieth.
inline constexpr float kFlush = 0.0005f, kAsOne = 0.03f;

}  // namespace cullet::bullet
