// Fewer triangles round the poles of a mesh: a shell keeps at most kMostRing of them at a vertex.
#pragma once
#include "engine/mesh.hpp"

namespace cullet {

/// While a position has more than `most` triangles, a ring of vertices is put half way to its neighbours. Inside the
/// ring every second spoke goes where the two triangles at it are nearly flat (30 degrees) and alike in material and
/// texture. A fan of n becomes one of n / 2 to 2 n / 3, with the old one's n around it. The surface moves by what the
/// spokes left out stood off their neighbours' plane. A fan of folds stays as it is. Corner attributes are
/// interpolated. The result depends on positions, not on their numbers. Returns how many positions had too many.
uint32_t thin_fans(Mesh& mesh, uint32_t most);

}  // namespace cullet
