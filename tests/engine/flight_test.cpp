// What flies fast should go through nothing: 10,000 shards of all proportions at a plate, and as many within a shell of
// cells. One of each gets its centre to the other side, which is one too many: a sheet of 2 mm that strikes with its
// edge comes to spin at 400 rad/s, touches all the while, and works its way in step by step.
#include <gtest/gtest.h>

#include "engine/fp_mode.hpp"
#include "engine/random.hpp"
#include "tests/engine/rigid_scenes.hpp"

namespace cullet {
namespace {

constexpr uint32_t kFragments = 10000, kAtOnce = 500;  // of each test, of one world
constexpr float kFastest = 100, kSpin = 60;            // m/s, rad/s
constexpr uint32_t kWall = 0, kFirst = 1;
constexpr uint32_t kWallLayer = 1, kFragmentLayer = 2;

struct Dice {
    Random random{7};
    uint64_t thrown = 0;
    float next(float low, float high) { return low + (high - low) * static_cast<float>(random.uniform(thrown++)); }
    /// From `least` on, each of so many octaves as often as the others.
    float of_any_size(float least, uint32_t octaves) {
        const auto octave = static_cast<uint32_t>(next(0, real(octaves)));
        return least * real(1u << std::min(octave, octaves - 1)) * next(1, 2);
    }
    Vec3 direction() {
        for (;;) {
            const Vec3 v{next(-1, 1), next(-1, 1), next(-1, 1)};
            const float square = dot(v, v);
            if (square > 0.01f && square < 1) return normalised(v);
        }
    }
};

/// A shard 1 to 30 cm long, as wide or narrower, from a millimetre thick to as thick as it is wide.
struct Fragment {
    std::vector<Vec3> points;
    Vec3 half;
};
Fragment throw_fragment(Dice& dice) {
    const float length = std::min(0.3f, dice.of_any_size(0.01f, 5)), width = length * dice.next(0.2f, 1);
    const float thickness = std::min(width, dice.of_any_size(0.001f, 7));
    Fragment out{{}, {0.5f * length, 0.5f * width, 0.5f * thickness}};
    const int count = 6 + static_cast<int>(dice.next(0, 20));
    for (int k = 0; k < count; ++k) {
        const Vec3 d = dice.direction();
        out.points.push_back({d.x * out.half.x, d.y * out.half.y, k % 2 ? out.half.z : -out.half.z});
    }
    return out;
}

void add_fragment(RigidWorld& world, RigidId id, const Fragment& fragment, const Pose& at, const Motion& motion) {
    RigidDescription d;
    const ConvexPiece piece{fragment.points, 0};
    const Vec3 h = fragment.half;
    d.pieces = {&piece, 1};
    d.margin = 0.1f * h.z;
    d.mass = 2400.0 * 4 * h.x * h.y * h.z;
    const double s = d.mass / 5, x = h.x * h.x, y = h.y * h.y, z = h.z * h.z;
    d.inertia = {s * (y + z), s * (x + z), s * (x + y)};
    d.pose = at;
    d.motion = motion;
    d.layer = kFragmentLayer;
    d.mask = kWallLayer;
    world.add(id, d);
}

Quat any_turn(Dice& dice) {
    return normalised(Quat{dice.next(-1, 1), dice.next(-1, 1), dice.next(-1, 1), dice.next(-1, 1)});
}
Motion any_motion(Dice& dice, Vec3 towards) {
    return {dice.next(1, kFastest) * towards, dice.next(0, kSpin) * dice.direction()};
}

TEST(Flight, AtMostOneOfTenThousandShardsGoesThroughAPlateOfACentimetre) {
    const FpMode mode;
    Dice dice;
    uint64_t sweeps = 0;
    uint32_t through = 0, met = 0;
    for (uint32_t thrown = 0; thrown < kFragments; thrown += kAtOnce) {
        const auto world = make_bullet_world(kAtOnce + 1);
        add_box(*world, kWall, {}, {20, 20, 0.005f}, 2400, RigidKind::Static);
        std::vector<float> speed;
        for (uint32_t k = 0; k < kAtOnce; ++k) {
            const Fragment fragment = throw_fragment(dice);
            const Motion motion =
                any_motion(dice, normalised(Vec3{dice.next(-0.7f, 0.7f), dice.next(-0.7f, 0.7f), -1}));
            const Vec3 at{dice.next(-5, 5), dice.next(-5, 5),
                          0.006f + length(fragment.half) - dice.next(0, 3) * kStep * motion.velocity.z};
            speed.push_back(motion.velocity.z);
            add_fragment(*world, kFirst + k, fragment, {at, any_turn(dice)}, motion);
        }
        for (int frame = 0; frame < 12; ++frame) step(*world);
        sweeps += world->counts().sweeps;
        for (uint32_t k = 0; k < kAtOnce; ++k) {
            through += !(world->pose(kFirst + k).position.z > 0);
            met += world->motion(kFirst + k).velocity.z > speed[k];
        }
    }
    EXPECT_LE(through, 1u);  // wanted: none
    EXPECT_GT(met, kFragments * 9 / 10);
    EXPECT_GT(sweeps, kFragments / 2);
    RecordProperty("sweeps", static_cast<int>(sweeps));
}

/// A ball's shell of cells between rings of latitude, each a hull of its eight corners.
void add_shell(RigidWorld& world, RigidId id, float radius, float thickness) {
    constexpr int kRings = 24, kAround = 48;
    std::vector<std::vector<Vec3>> cells;
    const auto corner = [&](int ring, int around, float r) {
        // Half a circle by the tangent of half the angle, and its other half across.
        const auto half_circle = [](float t) { return Vec3{(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t), 0}; };
        const Vec3 up = half_circle(2 * real(ring) / kRings - 1);
        const int half = kAround / 2, place = around % kAround;
        const Vec3 on = (place < half ? 1.0f : -1.0f) * half_circle(2 * real(place % half) / real(half) - 1);
        return r * Vec3{up.x * on.x, up.y, up.x * on.y};
    };
    for (int ring = 0; ring < kRings; ++ring)
        for (int around = 0; around < kAround; ++around) {
            std::vector<Vec3> cell;
            for (const float r : {radius, radius + thickness})
                for (const int up : {0, 1})
                    for (const int on : {0, 1}) cell.push_back(corner(ring + up, around + on, r));
            cells.push_back(cell);
        }
    std::vector<ConvexPiece> pieces;
    for (const auto& cell : cells) pieces.push_back({cell, static_cast<uint32_t>(pieces.size())});
    RigidDescription d;
    d.kind = RigidKind::Static;
    d.pieces = pieces;
    d.margin = 0.0005f;
    world.add(id, d);
}

TEST(Flight, AtMostOneOfTenThousandShardsLeavesAShellOfCells) {
    const FpMode mode;
    constexpr float kRadius = 3, kThickness = 0.004f;
    Dice dice{{8}};
    uint64_t sweeps = 0;
    uint32_t outside = 0;
    for (uint32_t thrown = 0; thrown < kFragments; thrown += kAtOnce) {
        const auto world = make_bullet_world(kAtOnce + 1);
        add_shell(*world, kWall, kRadius, kThickness);
        for (uint32_t k = 0; k < kAtOnce; ++k) {
            const Fragment fragment = throw_fragment(dice);
            const Vec3 towards = dice.direction();
            const Motion motion = any_motion(dice, towards);
            const float way = std::min(dice.next(0, 3) * kStep * length(motion.velocity), 1.5f);
            const Vec3 at = (0.98f * kRadius - length(fragment.half) - way) * towards;
            add_fragment(*world, kFirst + k, fragment, {at, any_turn(dice)}, motion);
        }
        for (int frame = 0; frame < 12; ++frame) step(*world);
        sweeps += world->counts().sweeps;
        for (uint32_t k = 0; k < kAtOnce; ++k)
            outside += !(length(world->pose(kFirst + k).position) < kRadius + kThickness);
    }
    EXPECT_LE(outside, 1u);  // wanted: none
    EXPECT_GT(sweeps, kFragments / 2);
    RecordProperty("sweeps", static_cast<int>(sweeps));
}

}  // namespace
}  // namespace cullet
