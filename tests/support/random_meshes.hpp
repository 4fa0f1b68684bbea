// Meshes for properties: a family of shapes whose numbers come from one seed, with noise on every point.
#pragma once
#include "engine/mesh.hpp"

namespace cullet::test {

/// Ball, box, ring, thin ring, pleated sheet, plate, hollow ball or cup, of 200 to 1,300 triangles, about 1 m, noise up
/// to 4 % of the mean edge, renumbered. Closed ones face outward. Most do not cross themselves.
Mesh random_mesh(uint64_t seed);

}  // namespace cullet::test
