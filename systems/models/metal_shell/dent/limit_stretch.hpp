// Clean-up of a dent: what is in the striker comes out, edges keep to their limits, triangles do not turn over (metal
// shell note E4 to E6).
#pragma once
#include "systems/models/metal_shell/shared/metal_view.hpp"
#include "systems/models/metal_shell/shared/striker.hpp"

namespace cullet {

/// Vertices inside the striker, which has gone on by `depth`, go to its surface along the push.
void clear_striker(const MetalView& metal, const Striker& striker, double depth);
/// One round: edges longer than 1 + `most_stretch` times their original length pull, shorter than 0.92 of it push.
void relax_once(const MetalView& metal, float most_stretch);
/// Six of them; or what the published method has in their place: ten rounds of all edges, and another limit. Each
/// second round clears the striker again, where the dent has its shape.
void limit_stretch(const MetalView& metal, double most_stretch, const Striker& striker, double depth);
/// Where edges are out of their limits after that, rounds for them and what is around them, up to 24.
void mend_edges(const MetalView& metal, double most_stretch, const Striker& striker, double depth);
/// Triangles that turned over take their mean displacement; the passes that it took, at most three.
void turn_back(const MetalView& metal);

/// Edges of the shell outside of [1 - most_shortening, 1 + most_stretch] of their original length, and all of them.
struct StretchCount {
    uint32_t outside = 0, edges = 0;
    double longest = 0, shortest = 1e30;  // shares of the original length
};
StretchCount count_stretch(const MetalView& metal, double most_stretch, double most_shortening);

}  // namespace cullet
