// What stands still in a scene, and the small geometry of placing things.
#pragma once
#include "cullet/world.hpp"
#include "engine/mesh.hpp"
#include "sample_game/finish.hpp"

namespace cullet {

/// Something that never moves: met by all, drawn in one colour or with a finish.
struct Prop {
    Mesh mesh;  // world coordinates
    ContactSettings contact;
    bool one_sided = false;  // its triangles bear on the side that sees them counter-clockwise alone
    Vec3 colour{0.45f, 0.42f, 0.38f};
    Finish finish = Finish::Plain;
    bool is_ground = false;  // drawn as the ground with its grid, at its upper side
};

MeshView view_of(const Mesh& mesh);
/// A box between two corners.
Prop box_prop(Vec3 low, Vec3 high, Vec3 colour);
/// A floor around the origin with its upper side at y = height.
Prop floor_prop(float half_side = 30, float height = 0);

Mesh moved(Mesh mesh, Vec3 by);
struct MeshExtent {
    Vec3 low, high;
};
MeshExtent extent_of(const Mesh& mesh);
/// Of its box along the axes, m; 0 for a mesh of no extent.
float largest_side(const Mesh& mesh);
/// Scaled so that its largest side is `size`, with the middle of its box at the origin. False for a mesh of no extent.
bool fit(Mesh& mesh, float size);

/// In [-1, 1), by the seed and a number of the place where it is used.
double seeded(uint64_t seed, uint32_t number);
/// A turn by `angle` rad about `axis`.
Quat turn(Vec3 axis, double angle);
/// Any turn, all alike, from three numbers of seeded().
Quat any_turn(uint64_t seed, uint32_t first_number);

}  // namespace cullet
