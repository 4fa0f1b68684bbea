// Shapes that the scenes and tests use, made from numbers: the same arguments give the same bytes on every machine.
// Metres, y up, triangles counter-clockwise from outside. Nothing but positions and triangles is filled in. Edge is the
// mean edge length; an edge too coarse for the shape gives a coarse shape, not a refusal.
#pragma once
#include <cstdint>
#include <string>

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
/// A closed bowl with both of its walls, open above, its foot at y = 0; so many points round it.
Mesh make_solid_bowl(float width = 0.24f, float wall = 0.006f, uint32_t around = 72);
/// A flat sheet that faces +z: x from -width/2 to width/2, y from 0 to height, z = 0. Straight borders.
Mesh make_wall(float width = 2.4f, float height = 1.8f, float edge = 0.078f, uint64_t seed = 1);
/// Of the edge: how far points of sheets are moved off their rows, each way, as on lathes.
inline constexpr double kUnevenness = 0.18;
/// A square sheet like a wall of that side.
Mesh make_pane(float side = 0.5f, float edge = 0.010f, uint64_t seed = 1, double unevenness = kUnevenness);
/// A closed pig, snout toward +x, feet at y = 0, exactly so many vertices (500 to 200,000) and 2 V - 4 triangles.
Mesh make_pig(float length = 0.5f, uint32_t vertices = 3500, uint64_t seed = 1);
/// A closed cow with horns and udder, head toward +x, feet at y = 0. A twentieth of its vertices stand twice, along a
/// seam as textures have: 3,000 vertices and 5,700 triangles, which no closed mesh without a seam has.
Mesh make_cow(float length = 0.6f, uint32_t vertices = 3000, uint64_t seed = 1);
/// A car's body of sheet metal, nose toward +x, sills at y = 0: shell, four doors, bonnet and boot lid as parts of
/// their own with seams of 4 mm, windows open. About so many vertices, and near-equilateral triangles.
Mesh make_car(float length = 4.4f, uint32_t vertices = 14'658, uint64_t seed = 1);
/// A closed steel drum round the y axis, its middle at the origin, exactly so many vertices.
Mesh make_drum(float height = 0.88f, uint32_t vertices = 5000, uint64_t seed = 1);
/// A closed castle (4 towers, keep, gatehouse with an arch) round the y axis, gate toward +z, feet at y = 0. It has at
/// least the 5,000-odd vertices that its shape needs, and twice as many triangles as vertices.
Mesh make_castle(float width = 3, uint32_t vertices = 6500, uint64_t seed = 1);
/// A closed block of that size: x and z round 0, y from 0; at least 588 vertices and 2 V - 4 triangles.
Mesh make_slab(Vec3 size = {2.4f, 1.8f, 0.1f}, uint32_t vertices = 600, uint64_t seed = 1);
/// What stands in a street, m: the ground's outline round the origin, walls to `height`, over them a roof that rises by
/// `roof`: a gable along x, of a round one a cone, 0: flat.
struct BuildingShape {
    float width = 6, depth = 5, height = 3, roof = 2;
    float edge = 0.45f;
    bool is_round = false, is_windowless = false;
};
/// The outer sheet of a house or a tower, open at the foot, y = 0, with a door toward +z and windows; which of them are
/// bricked up is the seed's affair.
Mesh make_building(const BuildingShape& shape, uint64_t seed = 1);
/// One of the shapes above with its usual numbers, by the name that scripts and --mesh use ("vase", "pig", "castle");
/// without triangles when there is none of that name.
Mesh make_mesh_named(const std::string& name, uint64_t seed = 1);

// Bodies that hit, or that things fall on. Few triangles, exact shapes.

/// A ball round the origin by halving an icosahedron's edges: 10 * 4^subdivisions + 2 vertices on the sphere.
Mesh make_ball(float radius, int subdivisions);
/// A box round the origin.
Mesh make_box(Vec3 half_extents);
/// A closed round pole of so many sides, its foot at y = 0.
Mesh make_pole(float radius = 0.15f, float height = 2.4f, uint32_t sides = 24);
/// A top of 4 cm on four legs of 6 cm, each a closed box. Feet at y = 0, upper side at y = height, middle over the
/// origin.
Mesh make_table(float width = 1.2f, float depth = 0.8f, float height = 0.75f);

}  // namespace cullet
