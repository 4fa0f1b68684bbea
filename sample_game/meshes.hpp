// Shapes that the scenes and tests use, made from numbers: the same arguments give the same bytes on every machine. Metres, y up.
#pragma once
#include <cstdint>

#include "engine/mesh.hpp"

namespace cullet {

constexpr float kVaseEdge = 0.0075f;  // m; 3,200 vertices; 0.0040 gives 11,000, 0.00135 gives 98,000

/// The outer sheet of a vase of 30 cm: flat foot, belly, neck, flared open lip (the only border loop). Origin in the middle of
/// the foot. 5 mm of porcelain weigh 2 kg. Other heights scale the profile, not the edge.
Mesh make_vase(float height = 0.30f, float edge = kVaseEdge, uint64_t seed = 1);

}  // namespace cullet
