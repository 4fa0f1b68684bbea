// What a tear leaves hanging bends out of the striker's way.
#pragma once
#include "systems/models/metal_shell/tear/tear_star.hpp"

namespace cullet {

/// Of MetalVertices.is_queued: what was punched out.
inline constexpr uint8_t kPunched = 2;

/// Petals bend from the line between the tips of their cracks on, in the direction of the push; the lips of a slit give
/// way to both sides. What is marked as punched out stays as it is. Vertices of the shell move, normals and mass
/// properties follow.
void open_petals(const MetalView& metal, const Dent& dent, const TearStar& star);

}  // namespace cullet
