// Cuts long edges of a mesh before cooking, so that cracks find enough edges to follow.
#pragma once
#include "cullet/result.hpp"
#include "engine/mesh.hpp"

namespace cullet {

struct TessellationSettings {
    double longest_edge = 0;            // m, > 0; edges above are halved
    uint32_t most_triangles = 1000000;  // refuses rather than fills the memory
};

/// Halves every edge longer than longest_edge at its middle, longest first (ties by position, so the result does not
/// depend on the numbering). All triangles at an edge are cut together, also where vertices are doubled at the same
/// position, so no T-junctions appear. Corner attributes are interpolated: normals normalised again, texture
/// coordinates averaged. An edge so short in its coordinates that its middle is one of its ends is left alone.
Result<Mesh> tessellate(const Mesh& mesh, const TessellationSettings& settings);

}  // namespace cullet
