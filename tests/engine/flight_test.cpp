// What flies fast goes through nothing: shards of all proportions at a plate, as many within a shell of cells, and as
// many thin sheets that spin at each; 10,000 each in the long run, 2,000 in the usual one. In no step of half a second
// is any corner of any of them beyond the far side.
#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/fp_mode.hpp"
#include "engine/random.hpp"
#include "tests/engine/rigid_scenes.hpp"
#include "tests/support/effort.hpp"

namespace cullet {
namespace {

constexpr uint32_t kAtOnce = 500;                             // of one world
const uint32_t kFragments = test::few_or_all(1500u, 10000u);  // of each test
constexpr int kSteps = 30;
constexpr float kFastest = 100, kSpin = 60, kSheetSpin = 400;  // m/s, rad/s
constexpr uint32_t kWall = 0, kFirst = 1;
constexpr uint32_t kWallLayer = 1, kFragmentLayer = 2;

/// CULLET_FLIGHT_SEED in the environment is added: others fly, and none of them is to get through either.
uint64_t seed(uint64_t usual) {
    const char* added = std::getenv("CULLET_FLIGHT_SEED");
    return usual + (added ? static_cast<uint64_t>(std::atoll(added)) : 0);
}

struct Dice {
    Random random;
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

constexpr float kMarginShare = 0.1f;  // of half the thickness

/// What once worked its way through a plate, a millimetre a step.
Fragment sheet() {
    const Vec3 half{0.15f, 0.075f, 0.001f};
    const float m = kMarginShare * half.z;
    return {box_points(half - Vec3{m, m, m}, {}), half};
}

void add_fragment(RigidWorld& world, RigidId id, const Fragment& fragment, const Pose& at, const Motion& motion) {
    RigidDescription d;
    const ConvexPiece piece{fragment.points, 0};
    const Vec3 h = fragment.half;
    d.pieces = {&piece, 1};
    d.margin = kMarginShare * h.z;
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
Motion any_motion(Dice& dice, Vec3 towards, float spin) {
    return {dice.next(1, kFastest) * towards, dice.next(0, spin) * dice.direction()};
}

/// How many corners got past a far side or its middle, each fragment counted once.
struct Count {
    uint32_t through = 0, past_middle = 0, met = 0;
    uint64_t sweeps = 0;
};

/// Lets a world's fragments fly. `depth_of` says how far beyond the near side a point is, 0 to 1 at the far side.
template <class DepthOf>
void fly(RigidWorld& world, const std::vector<Fragment>& fragments, const std::vector<Motion>& motions,
         DepthOf&& depth_of, Count& count) {
    std::vector<float> deepest(fragments.size(), -1);
    for (int frame = 0; frame < kSteps; ++frame) {
        step(world);
        for (uint32_t k = 0; k < fragments.size(); ++k) {
            const Pose at = world.pose(kFirst + k);
            for (const Vec3 p : fragments[k].points)
                deepest[k] = std::max(deepest[k], depth_of(at.position + rotate(at.orientation, p)));
        }
    }
    for (uint32_t k = 0; k < fragments.size(); ++k) {
        count.through += deepest[k] > 1;
        count.past_middle += deepest[k] > 0.5f;
        count.met += length(world.motion(kFirst + k).velocity - motions[k].velocity) > 0.01f;
    }
    count.sweeps += world.counts().sweeps;
}

void expect_none_through(const Count& count) {
    EXPECT_EQ(count.through, 0u);
    EXPECT_LT(count.past_middle, kFragments / 1000);  // 0 to 5 seen of 10,000
    EXPECT_GT(count.met, kFragments * 9 / 10);
    EXPECT_GT(count.sweeps, kFragments / 2);
    testing::Test::RecordProperty("sweeps", static_cast<int>(count.sweeps));
}

/// kFragments of what `any_fragment` makes, from any side and in any turn.
template <class Throw>
Count fly_at_plate(float spin, Throw&& any_fragment) {
    const FpMode mode;
    constexpr float kHalf = 0.005f;
    Dice dice{{seed(7)}};
    Count count;
    for (uint32_t thrown = 0; thrown < kFragments; thrown += kAtOnce) {
        const auto world = make_bullet_world(kAtOnce + 1);
        add_box(*world, kWall, {}, {20, 20, kHalf}, 2400, RigidKind::Static);
        std::vector<Fragment> fragments;
        std::vector<Motion> motions;
        for (uint32_t k = 0; k < kAtOnce; ++k) {
            const Fragment fragment = any_fragment(dice);
            const Vec3 towards = normalised(Vec3{dice.next(-0.7f, 0.7f), dice.next(-0.7f, 0.7f), -1});
            const Motion motion = any_motion(dice, towards, spin);
            const Vec3 at{dice.next(-5, 5), dice.next(-5, 5),
                          kHalf + 0.001f + length(fragment.half) - dice.next(0, 3) * kStep * motion.velocity.z};
            add_fragment(*world, kFirst + k, fragment, {at, any_turn(dice)}, motion);
            fragments.push_back(fragment);
            motions.push_back(motion);
        }
        fly(
            *world, fragments, motions, [](Vec3 p) { return 0.5f - p.z / (2 * kHalf); }, count);
    }
    return count;
}

TEST(Flight, NoneOfThousandsOfShardsGoesThroughAPlateOfACentimetre) {
    expect_none_through(fly_at_plate(kSpin, throw_fragment));
}
TEST(Flight, NoneOfThousandsOfSpinningSheetsGoesThroughAPlateOfACentimetre) {
    expect_none_through(fly_at_plate(kSheetSpin, [](Dice&) { return sheet(); }));
}

/// A plane that a corner is not to get past: `normal` . corner <= height.
struct FarSide {
    Vec3 normal;
    float height;
};

/// A ball's shell of cells between rings of latitude, each a hull of its eight corners. Four corners of two rings lie
/// in a plane, so that the outsides of the cells bound a convex body. Returns those planes, and where four cells meet.
std::vector<FarSide> add_shell(RigidWorld& world, RigidId id, float radius, float thickness,
                               std::vector<Vec3>* inner_corners = nullptr) {
    constexpr int kRings = 24, kAround = 48;
    RigidDescription d;
    d.margin = 0.0005f;
    std::vector<FarSide> planes;
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
            const Vec3 across = cross(cell[7] - cell[4], cell[6] - cell[5]);
            const Vec3 out = normalised(dot(across, cell[4]) < 0 ? -across : across);
            planes.push_back({out, std::max(dot(out, cell[4]), dot(out, cell[7])) + d.margin});
            cells.push_back(cell);
            if (inner_corners && ring > 0) inner_corners->push_back(cell[0]);
        }
    std::vector<ConvexPiece> pieces;
    for (const auto& cell : cells) pieces.push_back({cell, static_cast<uint32_t>(pieces.size())});
    d.kind = RigidKind::Static;
    d.pieces = pieces;
    world.add(id, d);
    return planes;
}

auto depth_in_shell(const std::vector<FarSide>& planes, float radius, float thickness) {
    constexpr float kFlat = 0.02f;  // m; cells are up to 7 mm flatter than the ball
    return [&planes, radius, thickness](Vec3 p) {
        float beyond = -kFlat;
        if (length(p) > radius - kFlat)
            for (const FarSide& side : planes) beyond = std::max(beyond, dot(side.normal, p) - side.height);
        return 1 + beyond / thickness;
    };
}

template <class Throw>
Count fly_in_shell(float spin, Throw&& any_fragment) {
    const FpMode mode;
    constexpr float kRadius = 3, kThickness = 0.004f;  // m
    Dice dice{{seed(8)}};
    Count count;
    for (uint32_t thrown = 0; thrown < kFragments; thrown += kAtOnce) {
        const auto world = make_bullet_world(kAtOnce + 1);
        const std::vector<FarSide> planes = add_shell(*world, kWall, kRadius, kThickness);
        std::vector<Fragment> fragments;
        std::vector<Motion> motions;
        for (uint32_t k = 0; k < kAtOnce; ++k) {
            const Fragment fragment = any_fragment(dice);
            const Vec3 towards = dice.direction();
            const Motion motion = any_motion(dice, towards, spin);
            const float way = std::min(dice.next(0, 3) * kStep * length(motion.velocity), 1.5f);
            const Vec3 at = (0.98f * kRadius - length(fragment.half) - way) * towards;
            add_fragment(*world, kFirst + k, fragment, {at, any_turn(dice)}, motion);
            fragments.push_back(fragment);
            motions.push_back(motion);
        }
        fly(*world, fragments, motions, depth_in_shell(planes, kRadius, kThickness), count);
    }
    return count;
}

TEST(Flight, NoneOfThousandsOfShardsLeavesAShellOfCells) {
    expect_none_through(fly_in_shell(kSpin, throw_fragment));
}
TEST(Flight, NoneOfThousandsOfSpinningSheetsLeavesAShellOfCells) {
    expect_none_through(fly_in_shell(kSheetSpin, [](Dice&) { return sheet(); }));
}

// Where cells of a shell meet in one corner each of them is an edge inside what the others go on with: one has to push.
TEST(Flight, NoSheetThatSpinsAboutACornerOfFourCellsLeavesTheShell) {
    const FpMode mode;
    constexpr float kRadius = 3, kThickness = 0.004f, kInside = -0.145f;  // m, m, and just touching
    Dice dice{{seed(9)}};
    Count count;
    const Fragment fragment = sheet();
    for (uint32_t thrown = 0; thrown < 2 * kAtOnce; thrown += kAtOnce) {
        const auto world = make_bullet_world(kAtOnce + 1);
        std::vector<Vec3> corners;
        const std::vector<FarSide> planes = add_shell(*world, kWall, kRadius, kThickness, &corners);
        const auto depth_of = depth_in_shell(planes, kRadius, kThickness);
        std::vector<Fragment> fragments(kAtOnce, fragment);
        std::vector<Motion> motions;
        for (uint32_t k = 0; k < kAtOnce; ++k) {
            const Vec3 corner = corners[static_cast<uint32_t>(dice.next(0, real(corners.size() - 1)))];
            const Vec3 inwards = normalised(-corner), near = corner + 0.0006f * inwards;
            Pose at;
            do {  // one of its eight corners stands there, and none is in a cell
                at.orientation = any_turn(dice);
                const auto which = static_cast<uint32_t>(dice.next(0, real(fragment.points.size())));
                at.position = near - rotate(at.orientation, fragment.points[which]);
            } while (std::any_of(fragment.points.begin(), fragment.points.end(),
                                 [&](Vec3 p) { return depth_of(at.position + rotate(at.orientation, p)) > kInside; }));
            motions.push_back({dice.next(1, 30) * dice.direction(), dice.next(50, kSheetSpin) * dice.direction()});
            add_fragment(*world, kFirst + k, fragment, at, motions.back());
        }
        fly(*world, fragments, motions, depth_of, count);
    }
    EXPECT_EQ(count.through, 0u);
}

}  // namespace
}  // namespace cullet
