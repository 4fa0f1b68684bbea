// Nothing passes a pane of 4 mm that cannot break, at 30 m/s: our own sweep stops what Bullet's lets through.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/math.hpp"
#include "engine/random.hpp"
#include "sample_game/run_scene.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

constexpr float kSpeed = 30, kSide = 0.5f, kFoot = 0.35f, kThickness = 0.004f;  // m/s, m; faces z = 0 and z = -0.004

/// The scene `pane` with strength infinite and its frame.
const ScenePlan& unbreakable_pane() {
    static const ScenePlan plan = [] {
        RunOptions options;
        options.scene = "pane";
        options.threads = 2;
        options.set = {"scene.strength_scale=inf", "scene.speed_mps=30", "gravity_mps2=0"};
        return plan_scene(*find_scene("pane"), options);
    }();
    return plan;
}

/// Unit; `angle` from the pane's normal, toward `turn` round it; from the front (side 1) or from behind (-1).
Vec3 way(float side, double angle, double turn) {
    double sine, cosine, up, across;
    sine_cosine(angle, sine, cosine);
    sine_cosine(turn, up, across);
    return Vec3d(sine * across, sine * up, -double{side} * cosine).to_float();
}

Vec3 target(uint32_t number) {
    const Random random{7};
    const auto draw = [&](uint32_t n) { return static_cast<float>(random.uniform(number, n)) - 0.5f; };
    return {0.7f * kSide * draw(0), kFoot + 0.5f * kSide + 0.7f * kSide * draw(1), -0.5f * kThickness};
}

bool is_over_pane(Vec3 p) {
    return std::fabs(p.x) < 0.5f * kSide && p.y > kFoot && p.y < kFoot + kSide;
}

/// Past the face at which it cannot have arrived from `side`.
bool has_passed(Vec3 centre, float side) {
    return is_over_pane(centre) && (side > 0 ? centre.z < -kThickness : centre.z > 0);
}

TEST(PaneSweep, TheSteelBallOfThePaneSceneStaysOnItsSideAtThirtyMetresASecond) {
    const ScenePlan& plan = unbreakable_pane();
    uint32_t number = 0, met = 0;
    for (const float side : {1.0f, -1.0f})
        for (const double degrees : {0.0, 30.0, 60.0, 80.0})
            for (const double turn : {0.3, 2.4, 4.5}) {
                GameWorld game = std::move(GameWorld::create(plan).value());
                const Bodies& bodies = state_of(game.world()).bodies;
                uint32_t row = 0;
                while (!bodies.is_sphere[row]) ++row;
                const BodyId ball{row, bodies.generation[row]};
                const Vec3 direction = way(side, degrees * 3.14159265 / 180, turn), aim = target(++number);
                // It arrives at all phases of a step, whose way is half a metre.
                const Vec3 start = aim - (0.12f + 0.011f * static_cast<float>(number)) * direction;
                ASSERT_TRUE(game.world().set_pose(ball, {start, {}}).ok());
                ASSERT_TRUE(game.world().set_motion(ball, {kSpeed * direction, {}}).ok());
                for (uint32_t frame = 0; frame < 30; ++frame) {
                    game.before_step();
                    game.step();
                    game.after_step();
                    const Vec3 place = bodies.position[row];
                    ASSERT_FALSE(has_passed(place, side)) << "throw " << number << ", frame " << frame;
                    if (is_over_pane(place)) {
                        // The whole ball stays outside of the glass, to a millimetre.
                        const float gap = side > 0 ? place.z : -kThickness - place.z;
                        ASSERT_GT(gap, bodies.radius[row] - 0.001f) << "throw " << number << ", frame " << frame;
                    }
                }
                met += bodies.velocity[row].z * side > 0;
                EXPECT_EQ(game.sums().born, 0u);
            }
    EXPECT_EQ(met, number);  // all came back
}

/// One world: a vase that a ball has broken, far from the pane; then its shards are thrown.
struct ShardRange {
    GameWorld game;
    World& world;
    std::vector<BodyId> shards;  // heaviest first
    std::vector<float> side;     // by row; 0: not thrown

    ShardRange() : game(std::move(GameWorld::create(unbreakable_pane()).value())), world(game.world()) {
        const BodyId held = shells_of(world).front();
        for (const BodyId body : all_bodies(world))
            if (state_of(world).bodies.is_sphere[body.index]) {
                EXPECT_TRUE(world.remove(body).ok());
            }
        SpawnSettings vase;
        vase.pose.position = {30, 1, 0};
        (void)world.spawn(world.add_model(small_vase()).value(), vase).value();
        (void)world.add_sphere(ball_at({30.01f, 1.13f, 0}, 2, 15)).value();
        EXPECT_GT(step_until_born(world, 30), 0u);
        for (int frame = 0; frame < 20; ++frame) world.step();
        for (const BodyId body : shells_of(world))
            if (body.index != held.index) shards.push_back(body);
        const Bodies& bodies = state_of(world).bodies;
        std::sort(shards.begin(), shards.end(), [&](BodyId a, BodyId b) {
            const double p = bodies.mass[a.index], q = bodies.mass[b.index];
            return p != q ? p > q : a.index < b.index;
        });
        side.resize(bodies.size() + 4096);
    }
    Vec3 centre(uint32_t row) const {
        const Bodies& bodies = world.contents().data.state.bodies;
        return to_world({bodies.position[row], bodies.orientation[row]}, bodies.centre[row].to_float());
    }
    void throw_shard(BodyId shard, float from, Vec3 aim, Vec3 direction, uint32_t number) {
        const Bodies& bodies = state_of(world).bodies;
        const double radius = bodies.radius[shard.index];
        Pose pose;
        const Random random{11};
        const auto draw = [&](uint32_t n) { return static_cast<float>(random.uniform(number, n)) - 0.5f; };
        pose.orientation = normalised(Quat{draw(0), draw(1), draw(2), draw(3)});
        const Vec3 place = aim - static_cast<float>(radius + 0.05) * direction;
        pose.position = place - rotate(pose.orientation, bodies.centre[shard.index].to_float());
        EXPECT_TRUE(world.set_pose(shard, pose).ok());
        EXPECT_TRUE(world.set_motion(shard, {kSpeed * direction, 20.0f * Vec3{draw(4), draw(5), draw(6)}}).ok());
        side[shard.index] = from;
    }
};

TEST(PaneSweep, RealShardsStayOnTheirSideAtThirtyMetresASecond) {
    ShardRange range;
    World& world = range.world;
    ASSERT_GT(range.shards.size(), 4u);
    const Bodies& bodies = state_of(world).bodies;
    uint32_t number = 0, thrown = 0;
    for (const float side : {1.0f, -1.0f})
        for (const double degrees : {0.0, 25.0, 50.0}) {
            for (const BodyId shard : range.shards) {
                if (!world.pose(shard).ok()) continue;
                ++number, ++thrown;
                range.throw_shard(shard, side, target(number), way(side, degrees * 3.14159265 / 180, number), number);
                for (uint32_t frame = 0; frame < 8; ++frame) {
                    world.step();
                    for (const FragmentBornEvent& born : world.events().fragments_born)
                        range.side[born.fragment.index] = range.side[born.parent.index];
                    for (const BodyId body : shells_of(world)) {
                        const float from = range.side[body.index];
                        if (from == 0) continue;
                        ASSERT_FALSE(has_passed(range.centre(body.index), from))
                            << "throw " << number << ", frame " << frame << ", row " << body.index << ", generation "
                            << int{state_of(world).structures.generation[bodies.structure[body.index]]};
                    }
                }
                for (float& s : range.side) s = 0;
            }
        }
    EXPECT_GT(thrown, 24u);
}

}  // namespace
}  // namespace cullet::test
