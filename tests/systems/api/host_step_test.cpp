// A step of a world whose bodies the host moves asks for no memory, whatever breaks in it.
#include <gtest/gtest.h>

#include "sample_game/allocations.hpp"
#include "tests/support/small_worlds.hpp"

namespace cullet::test {
namespace {

TEST(HostStep, AsksForNoMemoryWhileAVaseBreaks) {
    World world = std::move(World::create_hosted(small_settings())).value();
    const BodyId floor = add_floor(world);
    const BodyId vase = world.spawn(world.add_model(small_vase()).value()).value();
    const HostBody body{vase, {}, {{0, -6, 0}, {}}};
    const HostContact contact{vase, floor, {0.02f, 0, 0.01f}, {0, 1, 0}, 0};
    uint64_t asked = 0;
    uint32_t born = 0;
    for (int frame = 0; frame < 20; ++frame) {
        start_counting_allocations();
        const bool is_done = world.step({&body, 1, &contact, frame == 5 ? 1u : 0u}).ok();
        asked += stop_counting_allocations().ours;
        ASSERT_TRUE(is_done);
        born += world.events().fragments_born.count;
        EXPECT_EQ(world.host_changes().born.count, world.events().fragments_born.count + (frame == 0 ? 1 : 0));
    }
    EXPECT_GT(born, 0u);
    EXPECT_EQ(asked, 0u);
}

}  // namespace
}  // namespace cullet::test
