// What flies fast goes through nothing: 10,000 shards of all proportions at a plate, and as many within a shell of
// cells.
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
    const float length = 0.01f * std::pow(30.0f, dice.next(0, 1)), width = length * dice.next(0.2f, 1);
    const float thickness = std::min(width, 0.001f * std::pow(100.0f, dice.next(0, 1)));
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

TEST(Flight, NoneOfTenThousandShardsGoesThroughAPlateOfACentimetre) {
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
    EXPECT_EQ(through, 0u);
    EXPECT_GT(met, kFragments * 9 / 10);
    EXPECT_GT(sweeps, kFragments / 2);
    RecordProperty("sweeps", static_cast<int>(sweeps));
}

/// A ball's shell of cells between rings of latitude, each a hull of its eight corners.
void add_shell(RigidWorld& world, RigidId id, float radius, float thickness) {
    constexpr int kRings = 24, kAround = 48;
    std::vector<std::vector<Vec3>> cells;
    const auto corner = [&](int ring, int around, float r) {
        const float latitude = 3.14159265f * (real(ring) / kRings - 0.5f);
        const float longitude = 2 * 3.14159265f * real(around % kAround) / kAround;
        const float flat = ring == 0 || ring == kRings ? 0 : std::cos(latitude);
        return r * Vec3{flat * std::cos(longitude), std::sin(latitude), flat * std::sin(longitude)};
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

TEST(Flight, NoneOfTenThousandShardsLeavesAShellOfCells) {
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
    EXPECT_EQ(outside, 0u);
    EXPECT_GT(sweeps, kFragments / 2);
    RecordProperty("sweeps", static_cast<int>(sweeps));
}

}  // namespace
}  // namespace cullet
