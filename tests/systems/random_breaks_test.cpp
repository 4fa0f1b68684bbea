// No break adds energy: 300 breaks, in the long run a thousand, of random shapes, materials, placements, speeds and
// strikers.
#include <gtest/gtest.h>

#include <vector>

#include "systems/world_contents.hpp"
#include "tests/support/effort.hpp"
#include "tests/support/random_hits.hpp"

namespace cullet::test {
namespace {

constexpr uint32_t kShapes = 40, kMostHits = 4000;
const uint32_t kBreaks = few_or_all(300u, 1000u);

TEST(RandomBreaks, HundredsAddNoEnergyAndKeepMassAndMomentum) {
    World world = make_world(small_settings());
    Watch watch;
    after_each_system(world, [&](const std::string& system) { watch.look(world, system); });
    std::vector<Shape> shapes;
    for (uint32_t s = 0; s < kShapes; ++s) shapes.push_back(random_shape(s));
    uint32_t hits = 0;
    for (; hits < kMostHits && watch.breaks < kBreaks; ++hits) {
        watch.begin_hit(world);
        hit_once(world, shapes[hits % kShapes], {{5}, hits});
        ASSERT_LE(watch.most_kept, 1 + 1e-6) << "hit " << hits;
    }
    std::printf("%u breaks in %u hits; at most %.4f of the energy kept, momentum to %.1e, mass to %.1e\n", watch.breaks,
                hits, watch.most_kept, watch.worst_momentum, watch.worst_mass);
    EXPECT_GE(watch.breaks, kBreaks);
    const EnergyBalance& energy = world.contents().data.energy;
    EXPECT_LE(energy.most_share, 1) << "frame by frame, in Checked and Debug builds: " << energy.most_gain
                                    << " J in frame " << energy.most_frame;
    EXPECT_LT(watch.worst_momentum, 1e-6);
    EXPECT_LT(watch.worst_mass, 1e-6);
}

/// Two shells that fly at each other, and 16 frames; then the world is empty again.
void meet_once(World& world, const Shape& shape, const Shape& other, Draw draw) {
    const ModelId model = world.add_model(shape.model).value(), other_model = world.add_model(other.model).value();
    const Vec3 way = draw.in_ball(1), unit = 1 / length(way) * way;
    const float apart = 1.2f * (shape.radius + other.radius);
    SpawnSettings one, two;
    one.motion = {draw.in_ball(1), draw.in_ball(5)};
    two.motion = {float(draw.between(-25, -5)) * unit, draw.in_ball(5)};
    two.pose.position = apart * unit + draw.in_ball(0.3 * other.radius);
    world.spawn(model, one).value();
    world.spawn(other_model, two).value();
    for (int frame = 0; frame < 16; ++frame) world.step();
    clear_away(world, model);
    EXPECT_TRUE(world.remove_model(other_model).ok());
}

// What a touch takes is there once: in the pieces of one of the two, or in what waits in the other.
TEST(RandomBreaks, TwoThatBreakEachOtherAddNoEnergyWhereOnlyOneHasRoomForItsPieces) {
    Settings settings = small_settings();
    settings.limits.births_a_frame = 1;
    World world = make_world(settings);
    std::vector<Shape> shapes;
    for (uint32_t s = 0; s < 8; ++s) shapes.push_back(random_shape(s));
    for (uint32_t hit = 50; hit < 90; ++hit)
        meet_once(world, shapes[hit % 8], shapes[(hit / 8 + hit + 1) % 8], {{9}, hit});
    EXPECT_GE(world.contents().data.counts.broke, 40u);
    const EnergyBalance& energy = world.contents().data.energy;
    EXPECT_LE(energy.most_share, 1) << energy.most_gain << " J in frame " << energy.most_frame;
}

}  // namespace
}  // namespace cullet::test
