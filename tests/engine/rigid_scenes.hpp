// Bodies and scenes that the tests of the rigid world share.
#pragma once
#include <vector>

#include "engine/rigid_world.hpp"

namespace cullet {

inline constexpr float kStep = 1.0f / 60;

/// An index as a float.
template <class T>
float real(T k) {
    return static_cast<float>(k);
}

inline void step(RigidWorld& world) {
    world.detect(kStep);
    world.solve(kStep);
}

inline std::vector<Vec3> box_points(Vec3 half, Vec3 centre) {
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k)
        points.push_back(centre + Vec3{k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z});
    return points;
}

inline void add_box(RigidWorld& world, RigidId id, Vec3 at, Vec3 half, double density,
                    RigidKind kind = RigidKind::Dynamic, Quat orientation = {}) {
    RigidDescription d;
    d.kind = kind;
    const float m = d.margin;
    const std::vector<Vec3> points = box_points(half - Vec3{m, m, m}, {});
    const ConvexPiece piece{points, 0};
    d.pieces = {&piece, 1};
    d.mass = density * 8 * half.x * half.y * half.z;
    const double s = d.mass / 3, x = half.x * half.x, y = half.y * half.y, z = half.z * half.z;
    d.inertia = {s * (y + z), s * (x + z), s * (x + y)};
    d.pose = {at, orientation};
    world.add(id, d);
}

/// A floor of 20 m by 20 m, 1 m thick, top at 0, as twelve triangles.
inline std::unique_ptr<RigidWorld> floor_world(uint32_t bodies) {
    auto world = make_bullet_world(bodies);
    world->set_gravity({0, -9.81f, 0});
    const std::vector<Vec3> p = box_points({10, 0.5f, 10}, {0, -0.5f, 0});
    const std::array<uint32_t, 3> t[] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    world->add_static_triangles(0, p, t, 0.45f, 0.2f, 1, ~0u);
    return world;
}

struct ShardShape {
    std::vector<std::vector<Vec3>> cells;
    double mass = 0;
    Vec3d centre;
    Sym3d inertia;
};

/// Part of a spherical shell: radius of curvature `sphere`, outline radius `rim` measured on a plane, thickness 5 mm,
/// cut into cells of 0.03 m on that plane. Points are pulled in by `margin` on both sides. Mass by a column per sample
/// of 5 mm.
inline ShardShape make_shard(float sphere, float rim, float thickness, float margin, double density) {
    ShardShape shape;
    const auto lift = [&](float x, float z, float r) {
        // The point of the sphere of radius r about (0, -sphere, 0) above the direction through (x, z).
        const float s = r / sphere;
        return Vec3{x * s, std::sqrt(sphere * sphere - x * x - z * z) * s - sphere, z * s};
    };
    const float cell = 0.03f, outside = sphere + 0.5f * thickness, inner = sphere - 0.5f * thickness;
    double count = 0;
    Sym3d moments;
    Vec3d first;
    for (int i = -5; i <= 5; ++i) {
        for (int j = -5; j <= 5; ++j) {
            std::vector<Vec3> points;
            const float middle = cell * std::sqrt(real(i * i + j * j));
            if (middle > rim - 0.2f * cell) continue;
            for (int u = 0; u <= 2; ++u)
                for (int v = 0; v <= 2; ++v) {
                    float x = (real(i) - 0.5f + 0.5f * real(u)) * cell, z = (real(j) - 0.5f + 0.5f * real(v)) * cell;
                    const float l = std::sqrt(x * x + z * z);
                    if (l > rim) x *= rim / l, z *= rim / l;
                    points.push_back(lift(x, z, outside - margin));
                    points.push_back(lift(x, z, inner + margin));
                }
            shape.cells.push_back(points);
        }
    }
    for (int i = -40; i <= 40; ++i)
        for (int j = -40; j <= 40; ++j)
            for (int k = 0; k < 3; ++k) {
                const float x = 0.005f * real(i), z = 0.005f * real(j);
                if (x * x + z * z > rim * rim) continue;
                const Vec3d p(lift(x, z, inner + thickness * (real(k) + 0.5f) / 3));
                count += 1;
                first += p;
                moments = moments + outer(p);
            }
    shape.mass = density * thickness * 2.5e-5 * count / 3;
    shape.centre = (1 / count) * first;
    shape.inertia = (shape.mass / count) * inertia_of(moments - count * outer(shape.centre));
    return shape;
}

inline void add_shape(RigidWorld& world, RigidId id, const ShardShape& shape, const Pose& pose, float margin,
                      float rolling) {
    std::vector<ConvexPiece> pieces;
    for (const auto& cell : shape.cells) pieces.push_back({cell, static_cast<uint32_t>(pieces.size())});
    RigidDescription d;
    d.pieces = pieces;
    d.mass = shape.mass;
    d.centre = shape.centre;
    d.inertia = shape.inertia;
    d.margin = margin;
    d.rolling_friction = rolling;
    d.pose = pose;
    world.add(id, d);
}

inline const ShardShape& test_shard() {
    static const ShardShape shape = make_shard(0.15f, 0.1f, 0.005f, 0.001f, 2400);
    return shape;
}

inline void add_shard(RigidWorld& world, RigidId id, Vec3 at, Quat orientation) {
    add_shape(world, id, test_shard(), {at, orientation}, 0.001f, 0.0045f * 0.177f);
}

/// A static-like plate of 0.4 m by 0.4 m and 4 mm, made of 8 x 8 cells, kinematic at rest, top at 2 mm.
inline void add_plate(RigidWorld& world, RigidId id) {
    std::vector<std::vector<Vec3>> cells;
    std::vector<ConvexPiece> pieces;
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j)
            cells.push_back(
                box_points({0.025f, 0.001f, 0.025f}, {0.05f * real(i) - 0.175f, 0, 0.05f * real(j) - 0.175f}));
    for (const auto& cell : cells) pieces.push_back({cell, static_cast<uint32_t>(pieces.size())});
    RigidDescription d;
    d.kind = RigidKind::Kinematic;
    d.pieces = pieces;
    world.add(id, d);
}

/// Shards in layers of four above each other, each turned its own way by a hash of its number.
inline void drop_shards(RigidWorld& world, RigidId first, uint32_t count, uint32_t seed = 0) {
    for (uint32_t k = 0; k < count; ++k) {
        uint32_t h = (k + 1 + 1000 * seed) * 2654435761u;
        const auto draw = [&h] {
            h ^= h << 13, h ^= h >> 17, h ^= h << 5;
            return static_cast<float>(h % 2000) / 1000 - 1;
        };
        const float x = 0.14f * (k % 2 ? 1 : -1), z = 0.14f * (k / 2 % 2 ? 1 : -1);
        const Quat q = normalised(Quat{draw(), draw(), draw(), draw() + 0.01f});
        add_shard(world, first + k, {x + 0.02f * draw(), 0.2f + 0.23f * real(k / 4), z + 0.02f * draw()}, q);
    }
}

}  // namespace cullet
