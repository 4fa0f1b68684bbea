#include "tests/support/random_sliders.hpp"

#include <algorithm>
#include <cmath>

#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

void make_slab(Slider& slider, Vec3 half, int count_x, int count_z, double density) {
    const float m = slider.margin;
    const Vec3 cell{half.x / real(count_x), half.y, half.z / real(count_z)};
    for (int i = 0; i < count_x; ++i)
        for (int k = 0; k < count_z; ++k) {
            const Vec3 centre{cell.x * real(2 * i + 1 - count_x), 0, cell.z * real(2 * k + 1 - count_z)};
            // Cells meet: only the outside is pulled in.
            const float ml = i == 0 ? m : 0, mh = i + 1 == count_x ? m : 0, nl = k == 0 ? m : 0,
                        nh = k + 1 == count_z ? m : 0;
            std::vector<Vec3> points = box_points(cell - Vec3{0.5f * (ml + mh), m, 0.5f * (nl + nh)},
                                                  centre + Vec3{0.5f * (ml - mh), 0, 0.5f * (nl - nh)});
            slider.pieces.push_back(points);
        }
    slider.mass = density * 8 * half.x * half.y * half.z;
    const double s = slider.mass / 3, x = half.x * half.x, y = half.y * half.y, z = half.z * half.z;
    slider.inertia = {s * (y + z), s * (x + z), s * (x + y)};
    slider.lift = half.y;
}

Quat about_y(float angle) {
    return {0, std::sin(0.5f * angle), 0, std::cos(0.5f * angle)};
}

// The turn that takes the vertical to `up`, unit.
Quat tilt_to(Vec3 up) {
    const Quat half{up.z, 0, -up.x, 1 + up.y};
    const float size = std::sqrt(half.x * half.x + half.z * half.z + half.w * half.w);
    return {half.x / size, 0, half.z / size, half.w / size};
}

}  // namespace

Slider random_slider(Chance& chance) {
    Slider slider;
    slider.speed = 0.5f * std::pow(60.0f, chance.between(0, 1));
    slider.turn = chance.between(0, 3.14f);
    switch (chance.below(5)) {
        case 0:
            slider.name = "box";
            make_slab(slider, {chance.between(0.02f, 0.15f), chance.between(0.02f, 0.1f), chance.between(0.02f, 0.15f)},
                      1, 1, 2400);
            break;
        case 1:
            slider.name = "box of pieces";
            make_slab(slider, {chance.between(0.04f, 0.15f), chance.between(0.02f, 0.1f), chance.between(0.04f, 0.15f)},
                      2, 3, 2400);
            break;
        case 2: {
            slider.name = "ball";
            slider.radius = slider.lift = chance.between(0.02f, 0.15f);
            slider.mass = 2400 * 4.19 * slider.radius * slider.radius * slider.radius;
            const double i = 0.4 * slider.mass * slider.radius * slider.radius;
            slider.inertia = {i, i, i};
            break;
        }
        case 3:
            slider.name = "pane";
            make_slab(slider,
                      {chance.between(0.05f, 0.15f), chance.between(0.002f, 0.004f), chance.between(0.05f, 0.15f)}, 4,
                      4, 2400);
            break;
        default: {
            slider.name = "shard";
            const ShardShape& shard = test_shard();
            slider.pieces = shard.cells;
            slider.mass = shard.mass, slider.centre = shard.centre, slider.inertia = shard.inertia;
            float low = 0;
            for (const auto& cell : shard.cells)
                for (const Vec3 p : cell) low = std::min(low, p.y);
            slider.lift = slider.margin - low;
        }
    }
    return slider;
}

Pose laid_on(const Height& height, const Slider& slider) {
    const float x = 0, z = slider.side, d = 0.01f;
    const Vec3 up = normalised(Vec3{height(x - d, z) - height(x + d, z), 2 * d, height(x, z - d) - height(x, z + d)});
    const Quat turn = tilt_to(up) * about_y(slider.turn);
    Pose pose{Vec3{x, height(x, z), z} + slider.lift * up, turn};
    float lift = 0;
    for (const auto& piece : slider.pieces)
        for (const Vec3 point : piece) {
            const Vec3 at = pose.position + rotate(turn, point) - slider.margin * up;
            lift = std::max(lift, height(at.x, at.z) - at.y);
        }
    pose.position.y += lift + 0.0005f;
    return pose;
}

Pose laid_level(const Height& height, const Slider& slider, float x) {
    return {{x, height(x, slider.side) + slider.lift + 0.0005f, slider.side}, about_y(slider.turn)};
}

void add_floor(RigidWorld& world, const Floor& floor) {
    RigidId id = 0;
    for (const FloorPart& part : floor.parts) {
        if (!part.triangles.empty()) {
            world.add_static_triangles(id++, part.points, part.triangles, 0.45f, 0.2f, 1, ~0u);
            continue;
        }
        std::vector<ConvexPiece> pieces;
        for (const auto& p : part.pieces) pieces.push_back({p, static_cast<uint32_t>(pieces.size())});
        RigidDescription d;
        d.kind = RigidKind::Static;
        d.margin = part.margin;
        d.pieces = pieces;
        world.add(id++, d);
    }
}

void add_slider(RigidWorld& world, RigidId id, const Slider& slider, const Pose& pose, Vec3 velocity) {
    std::vector<ConvexPiece> pieces;
    for (const auto& p : slider.pieces) pieces.push_back({p, static_cast<uint32_t>(pieces.size())});
    RigidDescription d;
    d.pieces = pieces;
    d.radius = slider.radius;
    d.margin = slider.margin;
    d.mass = slider.mass, d.centre = slider.centre, d.inertia = slider.inertia;
    d.pose = pose;
    d.motion = {velocity, {}};
    if (slider.radius > 0) d.motion.angular_velocity = {0, 0, -velocity.x / slider.radius};
    world.add(id, d);
}

}  // namespace cullet
