// Folds and creases: what sub-shells make of a smooth field (metal shell note E2, E3).
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"

namespace cullet {

/// Fills MetalVertices.place with start + field along the push.
void place_field(const MetalView& metal, Vec3d push);
/// Fills MetalVertices.mover with the lowest sub-shell that each vertex is part of: with published borders, before the
/// two below.
void choose_lowest(const MetalView& metal);
/// Where sub-shells are at the start of an impact, and which of them its field moves: before the two below.
void measure_cells(const MetalView& metal);
/// Thin metal buckles and does not shorten: sub-shells that came nearer to each other go out and in by turns. Moves
/// `place` of vertices that the field moves.
void fold_cells(const MetalView& metal);
/// Sub-shells that are smaller than the contact (radius, m) move some of the way as rigid pieces.
void crease_cells(const MetalView& metal, double contact);

}  // namespace cullet
