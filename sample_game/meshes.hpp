// Shapes that the scenes and tests use, made from numbers: the same arguments give the same bytes on every machine.
// Metres, y up, triangles counter-clockwise from outside. Nothing but positions and triangles is filled in. Edge is the
// mean edge length; an edge too coarse for the shape gives a coarse shape, not a refusal.
#pragma once
#include <cstdint>

#include "cullet/types.hpp"
#include "engine/mesh.hpp"

namespace cullet {

// Bodies to break.

/// The outer sheet of a vase: flat foot, belly, neck, flared open lip (the only border loop). Origin in the middle of
/// the foot. Area 0.16 m2 at 30 cm, so 5 mm of porcelain weigh 2 kg. Another height scales the profile, not the edge.
/// Vertices: 3,200 at the default edge, 11,000 at 4.05 mm, 98,000 at 1.36 mm.
Mesh make_vase(float height = 0.30f, float edge = 0.0075f, uint64_t seed = 1);
/// A closed hollow figure, snout toward +x, feet at y = 0: for scenes that drop something when no model is given.
Mesh make_piggy_bank(float length = 0.40f, float edge = 0.0098f, uint64_t seed = 1);
/// A flat sheet that faces +z: x from -width/2 to width/2, y from 0 to height, z = 0. Straight borders.
Mesh make_wall(float width = 2.4f, float height = 1.8f, float edge = 0.078f, uint64_t seed = 1);
/// A square sheet like a wall of that side.
Mesh make_pane(float side = 0.5f, float edge = 0.010f, uint64_t seed = 1);

// Bodies that hit, or that things fall on. Few triangles, exact shapes.

/// A ball round the origin by halving an icosahedron's edges: 10 * 4^subdivisions + 2 vertices on the sphere.
Mesh make_ball(float radius, int subdivisions);
/// A box round the origin.
Mesh make_box(Vec3 half_extents);
/// A top of 4 cm on four legs of 6 cm, each a closed box. Feet at y = 0, upper side at y = height, middle over the
/// origin.
Mesh make_table(float width = 1.2f, float depth = 0.8f, float height = 0.75f);

}  // namespace cullet
